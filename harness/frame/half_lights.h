// A method at work, and its lights on one half.
#pragma once

#include <memory>
#include <string>

#include "frame/carried.h"
#include "frame/halves.h"
#include "frame/light_records.h"
#include "frame/permutation.h"
#include "frame/shading.h"

namespace vsglbench {

// A method with fixed parameters. Throws Error(plugin) for what no method may be.
class LightGenerator {
 public:
  // `half`: on which it makes lights; a method has one object for each.
  LightGenerator(Stage& stage, const MethodInfo& info, const Json& parameters, const Shading& shading,
                 const EffectSet& effects, Half half);
  LightGenerator(const LightGenerator&) = delete;
  LightGenerator& operator=(const LightGenerator&) = delete;
  const std::string& name() const { return name_; }
  Method& method() const { return *method_; }
  const MethodContext& context() const { return context_; }  // what it has asked for

 private:
  std::string name_;
  MethodContext context_;
  std::unique_ptr<Method> method_;
};

class HalfLights {
 public:
  // As many as the generator makes when asked for `wanted`.
  HalfLights(Stage& stage, const Halves& halves, const LightGenerator& generator, Half half, uint32_t wanted);
  // Records the passes generate.HALF.*; returns their dispatches. `pdf` may be null where the method uses
  // none, and `carried` where this is no frame of an animation.
  unsigned generate(Recorder& recorder, const Buffer* pdf, glm::uvec2 shift,
                    CarriedLights* carried = nullptr) const;

  const LightGenerator& generator() const { return generator_; }
  Half half() const { return half_; }
  uint32_t count() const { return count_; }
  LightKind kind() const { return generator_.method().kind(); }
  unsigned lobes() const { return generator_.context().lobes(); }
  size_t bytes() const { return count_ * light_stride(kind(), lobes()); }
  const Buffer& buffer() const;
  LightRecords read() const { return read_lights(kind(), buffer(), count_, lobes()); }

 private:
  Stage& stage_;
  const Halves& halves_;
  const LightGenerator& generator_;
  Half half_;
  uint32_t count_;
};

// Defines of the kernels that evaluate lights of this kind, but for permutation(): `shading` is not read by
// all.
ShaderDefines light_defines(LightKind kind, const Shading& shading);

}  // namespace vsglbench
