// Tests only: positions and centres on a device, and the brute force and FLANN that check the searches.
#pragma once

#include <flann/flann.hpp>
#include <limits>
#include <thread>

#include "method/nearest_centre.h"
#include "method/test_field.h"

namespace vsglbench {

using Points = std::vector<glm::vec4>;  // w > 0: there is one
using Ids = std::vector<uint32_t>;
using Search = NearestCentre::Search;

inline float random_unit(std::mt19937& random) { return static_cast<float>(random() >> 8) * 0x1p-24f; }

inline KernelLibrary& test_kernels() {
  static KernelLibrary kernels(test_device());
  return kernels;
}

// Positions and centres on a device, and what the searches make of them.
class NearestBench {
 public:
  NearestBench(glm::uvec2 size, const Points& positions, KernelLibrary& kernels = test_kernels())
      : device_(kernels.device()), scratch_(device_), context_(kernels, scratch_, {}), recorder_(device_) {
    field_.emitter.width = size.x;
    field_.emitter.height = size.y;
    map_ = DeviceImage(device_, "position", VK_FORMAT_R32G32B32A32_SFLOAT, size.x, size.y,
                       VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    map_.upload(positions.data(), positions.size() * sizeof(glm::vec4));
    field_.maps.position = &map_;
  }

  Ids ids(const Points& centres, int dimensions, Search search) {
    const auto count = static_cast<uint32_t>(centres.size());
    Buffer in(device_, "centres", centres.size() * sizeof(glm::vec4));
    in.upload(std::span<const glm::vec4>(centres));
    return run(dimensions, search, in, count, [] {});
  }

  // One search after the other in one submission.
  std::pair<Ids, Ids> in_one_frame(const Points& first, const Points& second, int dimensions, Search search) {
    NearestCentre nearest(context_, dimensions, search);
    Buffer in[2], out[2];
    recorder_.begin();
    for (const int i : {0, 1}) {
      const Points& centres = i == 0 ? first : second;
      in[i] = Buffer(device_, "centres", centres.size() * sizeof(glm::vec4));
      in[i].upload(std::span<const glm::vec4>(centres));
      out[i] = Buffer(device_, "ids", field_.texels() * 4);
      recorder_.pass({.step = "assign"}, [&] {
        nearest.record(recorder_, field_, in[i], static_cast<uint32_t>(centres.size()), out[i]);
      });
    }
    recorder_.submit_and_wait();
    return {out[0].download<uint32_t>(field_.texels()), out[1].download<uint32_t>(field_.texels())};
  }

  // Centres by warping `pdf` (a whole pyramid), then their search.
  std::pair<Points, Ids> sampled(const std::vector<float>& pdf, uint32_t count, int dimensions,
                                 Search search) {
    Buffer pyramid(device_, "pdf", pdf.size() * sizeof(float));
    pyramid.upload(std::span<const float>(pdf));
    field_.pdf = &pyramid;
    Buffer centres(device_, "centres", count * sizeof(glm::vec4));
    CentreSampler sampler(context_, dimensions);
    const Ids out = run(dimensions, search, centres, count,
                        [&] { sampler.record(recorder_, field_, kShift, centres, count); });
    return {centres.download<glm::vec4>(count), out};
  }

  static constexpr glm::uvec2 kShift{0x12345678u, 0x9abcdef0u};

 private:
  template <class Before>
  Ids run(int dimensions, Search search, const Buffer& centres, uint32_t count, const Before& before) {
    NearestCentre nearest(context_, dimensions, search);
    Buffer out(device_, "ids", field_.texels() * 4);
    recorder_.begin();
    recorder_.pass({.step = "assign"}, [&] {
      before();
      nearest.record(recorder_, field_, centres, count, out);
    });
    recorder_.submit_and_wait();
    return out.download<uint32_t>(field_.texels());
  }

  Device& device_;
  ScratchPool scratch_;
  MethodContext context_;
  Recorder recorder_;
  Field field_;
  DeviceImage map_;
};

inline glm::vec3 query_of(const Points& positions, glm::uvec2 size, int dimensions, size_t i) {
  return dimensions == 2 ? glm::vec3(i % size.x + 0.5f, i / size.x + 0.5f, 0) : glm::vec3(positions[i]);
}

// The expression of shaders/nearest_centre.comp.
inline float squared(glm::vec3 a, glm::vec3 b, int dimensions) {
  const glm::vec3 d = a - b;
  const float s = d.x * d.x + d.y * d.y;
  return dimensions == 2 ? s : s + d.z * d.z;
}

inline Ids brute_force(const Points& positions, glm::uvec2 size, const Points& centres, int dimensions) {
  Ids out;
  for (size_t i = 0; i < positions.size(); ++i) {
    uint32_t nearest = static_cast<uint32_t>(centres.size());
    float best = std::numeric_limits<float>::infinity();
    for (uint32_t c = 0; c < centres.size() && positions[i].w > 0; ++c) {
      const float d = squared(query_of(positions, size, dimensions, i), centres[c], dimensions);
      if (centres[c].w > 0 && d < best) {
        best = d;
        nearest = c;
      }
    }
    out.push_back(nearest);
  }
  return out;
}

inline size_t differences(const Ids& a, const Ids& b) {
  size_t n = a.size() == b.size() ? 0 : SIZE_MAX;
  for (size_t i = 0; n != SIZE_MAX && i < a.size(); ++i) n += a[i] != b[i];
  return n;
}

// A floor, a back wall and thin posts before it: jumps of depth within a tile. 5 % have no surface.
inline Points posts(glm::uvec2 size, float missing = 0.05f, glm::vec3 offset = glm::vec3(0)) {
  std::mt19937 random(size.x * 131 + size.y);
  Points out;
  for (uint32_t y = 0; y < size.y; ++y) {
    for (uint32_t x = 0; x < size.x; ++x) {
      const glm::vec3 ray((x + 0.5f) / size.x * 2 - 1, 1 - (y + 0.5f) / size.y * 2, 1);
      float t = ray.y < 0 ? std::min(12.0f, -1.7f / ray.y) : 12.0f;
      if (x / 9 % 7 == 3) t = std::min(t, 2.0f + static_cast<float>(x / 63 % 5));
      out.emplace_back(offset + t * ray, random_unit(random) < missing ? 0 : 1);
    }
  }
  return out;
}

// `count` centres at random texels; `concentrated`: 90 % of them in 5 % of the image.
inline Points random_centres(const Points& positions, glm::uvec2 size, int dimensions, size_t count,
                             bool concentrated = false) {
  std::mt19937 random(static_cast<uint32_t>(count) + 5);
  Points out;
  for (size_t i = 0; i < count; ++i) {
    glm::uvec2 at(random() % size.x, random() % size.y);
    if (concentrated && i % 10 != 0) at = at * 2u / 9u + size / 2u;
    const size_t texel = size_t(at.y) * size.x + at.x;
    out.emplace_back(query_of(positions, size, dimensions, texel), dimensions == 2 ? 1 : positions[texel].w);
  }
  return out;
}

// Squared distances to the nearest centres by FLANN, over all texels.
inline std::vector<float> flann_distances(const Points& positions, glm::uvec2 size, const Points& centres,
                                          int dimensions) {
  std::vector<float> from, to;
  for (const auto& c : centres) {
    for (int a = 0; a < dimensions && c.w > 0; ++a) to.push_back(c[a]);
  }
  for (size_t i = 0; i < positions.size(); ++i) {
    const glm::vec3 q = query_of(positions, size, dimensions, i);
    for (int a = 0; a < dimensions; ++a) from.push_back(q[a]);
  }
  std::vector<int> nearest(positions.size());
  std::vector<float> out(positions.size());
  const size_t d = dimensions;
  flann::KDTreeSingleIndex<flann::L2_Simple<float>> index({to.data(), to.size() / d, d},
                                                          flann::KDTreeSingleIndexParams());
  index.buildIndex();
  const auto search = [&](size_t begin, size_t end) {
    flann::Matrix<int> ids(nearest.data() + begin, end - begin, 1);
    flann::Matrix<float> distances(out.data() + begin, end - begin, 1);
    index.knnSearch({from.data() + begin * d, end - begin, d}, ids, distances, 1,
                    flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED));
  };
  std::thread other(search, 0, positions.size() / 2);
  search(positions.size() / 2, positions.size());
  other.join();
  return out;
}

}  // namespace vsglbench
