// The kinds of light there are, one row each: what a new kind must say of itself. Its record stands in
// shaders/types.h, its shading in shaders/light_shading.glsl.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "gpu/shader_compiler.h"
#include "shaders/types.h"

namespace vsglbench {

// vsl: Vpl records with a radius, virtual spherical lights.
enum class LightKind { vsgl, vpl, vsl };

struct LightKindInfo {
  LightKind kind;
  const char* name;    // in reports and configs
  const char* record;  // the struct, in GLSL
  size_t bytes;        // of a record with both lobes, as the host has it
  // 32-bit words of a record that nobody reads and a kernel need not write; all others are floats.
  std::vector<size_t> unused;
  // Those of each lobe, which a kernel compiled without it does not have.
  std::vector<size_t> diffuse_words, specular_words;
  // `power` is the luminance of the incident flux, whatever the surface reflects; else of the reflected
  // power.
  bool power_is_incident;
  // A config's shading keys choose how it is shaded; else they are not read.
  bool reads_shading;
  ShaderDefines record_defines;  // of every kernel that reads its records
  ShaderDefines
      shading_defines;  // of shade.comp besides: on the G-buffer, importance takes lights for points
  const char* marks;    // what pictures of the lights show, in words
};

std::vector<LightKind> light_kinds();
bool is_light_kind(LightKind kind);
const LightKindInfo& info_of(LightKind kind);

// The words of the host's record that a kernel's record has, in order; `lobes` as in shaders/types.h.
std::vector<size_t> record_words(LightKind kind, unsigned lobes);
// Bytes of a kernel's record.
size_t light_stride(LightKind kind, unsigned lobes = DIFFUSE_LOBE | SPECULAR_LOBE);
// Bytes of `Moments` (shaders/moments.glsl) in scalar layout.
size_t moments_bytes(unsigned lobes);

// act(record), with a record of the type that lights of this kind have.
template <class Act>
decltype(auto) with_record(LightKind kind, const Act& act) {
  switch (kind) {
    case LightKind::vsgl:
      return act(gpu::Vsgl{});
    case LightKind::vpl:
    case LightKind::vsl:
      return act(gpu::Vpl{});
  }
  throw std::logic_error("a light of no kind");
}

}  // namespace vsglbench
