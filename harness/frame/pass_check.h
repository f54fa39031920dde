// The health gate: which pass was the first to write a NaN or Inf, and where.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "frame/scene_gpu.h"
#include "gpu/recorder.h"

namespace vsglbench {

struct BadOutput {
  PassId pass;
  std::string buffer;     // "moments.specular_powers.rsm"; "rsm normal" of a raster pass
  std::string field;      // of the element: "power", "mean.x"; empty where the element is one number
  bool is_nan = true;     // else Inf
  uint64_t element = 0;   // index of the first that is bad
  bool is_light = false;  // the element is a light
  std::optional<glm::uvec2> texel;  // where the buffer has an element for each texel of the pass's half
  std::optional<uint32_t> level;    // where it has one for each texel of a mip pyramid
  uint64_t nan = 0, inf = 0;        // elements of the buffer with a NaN, or else an Inf

  // "pass generate.rsm.mipmap is the first to hold a NaN: buffer moments.specular_powers.rsm, element 1234
  // (x), texel (12, 3) of level 2"
  std::string message() const;
};

// What only the frame knows of what a pass wrote.
struct FrameOutputs {
  struct NamedBuffer {
    std::string name;  // empty: that of the kernel's block will do
    size_t bytes = 0;  // that are in use
    bool holds_lights = false;
  };
  struct HalfSize {
    glm::uvec2 texels{0};
    uint64_t lights = 0;
  };
  std::function<NamedBuffer(const PassId& pass, const Buffer& buffer)> buffer;
  std::function<HalfSize(const PassId& pass)> half;                   // zeros for a pass of neither half
  std::function<const DeferredTargets*(const PassId& pass)> targets;  // of a raster pass; else null
};

// After each pass: the targets of a raster pass, and all 32-bit floats of the storage buffers that its
// kernels may write (FloatOutputs). NaN is bad everywhere; Inf is not where the kernel's code names it, as
// the kd-tree's does for empty boxes. What a buffer held before its first use in the frame is another case's:
// NaN and Inf among that become 0, so that nobody is blamed for them.
class PassCheck : public PassObserver {
 public:
  explicit PassCheck(FrameOutputs outputs) : outputs_(std::move(outputs)) {}
  void restart();  // at the start of a frame
  const std::optional<BadOutput>& first_bad() const { return bad_; }

  void before(const PassRecord& pass) override;
  void after(const PassRecord& pass) override;

 private:
  void check_targets(const PassId& pass, const DeferredTargets& targets);
  void check(const PassId& pass, const PassRecord::Use& use);
  void locate(const PassId& pass, uint64_t elements);

  FrameOutputs outputs_;
  std::optional<BadOutput> bad_;
  // What this frame has looked at. A buffer that has grown under the same name is another one.
  std::set<std::tuple<const Buffer*, VkBuffer, size_t>> used_;
};

}  // namespace vsglbench
