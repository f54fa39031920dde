// Random numbers by counter: a value depends on what it is for, never on who drew before it.
// Source: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", pcg4d.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace vsglbench {

// What the four numbers are for; part of the counter.
enum class Stream : uint32_t { footprint, pool, light, receiver, photon_plane, photon_direction };

inline glm::uvec4 pcg4d(glm::uvec4 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.w, v.y += v.z * v.x, v.z += v.x * v.y, v.w += v.y * v.z;
  v ^= v >> 16u;
  v.x += v.y * v.w, v.y += v.z * v.x, v.z += v.x * v.y, v.w += v.y * v.z;
  return v;
}

// Four times 32 uniform bits.
inline glm::uvec4 random_bits(uint64_t seed, Stream stream, uint32_t batch, uint32_t index) {
  const auto low = static_cast<uint32_t>(seed), high = static_cast<uint32_t>(seed >> 32);
  return pcg4d({index, batch, low, high * 8u + static_cast<uint32_t>(stream)});
}

// Bits to [0, 1), multiples of 2^-24.
inline float to_unit(uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }
inline glm::vec3 to_unit(const glm::uvec3& b) { return {to_unit(b.x), to_unit(b.y), to_unit(b.z)}; }

// Four uniform numbers in [0, 1).
inline glm::vec4 random4(uint64_t seed, Stream stream, uint32_t batch, uint32_t index) {
  const glm::uvec4 b = random_bits(seed, stream, batch, index);
  return {to_unit(b.x), to_unit(b.y), to_unit(b.z), to_unit(b.w)};
}

// A rank-1 lattice of n points in three dimensions, moved on the torus by `shift` (Cranley and Patterson
// 1976): Fibonacci's (i/n, frac(i/phi)) and one more additive recurrence, frac(i/sqrt 2). In units of 2^-32,
// where overflow is the torus.
class PointLattice {
 public:
  PointLattice(uint32_t n, const glm::uvec3& shift)
      : step_(static_cast<uint32_t>((uint64_t(1) << 32) / n), 0x9e3779b9u, 0xb504f334u), shift_(shift) {}
  glm::uvec3 bits(uint32_t i) const { return i * step_ + shift_; }
  glm::vec3 point(uint32_t i) const { return to_unit(bits(i)); }

 private:
  glm::uvec3 step_, shift_;
};

}  // namespace vsglbench
