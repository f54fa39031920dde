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
  size_t bytes;        // of a record
  // 32-bit words of a record that nobody reads and a kernel need not write; all others are floats.
  std::vector<size_t> unused;
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

inline size_t light_stride(LightKind kind) { return info_of(kind).bytes; }

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
