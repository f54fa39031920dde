// One frame of the experiment [light-transport §1]: gbuffer, rsm, importance, generate, visibility, shade.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "frame/memory_watch.h"
#include "frame/pass_check.h"
#include "frame/scene_gpu.h"
#include "frame/shading.h"
#include "frame/visibility.h"
#include "image/image.h"
#include "method/method.h"

namespace vsglbench {

// Whose lights on the G-buffer make the PDF on the RSM: the method's own; VSGLs, of `mfis` [VSGL14 §3]; VPLs,
// of `vpl`, as the first BRSM had it (Ritschel et al. 2011) [VSGL14 Fig. 4a]; or nobody's: the power that
// each texel reflects.
enum class Importance { own, vsgl, vpl, flux };
const std::vector<std::string>& importance_names();    // in the order of the enumeration
Importance parse_importance(const std::string& name);  // throws Error(config)

// Parameters of a case that are not the method's own.
struct FrameParameters {
  uint32_t width = 480, height = 272;  // G-buffer
  uint32_t rsm = 256;                  // RSM, texels a side
  uint32_t lights = 256;               // N
  uint32_t importance_lights = 2048;   // on the G-buffer; at most its number of pixels is used
  Visibility visibility = Visibility::exact;
  IsmParameters ism;
  Shading shading;           // of VSGLs
  float bias_reduction = 0;  // α of [VSGL14 §3.3], of VSGLs; 0: none
  Importance importance = Importance::own;
  // Images of so many light sets are averaged, the radius of lights × 2/3 from one to the next
  // [VSGL14 §5].
  uint32_t progressive = 1;
  // Every pass is submitted by itself and what it wrote is looked at: see Frame::bad_output(). Times of such
  // a frame are not comparable.
  bool check_passes = false;
};

// What the pixels say beside their colour; each is absent where the case does not have it.
struct ShadingNotes {
  std::optional<double> clamp_removed;      // luminance that VPLs' clamp took away / luminance without it
  std::optional<double> cancellation_rate;  // mean share of lights shaded with exact BRDFs [VSGL14 Fig. 6]
  std::optional<Image> cancellation;        // that share by pixel, grey
};

struct FrameTimes {
  std::vector<PassTime> passes;    // in order of first appearance, one entry a name
  double span_ms = 0, sum_ms = 0;  // span: first to last timestamp, summed over submissions
  unsigned generate_dispatches = 0;
};

// Push constants of shade.comp, which says what they mean.
struct ShadePush {
  gpu::Emitter emitter;
  uint32_t first = 0, count = 0, words = 0, accumulate = 0, map_size = 0;
  float map_tolerance = 0;
  uint32_t random = 0;
  float radius2_scale = 1, weight = 1, alpha = 0;
};

// PDFs on both halves as mip pyramids (shaders/pyramid.glsl), apart from the scratch memory that every frame
// overwrites.
struct KeptPdfs {
  Buffer gbuffer, rsm;
};

// Lights of both halves with a NaN, or else an Inf, in any field.
struct LightHealth {
  uint64_t nan = 0, inf = 0;
  std::string first_bad_pass;  // "generate.gbuffer" or "generate.rsm"; empty: all are finite
  uint64_t first_bad = 0;      // index among that half's lights
};

// What one scene's cases share: geometry, targets, kernels and scratch memory.
class Stage {
 public:
  Stage(Device& device, KernelLibrary& kernels, const Scene& scene);
  Device& device;
  KernelLibrary& kernels;
  const Scene& scene;
  ScratchPool scratch;
  SceneGpu geometry;
  DeferredTargets& targets(Half half, uint32_t width, uint32_t height);
  ImperfectShadowMaps& shadow_maps(Visibility technique, const IsmParameters& parameters);

 private:
  std::map<std::string, std::unique_ptr<DeferredTargets>> targets_;
  std::map<std::tuple<Visibility, uint32_t, uint32_t>, std::unique_ptr<ImperfectShadowMaps>> shadow_maps_;
};

class Frame {
 public:
  // `exact` is called for Visibility::exact only. Throws Error(case_failed) for sizes the device can't take,
  // N = 0 or N > texels.
  Frame(Stage& stage, const MethodInfo& method, const Json& method_parameters,
        const FrameParameters& parameters, ExactVisibility exact);
  ~Frame();

  // Renders with the lattice shift of `seed`. Waits for the device. `watched`: with memory_fault(), and not
  // to be timed against a frame that is not.
  FrameTimes render(uint32_t seed, bool watched = false);

  // For timing generation alone. prepare() draws the halves, which then stand for every frame of these sizes,
  // and makes the PDFs with this frame's method; throws Error(case_failed) for one that uses none.
  // generate_only() runs nothing but the generate passes, on those halves and PDFs.
  KeptPdfs prepare(uint32_t seed);
  FrameTimes generate_only(uint32_t seed, const KeptPdfs& pdfs, bool watched = false);
  LightHealth light_health() const;  // of the last generate_only() or render()

  // Of the last watched frame: which lights no kernel wrote, and what was written past the end of a buffer
  // that the method may write; empty: nothing.
  const std::string& memory_fault() const { return memory_fault_; }
  // Of the last frame, on the RSM: Σ over its lights, and over its texels, of the luminance of the reflected
  // power, W.
  double light_power() const;
  double texel_power() const;
  // Whether the PDF on the RSM is above 0 anywhere; true where none is used.
  bool has_importance() const;

  // Results of the last render(); the lights also those of the last generate_only().
  Image indirect() const;
  ShadingNotes shading_notes() const;
  std::vector<uint8_t> surface_mask() const;  // 1 where the camera sees a surface
  LightKind light_kind() const { return method_->kind(); }
  uint32_t light_count() const { return light_count_; }
  std::vector<gpu::Vsgl> vsgls() const;  // empty when the lights are VPLs or VSLs
  std::vector<gpu::Vpl> vpls() const;
  LightShapes light_shapes() const { return method_->shapes(Half::rsm); }
  std::vector<float> importance() const;  // the PDF on the RSM, of any scale; empty when unused
  const DeferredTargets& gbuffer() const { return *gbuffer_; }
  const DeferredTargets& rsm() const { return *rsm_; }
  const gpu::Emitter& camera() const { return camera_; }
  const gpu::Emitter& light() const { return light_; }

  // The first pass, in the order of the frame, whose output of the last render() holds a NaN or Inf; empty
  // when none does.
  std::string first_bad_pass() const;
  // With check_passes: the first NaN or Inf that a pass of the last render() or generate_only() wrote,
  // whether or not it is still there at the end.
  std::optional<BadOutput> bad_output() const { return check_ ? check_->first_bad() : std::nullopt; }
  // Kernels and scratch memory that the method asked for.
  size_t method_kernels() const { return context_.kernel_count(); }
  size_t method_bytes() const { return context_.scratch_bytes(); }

  // Direct light of the current view, outside any timing.
  Image render_direct();

 private:
  void draw_halves(Recorder& recorder);
  // One set of lights and its share of the image. Iteration 0 draws the halves, too.
  void render_iteration(uint32_t seed, uint32_t iteration, bool watched, FrameTimes* times);
  void arm_memory();
  void look_at_memory();
  std::string unwritten_lights(Half half) const;
  void trace_visibility();
  void make_importance(Recorder& recorder, glm::uvec2 shift);
  void reflectance_pdf(Recorder& recorder, Half half);
  void build_pdf_mips(Recorder& recorder, const Buffer& pdf, uint32_t width, uint32_t height);
  // Both halves' lights, by the method under test, on `pdf`, which may be null where it uses none.
  void generate_importance_lights(Recorder& recorder, const Buffer* pdf, glm::uvec2 shift);
  void generate_lights(Recorder& recorder, const Buffer* pdf, glm::uvec2 shift);
  void generate(Recorder& recorder, Method& method, const Field& field, const LightTarget& target);
  // Whether what is nearer to a VSGL's mean than its standard deviation is no occluder.
  bool clears_sigma() const;
  // Bias reduction and unfiltered lobes need a texel for each light.
  bool needs_light_texels() const;
  const Buffer& light_texels(Recorder& recorder);
  void shade(Recorder& recorder, uint32_t seed, uint32_t iteration);
  uint32_t upload_bits(uint32_t words, std::vector<const Buffer*>* buffers);
  std::vector<LightPoint> light_points() const;
  Buffer& pdf_buffer(Half half);
  Buffer& light_buffer(Half half) const;
  Method& importance_method() const { return other_method_ ? *other_method_ : *method_; }
  bool uses_importance() const { return method_->uses_importance(); }
  // Whether lights on the G-buffer make the PDF.
  bool lights_gbuffer() const { return uses_importance() && parameters_.importance != Importance::flux; }
  Field field(Half half, const Buffer* pdf);
  FrameOutputs outputs();  // what PassCheck asks this frame
  FrameOutputs::NamedBuffer named_output(const std::string& pass, const Buffer& buffer);
  void restart_check() {
    if (check_) check_->restart();
  }

  Stage& stage_;
  FrameParameters parameters_;
  MethodContext context_;
  std::unique_ptr<Method> method_;
  std::unique_ptr<MethodContext> other_context_;
  std::unique_ptr<Method> other_method_;  // of the importance, where that is not method_
  ExactVisibility exact_;
  std::unique_ptr<PassCheck> check_;  // null without check_passes
  Recorder recorder_;
  DeferredTargets *gbuffer_, *rsm_;
  gpu::Emitter camera_{}, light_{};
  Buffer camera_buffer_, light_view_buffer_;
  uint32_t light_count_ = 0, importance_count_ = 0;
  unsigned generate_dispatches_ = 0;
  MemoryWatch memory_;
  std::string memory_fault_;
  std::vector<LightPoint> traced_;  // the lights whose bits are in bits_
  std::vector<uint32_t> bits_;
};

// Scratch memory of a half's lights. Each size has its own: a method may clear its whole buffer, and what
// lies behind its lights is watched.
std::string light_memory(Half half, size_t bytes);

// Downloads one RGBA32F target.
std::vector<glm::vec4> download_map(const DeviceImage& image);

// A hash of the seed: a random shift, of seed 0 as of all others.
glm::uvec2 lattice_shift(uint32_t seed);

}  // namespace vsglbench
