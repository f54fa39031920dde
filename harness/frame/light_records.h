// Lights read back, of whatever kind, and what the harness reads of each.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "method/light_kind.h"

namespace vsglbench {

// As the host has them: `count` records of light_stride(kind) bytes, with both lobes.
struct LightRecords {
  LightKind kind = LightKind::vsgl;
  std::vector<std::byte> bytes;

  size_t count() const { return bytes.size() / light_stride(kind); }
  // Light i, which is a Record.
  template <class Record>
  Record at(size_t i) const {
    Record record;
    std::memcpy(&record, &bytes[i * sizeof record], sizeof record);
    return record;
  }
  // visit(i, record) of every light, with the type that its record has.
  template <class Visit>
  void each(const Visit& visit) const {
    with_record(kind, [&](auto record) {
      for (size_t i = 0; i < count(); ++i) visit(i, at<decltype(record)>(i));
    });
  }
  // All, where the records are of this type; else none.
  template <class Record>
  std::vector<Record> all() const {
    std::vector<Record> out;
    each([&](size_t, const auto& light) {
      if constexpr (std::same_as<std::remove_cvref_t<decltype(light)>, Record>) out.push_back(light);
    });
    return out;
  }
  bool operator==(const LightRecords&) const = default;
};

// `lobes`: those that the records in the buffer have (shaders/types.h); the fields of others are 0,
// but for a width of 1.
LightRecords read_lights(LightKind kind, const Buffer& buffer, size_t count,
                         unsigned lobes = DIFFUSE_LOBE | SPECULAR_LOBE);
template <class Record>
LightRecords records_of(LightKind kind, const std::vector<Record>& lights) {
  const auto bytes = std::as_bytes(std::span(lights));
  return {kind, {bytes.begin(), bytes.end()}};
}

// What the harness reads of a light, whatever its record.
struct LightSummary {
  glm::vec3 position{0};  // m: the mean of a cluster
  float variance = 0;     // m², of a cluster, E|y-μ|²
  float radius = 0;       // m, of a sphere
  float power = 0;        // as the light states it, W
  double carried = 0;     // what it should state, by its lobes or its flux, W
  double reflected = 0;   // luminance of the reflected power, W
  glm::vec3 color{0};     // of the flux that it reflects, of any scale
  bool clamped = false;   // its geometry term has a bound
};
LightSummary summary_of(const gpu::Vsgl& light);
LightSummary summary_of(const gpu::Vpl& light);

std::vector<LightSummary> summaries_of(const LightRecords& lights);
uint64_t count_without_power(const LightRecords& lights);

// The floats of light i, without words that nobody reads.
std::vector<float> floats_of(const LightRecords& lights, size_t i);

}  // namespace vsglbench
