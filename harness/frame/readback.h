// What a frame left on the device, read back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frame/frame_parts.h"
#include "image/image.h"

namespace vsglbench {

// What the pixels say beside their colour; each is absent where the case does not have it.
struct ShadingNotes {
  std::optional<double> clamp_removed;      // luminance that VPLs' clamp took away / luminance without it
  std::optional<double> cancellation_rate;  // mean share of lights shaded with exact BRDFs [VSGL14 Fig. 6]
  std::optional<Image> cancellation;        // that share by pixel, grey
};

// Lights with a NaN, or else an Inf, in any field; or such texels of the PDF.
struct BadValues {
  PassId pass;  // that left them
  bool are_lights = true;
  uint64_t nan = 0, inf = 0;  // of lights: on both halves
  uint64_t first = 0;         // index among those of the pass
  glm::uvec2 texel{0};        // of the PDF
  // "3 lights with a NaN and 1 with an Inf, the first is light 7 of generate.rsm"
  std::string message() const;
};

class FrameReadback {
 public:
  explicit FrameReadback(const FrameParts& parts) : parts_(parts) {}

  Image indirect() const;
  ShadingNotes shading_notes() const;
  // Whether the notes have a cancellation rate.
  bool reduces_bias() const { return parts_.shade.reduces_bias(); }
  std::vector<uint8_t> surface_mask() const;  // 1 where the camera sees a surface
  LightRecords lights() const { return parts_.lights.read(); }
  // What the pixels were shaded by where the shading is filtered; else none.
  std::vector<gpu::FilteredLight> filtered_lights() const { return parts_.shade.read_filtered_lights(); }
  std::vector<float> importance() const;  // the PDF on the RSM, of any scale; empty when unused

  // On the RSM: Σ over its lights, and over its texels, of the luminance of the reflected power, W.
  double light_power() const;
  double texel_power() const;
  // Whether the PDF on the RSM is above 0 anywhere; true where none is used.
  bool has_importance() const;

  // What of these the importance left: lights on the G-buffer, or texels of the PDF on the RSM.
  std::optional<BadValues> bad_importance() const;
  // The first of generate.gbuffer, importance.rsm and generate.rsm that left a NaN or Inf: in the image there
  // may be nothing of it.
  std::optional<BadValues> bad_values() const;
  // The first pass, in the order of the frame, whose output holds a NaN or Inf.
  std::optional<PassId> first_bad_pass() const;

 private:
  const FrameParts& parts_;
};

// Downloads one RGBA32F target.
std::vector<glm::vec4> download_map(const DeviceImage& image);

}  // namespace vsglbench
