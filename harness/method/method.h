// The contract between the harness and a method: turn one half (RSM or G-buffer) and its PDF into lights.
//
// A method sees method/, gpu/, shaders/ and nothing else. It does not time itself: every step it records
// through `Steps` is named, labelled, timestamped and followed by a full barrier.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/json.h"
#include "gpu/recorder.h"
#include "method/context.h"
#include "method/light_kind.h"
#include "shaders/types.h"

namespace vsglbench {

// The deferred targets of one half, RGBA32F. Null: no effect that the scene calls for asks for it.
struct FieldMaps {
  const DeviceImage* position = nullptr;  // w = 1 where there is a surface
  const DeviceImage* normal = nullptr;    // of shading, read by shaders/shading_normal.glsl; w: ndf
  const DeviceImage* geometric_normal = nullptr;
  const DeviceImage* diffuse = nullptr;  // Rd
  const DeviceImage* f0 = nullptr;       // F0
  // Those that are there, as shaders/field_maps.glsl numbers them.
  std::vector<Binding> bindings() const {
    std::vector<Binding> out;
    for (const DeviceImage* map : {position, normal, geometric_normal, diffuse, f0})
      if (map) out.emplace_back(*map);
    return out;
  }
};

// What a method reads: the deferred targets of one half, who emits into it, and the PDF.
struct Field {
  Half half = Half::rsm;
  gpu::Emitter emitter{};  // width and height are the half's, in texels
  FieldMaps maps;
  // Pyramid of float means (shaders/pyramid.glsl) of any positive multiple of the PDF; level 0 first. Null
  // where the method said that it uses none.
  const Buffer* pdf = nullptr;
  uint64_t texels() const { return uint64_t(emitter.width) * emitter.height; }
};

// What a method carries over from one frame of an animation to the next of the same seed. The harness keeps
// it: a frame by itself must be repeatable.
struct CarriedState {
  // Method::carried_bytes(), in frame 0 all zeros, then as the frame before left it. Null: a frame by itself,
  // which every one is that is timed or compared with a reference.
  const Buffer* buffer = nullptr;
  uint32_t frame = 0;  // how many frames have had it before
};

// Where the lights go: `count` records of the kind that the method makes. A light of no power has power = 0.
struct LightTarget {
  const Buffer* buffer = nullptr;
  uint32_t count = 0;
  glm::uvec2 shift{0};  // Cranley-Patterson shift of this seed, 32-bit fixed point
  CarriedState carried{};
};

// Names the passes of one half `generate.<half>.<step>`. A step of a name that no report takes, and one
// within another, throw Error(plugin).
class Steps {
 public:
  Steps(Recorder& recorder, Half half) : recorder_(recorder), half_(half) {}
  template <class Record>
  void pass(const std::string& step, const Record& record) {
    check(step);
    const Within within(in_pass_);
    recorder_.pass({PassStage::generate, half_, step}, record);
  }
  Recorder& recorder() { return recorder_; }

 private:
  struct Within {
    explicit Within(bool& flag) : in_pass(flag) { in_pass = true; }
    ~Within() { in_pass = false; }
    bool& in_pass;
  };
  void check(const std::string& step) const {
    if (in_pass_) throw fail(ErrorKind::plugin, "pass '{}': passes don't nest", step.substr(0, 64));
    static constexpr const char* kAllowed = "abcdefghijklmnopqrstuvwxyz0123456789_-";
    if (step.empty() || step.size() > 64 || step.find_first_not_of(kAllowed) != std::string::npos) {
      throw fail(ErrorKind::plugin, "pass '{}': use lower-case letters, digits, '_' and '-', at most 64",
                 step.substr(0, 64));
    }
  }
  Recorder& recorder_;
  Half half_;
  bool in_pass_ = false;
};

// Which texels of a half its lights stand for, for pictures and statistics; null where that is not defined.
struct LightShapes {
  // A vec4 a light: centre x, y and side of its footprint in texels; side 0: no light.
  const Buffer* squares = nullptr;
  // For a partition, two uints a texel: the light it belongs to (at least the number of lights: none), and
  // its y * width + x; `texels` null: in the order of the texels.
  const Buffer *ids = nullptr, *texels = nullptr;
};

// One method with fixed parameters. Made once a case, used for every frame of it.
class Method {
 public:
  virtual ~Method() = default;
  virtual LightKind kind() const = 0;
  virtual bool uses_importance() const { return true; }
  // How many lights it makes from a half of `texels` texels when asked for `wanted`.
  virtual uint32_t light_count(uint32_t wanted, uint64_t /*texels*/) const { return wanted; }
  virtual void generate(Steps& steps, const Field& field, const LightTarget& target) = 0;
  // The shapes of the last generate() of that half, once the device has finished it.
  virtual LightShapes shapes(Half) { return {}; }
  // Of the state that it carries over from frame to frame for so many lights of a half; 0: it carries none.
  virtual size_t carried_bytes(uint32_t /*lights*/) const { return 0; }
};

// A parameter of one method, beyond those every case has.
struct ParameterInfo {
  std::string name;
  Json default_value;  // number or string; its type is the parameter's type
  std::string description;
  double minimum = 0, maximum = 0;   // inclusive; for numbers
  std::vector<std::string> choices;  // for strings
};

// How light i comes from point i of the lattice, where that is as a paper has it: lights of a stated rule are
// recomputed in double (stability/light_check.h). `texel`: the texel itself, with its share of the flux;
// the others are filtered importance sampling.
enum class LightRule {
  unstated,
  texel,              // flux/(N p) [VSGL14 §2]
  pdf_at_centre,      // the kernel's size from the PDF at its centre [MFIS16 Eq. 1, 4]
  equal_probability,  // kernels of equal probability [MFIS16 Eq. 3, 5, Alg. 1]
};

// C++ and HLSL, of one half, as [MFIS16] Tab. 3 prints them.
struct PublishedCodeSize {
  int shaders, dispatches, lines;
};

struct MethodInfo {
  std::string summary;            // one line
  std::string source;             // paper, section
  bool takes_light_count = true;  // false: a config's N is not read
  uint32_t light_count = 0;       // then this many; 0: one a texel
  // The parameters with which it makes VPLs or VSLs: {} always, null never, {{"shading", "exact"}} where that
  // is set. With all others it makes VSGLs, and a config's shading keys are read.
  Json makes_vpls;
  std::vector<ParameterInfo> parameters;
  // What the keys of every case are for this method where a config leaves them out, in place of the harness'
  // own defaults: {{"shading", "filtered"}}. Null: nothing.
  Json case_defaults;
  // Optional features that the device must have, as `vsglbench list devices` names them.
  std::vector<std::string> device_features;
  // How far the lights' summed power may be from the texels', |Σ light/Σ texel - 1|, in the mean over shifts
  // of the lattice; the conformance kit holds the method to it.
  double flux_bound = 0.05;
  // The same where the PDF changes much within a few texels, as a view's does; below 0: flux_bound holds
  // there too. What is drawn may not carry more than this on such a PDF: a run refuses it (run/flux_check.h).
  double uneven_flux_bound = -1;
  // It serves as the maker of importance by lights of this kind, with default parameters [VSGL14 §3]
  // (frame/importance.h); of several that say so, registry.h says which does.
  std::optional<LightKind> makes_importance;
  LightRule light_rule = LightRule::unstated;
  std::optional<PublishedCodeSize> published_code_size;
  double worst_flux_bound() const { return uneven_flux_bound < flux_bound ? flux_bound : uneven_flux_bound; }
  std::unique_ptr<Method> (*create)(MethodContext& context, const Json& parameters) = nullptr;

  // Set by the host when the plugin is found.
  std::string name;               // as a config writes it: the plugin file's, without ".so"
  std::filesystem::path library;  // the plugin file
  std::filesystem::path folder;   // its kernels
  std::string refused;            // why it can't be used; empty: it fits
};

// Fills defaults in and checks: an unknown parameter, a wrong type or a value out of range throws
// Error(config), naming the nearest known one.
Json resolve_parameters(const MethodInfo& method, const Json& given);

}  // namespace vsglbench
