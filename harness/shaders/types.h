// Structs that C++ and GLSL both include: one definition, scalar layout (no hidden padding).
#ifndef VSGLBENCH_TYPES_H
#define VSGLBENCH_TYPES_H

// Lobes, as bits. What the effects that a scene calls for leave of a kernel is said by four values, which
// frame/permutation.h sets:
//  SURFACE_LOBES  of the surfaces that it loads from the deferred targets
//  LIGHT_LOBES    of the lights that it makes or evaluates
//  FACE_NORMALS   1: every shading normal is its face's, but for the bend towards the viewer, and one map
//                 holds both
//  PHONG_LOBES    0: no surface's normal distribution is Phong's, all are GGX's
// A half where no surface reflects keeps the diffuse lobe.
#define DIFFUSE_LOBE 1
#define SPECULAR_LOBE 2

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
// The host's records hold both lobes; frame/light_records.h fills those in that a kernel left out.
#define LIGHT_LOBES 3
namespace vsglbench::gpu {
using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = uint32_t;
#else
#extension GL_EXT_scalar_block_layout : require
#ifndef SURFACE_LOBES
#define SURFACE_LOBES 3
#endif
#ifndef LIGHT_LOBES
#define LIGHT_LOBES 3
#endif
#ifndef FACE_NORMALS
#define FACE_NORMALS 0
#endif
#ifndef PHONG_LOBES
#define PHONG_LOBES 1
#endif
#endif

// A virtual spherical Gaussian light [MFIS16 App. B]: both lobes share mean and variance. A kernel compiled
// without a lobe has no fields of it.
struct Vsgl {
  vec3 mean;       // μ_v, metres
  float variance;  // σ_v², metres², 3-D: E|y-μ|²
#if LIGHT_LOBES & DIFFUSE_LOBE
  vec3 diffuse;  // c_v of the diffuse lobe, W/sr
  float diffuse_sharpness;
  vec3 diffuse_axis;  // unit; the power-weighted mean normal
#endif
  float level;  // mip level of the kernel, for pictures and statistics; -1 where there is none
#if LIGHT_LOBES & SPECULAR_LOBE
  vec3 specular;  // c_v of the specular lobe, W/sr
  float specular_sharpness;
  vec3 specular_axis;  // unit
#endif
  float power;  // luminance of the reflected power of both lobes, W; 0 = no light
};

// A virtual point light with its exact BRDF [VSGL14 Eq. 1]; one with a radius is a virtual spherical light
// [VSGL14 Eq. 2].
struct Vpl {
  vec3 position;
#if LIGHT_LOBES & SPECULAR_LOBE
  float ndf;  // > 0: GGX alpha; < 0: minus the Phong exponent
#endif
  vec3 normal;            // shading normal, unit
  float power;            // luminance of the incident flux, W; 0 = no light
  vec3 geometric_normal;  // unit, towards the primary light's side
  float radius;           // m, of a virtual spherical light; 0: a point
  vec3 incident;          // unit, from the surface towards the primary light
  float clamp;            // bound on a point's geometry term cos cos/d², 1/m²; 0: none
  vec3 flux;              // incident flux that this light stands for, W
  float samples;          // of a virtual spherical light seen under a half angle of π/2
#if LIGHT_LOBES & DIFFUSE_LOBE
  vec3 diffuse;  // Rd
  float unused0;
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  vec3 f0;  // F0
  float unused1;
#endif
};

// A VSGL as `shading` filtered evaluates it: at its mean, the exact BRDF of the RSM's texel there
// (frame/filtered_lights.comp). It has no power where all of its colours are 0.
struct FilteredLight {
  vec3 mean;       // metres
  float variance;  // metres², 3-D
  vec3 normal;     // unit
#if LIGHT_LOBES & DIFFUSE_LOBE
  vec3 diffuse;  // Φ Rd/π, W/sr
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  float ndf;      // > 0: GGX alpha; < 0: minus the Phong exponent
  vec3 incident;  // unit, from the surface towards the primary light, above its horizon
  vec3 flux;      // incident, W
  vec3 f0;        // F0
#endif
};

// What emits into a half: the primary light (RSM), or the eye (G-buffer; importance 1/pixels each).
struct Emitter {
  vec3 position;
  uint perspective;  // 0: orthographic along `forward`
  vec3 forward;
  uint width;  // texels
  vec3 right;
  uint height;
  vec3 up;
  float footprint_cosine;  // footprints are measured at no more grazing an angle than this cosine
  vec2 extent;             // tangents of the half angles, or half sizes in metres
  vec3 power;              // W/sr (perspective) or W/m² (orthographic); unused where importance = 1
  uint importance;         // 1: every texel emits 1/(width height)
};

// One draw of the rasteriser.
struct DrawPush {
  mat4 view_projection;
  vec4 base_color;
  float metallic;
  float roughness;
  float phong_exponent;
  float specular;
  float alpha_cutoff;
  float normal_scale;
  uint textures;        // that the material has: bit 0 base colour, bit 1 metallic-roughness, bit 2 normal
  uint first_triangle;  // of this draw, for the face normals
};

#ifdef __cplusplus
struct Vertex {
  vec3 position;
  vec3 normal;
  vec4 tangent;
  vec2 uv;
};
static_assert(sizeof(Vsgl) == 80 && sizeof(Vpl) == 112 && sizeof(FilteredLight) == 80 &&
              sizeof(Emitter) == 88 && sizeof(DrawPush) == 112);
static_assert(sizeof(Vertex) == 48);
}  // namespace vsglbench::gpu
#endif
#endif
