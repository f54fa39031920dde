// The importance: PDFs on both halves that say which texels matter to the camera [VSGL14 §3].
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame_parameters.h"
#include "frame/half_lights.h"

namespace vsglbench {

// PDFs on both halves as mip pyramids (shaders/pyramid.glsl), apart from the memory that every frame
// overwrites.
struct KeptPdfs {
  Buffer gbuffer, rsm;
};

class ImportancePass {
 public:
  // `own`: the method under test, which FrameParameters::importance may replace.
  ImportancePass(Stage& stage, const Halves& halves, const MethodInfo& own, const Json& method_parameters,
                 const FrameParameters& parameters);

  // Both PDFs: passes importance.gbuffer, generate.gbuffer.* and importance.rsm. Returns the dispatches of
  // generation. `carried`: null where this is no frame of an animation.
  unsigned record(Recorder& recorder, glm::uvec2 shift, CarriedLights* carried = nullptr);
  // The lights on the G-buffer alone, on kept PDFs.
  unsigned generate(Recorder& recorder, const KeptPdfs& pdfs, glm::uvec2 shift);
  KeptPdfs keep() const;

  // On the G-buffer; null where nobody's lights make the PDF.
  const HalfLights* lights() const { return lights_ ? &*lights_ : nullptr; }
  // In memory that every frame overwrites.
  const Buffer& pdf(Half half) const;
  size_t pdf_bytes(Half half) const;
  std::vector<float> read(Half half) const;  // level 0, of any scale
  // Whether the last lights were drawn from pdf(), not from kept PDFs.
  bool drawn_from_own() const { return drawn_from_own_; }

 private:
  void draw_reflectance(Recorder& recorder, Half half) const;
  void gather(Recorder& recorder) const;
  void build_mips(Recorder& recorder, Half half) const;
  Stage& stage_;
  const Halves& halves_;
  Shading shading_;
  EffectSet effects_;
  ImportanceNorm norm_;
  std::unique_ptr<LightGenerator> generator_;  // null where nobody's lights make the PDF
  std::optional<HalfLights> lights_;
  bool drawn_from_own_ = false;
};

}  // namespace vsglbench
