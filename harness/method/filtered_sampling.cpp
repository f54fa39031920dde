#include "method/filtered_sampling.h"

#include <algorithm>
#include <map>

namespace vsglbench {
namespace {

// Of the buffers of lights with these lobes, in the order of their bindings (shaders/moments_buffers.glsl).
std::vector<std::string> moment_names(unsigned lobes, Half half) {
  std::vector<std::string> names = {"places"};
  if (lobes & DIFFUSE_LOBE) names.insert(names.end(), {"diffuse_powers", "diffuse_directions"});
  if (lobes & SPECULAR_LOBE) names.insert(names.end(), {"specular_powers", "specular_directions"});
  for (std::string& name : names) name = fmt::format("moments.{}.{}", name, half_name(half));
  return names;
}

}  // namespace

uint32_t pyramid_top(uint32_t width, uint32_t height) {
  uint32_t level = 0;
  while ((uint64_t{1} << level) < std::max(width, height)) ++level;
  return level;
}

uint64_t pyramid_texels(uint32_t width, uint32_t height) {
  uint64_t total = 0;
  for (uint32_t level = 0; level <= pyramid_top(width, height); ++level) {
    const uint64_t round = (uint64_t{1} << level) - 1;
    total += ((width + round) >> level) * ((height + round) >> level);
  }
  return total;
}

MomentPyramid::MomentPyramid(MethodContext& context)
    : context_(context),
      resolve_(context.shared_kernel("resolve.comp")),
      mip_(context.shared_kernel("moments_mip.comp")) {}

MomentBuffers MomentPyramid::build(Steps& steps, const Field& field) {
  const uint32_t w = field.emitter.width, h = field.emitter.height;
  MomentBuffers moments;
  for (const std::string& name : moment_names(context_.lobes(), field.half))
    moments.buffers.push_back(&context_.scratch(name, pyramid_texels(w, h) * 16));
  Recorder& r = steps.recorder();
  steps.pass("resolve", [&] {
    r.dispatch(resolve_, {field.maps, moments}, field.emitter, groups_for(w, 16), groups_for(h, 16));
  });
  steps.pass("mipmap", [&] {
    for (uint32_t level = 2; level <= pyramid_top(w, h); level += 2) {
      const struct { uint32_t width, height, level; } push{w, h, level};
      r.dispatch(mip_, {moments}, push, groups_for(groups_for(w, 2u << level), 8),
                 groups_for(groups_for(h, 2u << level), 8));
      r.barrier();
    }
  });
  return moments;
}

MomentBuffers built_moments(const MethodContext& context, Half half) {
  MomentBuffers moments;
  for (const std::string& name : moment_names(context.lobes(), half)) {
    const auto used = context.scratch_buffers().find(name);
    if (used == context.scratch_buffers().end()) return {};
    moments.buffers.push_back(used->second.buffer);
  }
  return moments;
}

namespace {

class FilteredSampling : public Method {
 public:
  FilteredSampling(MethodContext& context, const std::string& file, float footprint_size,
                   const ShaderDefines& defines, size_t carried_bytes)
      : context_(context),
        file_(file),
        defines_(defines),
        pyramid_(context),
        sample_(context.kernel(file, defines)),
        footprint_size_(footprint_size),
        carried_bytes_(carried_bytes) {}

  LightKind kind() const override { return LightKind::vsgl; }

  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    const MomentBuffers moments = pyramid_.build(steps, field);
    steps.pass("sample", [&] {
      const Push push{field.emitter.width,        field.emitter.height, target.count,
                      lattice_step(target.count), target.shift,         footprint_size_};
      Buffer& squares = context_.scratch(fmt::format("squares.{}", half_name(field.half)),
                                         target.count * sizeof(glm::vec4));
      squares_[field.half] = &squares;
      Recorder& r = steps.recorder();
      const uint32_t groups = groups_for(target.count, 64);
      if (!target.carried.buffer)
        return r.dispatch(sample_, {*field.pdf, moments, *target.buffer, squares}, push, groups);
      const struct {
        Push push;
        uint32_t frame;
      } carried{push, target.carried.frame};
      r.dispatch(carrying(), {*field.pdf, moments, *target.buffer, squares, *target.carried.buffer}, carried,
                 groups);
    });
  }

  LightShapes shapes(Half half) override { return {.squares = squares_[half]}; }
  size_t carried_bytes(uint32_t lights) const override { return carried_bytes_ * lights; }

 private:
  struct Push {
    uint32_t width, height, count, step;
    glm::uvec2 shift;
    float footprint_size;
  };
  const Kernel& carrying() {
    ShaderDefines defines = defines_;
    defines.emplace("CARRIED", "1");
    return context_.kernel(file_, defines);
  }
  MethodContext& context_;
  const std::string file_;
  const ShaderDefines defines_;
  std::map<Half, const Buffer*> squares_;
  MomentPyramid pyramid_;
  const Kernel& sample_;
  float footprint_size_;
  size_t carried_bytes_;  // of a light
};

}  // namespace

std::unique_ptr<Method> make_filtered_sampling(MethodContext& context, const std::string& kernel_file,
                                               float footprint_size, const ShaderDefines& defines,
                                               size_t carried_bytes) {
  return std::make_unique<FilteredSampling>(context, kernel_file, footprint_size, defines, carried_bytes);
}

}  // namespace vsglbench
