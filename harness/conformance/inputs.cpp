#include "conformance/inputs.h"

#include <fmt/format.h>

#include <algorithm>

namespace vsglbench {
namespace {

using Pdf = ConformanceInput::Pdf;
using Surface = ConformanceInput::Surface;
using Light = ConformanceInput::Light;

// The texel that "one texel" means: in the middle.
glm::uvec2 chosen_texel(const ConformanceInput& in) { return {in.width / 2, in.height / 2}; }
size_t chosen_index(const ConformanceInput& in) {
  return size_t(chosen_texel(in).y) * in.width + chosen_texel(in).x;
}

std::string pdf_name(const ConformanceInput& in) {
  const glm::uvec2 t = chosen_texel(in);
  switch (in.pdf) {
    case Pdf::made:
      return "";
    case Pdf::zero:
      return ", PDF zero everywhere";
    case Pdf::uniform:
      return ", PDF uniform";
    case Pdf::one_texel:
      return fmt::format(", PDF zero but texel ({},{})", t.x, t.y);
    case Pdf::one_huge:
      return fmt::format(", PDF 1e12 times the rest's at texel ({},{})", t.x, t.y);
    case Pdf::checkerboard:
      return ", PDF a checkerboard";
  }
  return "";
}

std::string surface_name(const ConformanceInput& in) {
  const glm::uvec2 t = chosen_texel(in);
  switch (in.surface) {
    case Surface::made:
      return "";
    case Surface::none:
      return ", no surface anywhere";
    case Surface::one_texel:
      return fmt::format(", a surface at texel ({},{}) only", t.x, t.y);
    case Surface::black:
      return ", black surfaces";
    case Surface::coincident:
      return ", all texels at one point";
    case Surface::mirror:
      return ", mirror-like surfaces";
    case Surface::far:
      return ", 10 km from the origin";
  }
  return "";
}

void set_pdf(const ConformanceInput& in, oracle::Half& half) {
  for (size_t i = 0; i < half.pdf.size(); ++i) {
    const bool chosen = i == chosen_index(in);
    const size_t x = i % in.width, y = i / in.width;
    switch (in.pdf) {
      case Pdf::made:
        break;
      case Pdf::zero:
        half.pdf[i] = 0;
        break;
      case Pdf::uniform:
        half.pdf[i] = 3;
        break;
      case Pdf::one_texel:
        half.pdf[i] = chosen ? 1.0f : 0.0f;
        break;
      case Pdf::one_huge:
        half.pdf[i] = chosen ? 1e12f : 1.0f;
        break;
      case Pdf::checkerboard:
        half.pdf[i] = (x + y) % 2 ? 1.0f : 0.0f;
        break;
    }
  }
}

void set_surface(const ConformanceInput& in, oracle::Half& half) {
  const glm::vec3 far = glm::vec3(1e4f, 0, 1e4f);
  if (in.surface == Surface::far) half.emitter.position += far;
  for (size_t i = 0; i < half.texels.size(); ++i) {
    oracle::Texel& t = half.texels[i];
    switch (in.surface) {
      case Surface::made:
        break;
      case Surface::none:
        t.surface = false;
        break;
      case Surface::one_texel:
        t.surface = i == chosen_index(in);
        break;
      case Surface::black:
        t.diffuse = t.f0 = glm::vec3(0);
        break;
      case Surface::coincident:
        t.position = half.emitter.position - glm::vec3(0, 4, 0);
        break;
      case Surface::mirror:
        t.ndf = i % 2 ? 1e-3f : -1e7f;  // the sharpest GGX and Phong lobes a scene can have
        break;
      case Surface::far:
        t.position += far;
        break;
    }
  }
}

}  // namespace

std::string ConformanceInput::name() const {
  return fmt::format("half {} {}×{}, N = {}{}{}{}", half_name(half), width, height, count, pdf_name(*this),
                     surface_name(*this), light == Light::off ? ", a light of no flux" : "");
}

oracle::Half ConformanceInput::make() const {
  oracle::Half made = random_half(width, height, 1);
  // The one texel of an input must be there to be chosen.
  made.texels[chosen_index(*this)].surface = true;
  made.pdf[chosen_index(*this)] = 1;
  set_surface(*this, made);
  set_pdf(*this, made);
  if (light == Light::off) made.emitter.power = glm::vec3(0);
  if (half == Half::gbuffer) look_from_eye(made);
  return made;
}

bool ConformanceInput::powerless(LightKind kind) const {
  const bool black = surface == Surface::black && !info_of(kind).power_is_incident;
  return surface == Surface::none || pdf == Pdf::zero || light == Light::off || black;
}

std::vector<ConformanceInput> all_inputs(Half half) {
  std::vector<ConformanceInput> inputs = {
      {half, 1, 1, 1},  {half, 7, 5, 1},     {half, 7, 5, 35},     {half, 1, 64, 64},
      {half, 64, 1, 3}, {half, 61, 35, 100}, {half, 64, 64, 4096}, {half, 33, 17, 561},
  };
  for (const glm::uvec3 size : {glm::uvec3(1, 1, 1), glm::uvec3(7, 5, 35), glm::uvec3(64, 48, 64)}) {
    const auto with = [&](Pdf pdf, Surface surface, Light light = Light::on) {
      inputs.push_back({half, size.x, size.y, size.z, pdf, surface, light});
    };
    for (const Pdf pdf : {Pdf::zero, Pdf::uniform, Pdf::one_texel, Pdf::one_huge}) with(pdf, Surface::made);
    with(Pdf::zero, Surface::none);
    with(Pdf::uniform, Surface::none);
    with(Pdf::uniform, Surface::one_texel);
    with(Pdf::uniform, Surface::black);
    if (half == Half::rsm) with(Pdf::zero, Surface::made, Light::off);
    if (half == Half::rsm) with(Pdf::uniform, Surface::made, Light::off);
    if (size.x < 7) continue;  // one texel has no neighbours
    with(Pdf::checkerboard, Surface::made);
    with(Pdf::made, Surface::coincident);
    with(Pdf::made, Surface::mirror);
    with(Pdf::made, Surface::far);
  }
  // The sizes of [MFIS16 §5].
  if (half == Half::rsm) inputs.push_back({half, 512, 512, 1024});
  if (half == Half::gbuffer) inputs.push_back({half, 1920, 1088, 2048});
  return inputs;
}

std::vector<ConformanceInput> few_inputs(Half half) {
  return {{half, 1, 1, 1},
          {half, 7, 5, 35},
          {half, 61, 35, 100},
          {half, 64, 48, 64, Pdf::zero},
          {half, 64, 48, 64, Pdf::one_texel},
          {half, 64, 48, 64, Pdf::uniform, Surface::none}};
}

}  // namespace vsglbench
