// Tests only: made-up halves on the device, and methods run on them without a scene.
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "base/file.h"
#include "method/filtered_sampling.h"
#include "method/oracle.h"
#include "method/registry.h"

namespace vsglbench {

inline Device& test_device() {
  static Device device;
  return device;
}

// The PDF pyramid in single precision, as the harness lays it out.
inline std::vector<float> pdf_pyramid(const oracle::Half& half) {
  const uint32_t w = half.emitter.width, h = half.emitter.height;
  std::vector<float> all;
  for (uint32_t l = 0; l <= pyramid_top(w, h); ++l) {
    const uint32_t b = 1u << l;
    for (uint32_t by = 0; by < (h + b - 1) / b; ++by) {
      for (uint32_t bx = 0; bx < (w + b - 1) / b; ++bx) {
        double sum = 0, n = 0;
        for (uint32_t y = by * b; y < std::min(h, (by + 1) * b); ++y) {
          for (uint32_t x = bx * b; x < std::min(w, (bx + 1) * b); ++x, n += 1)
            sum += half.pdf[size_t(y) * w + x];
        }
        all.push_back(static_cast<float>(sum / n));
      }
    }
  }
  return all;
}

// Runs `method` on `half` and returns its lights.
class MethodBench {
 public:
  explicit MethodBench(const std::string& method, const Json& parameters = Json::object())
      : kernels_(test_device()),
        scratch_(test_device()),
        recorder_(test_device()),
        info_(load_method(method, test_device().info())),
        context_(kernels_, scratch_, info_.folder),
        method_(info_.create(context_, resolve_parameters(info_, parameters))) {}

  template <class Light>
  std::vector<Light> lights(const oracle::Half& half, uint32_t count, glm::uvec2 shift = {0, 0}) {
    upload(half);
    Field field;
    field.emitter = half.emitter;
    for (size_t i = 0; i < 5; ++i) field.maps[i] = &maps_[i];
    field.pdf = &pdf_;
    Buffer out(test_device(), "lights", count * sizeof(Light));
    recorder_.begin();
    Steps steps(recorder_, Half::rsm);
    method_->generate(steps, field, {&out, count, shift});
    recorder_.submit_and_wait();
    return out.download<Light>(count);
  }

 private:
  void upload(const oracle::Half& half) {
    const uint32_t w = half.emitter.width, h = half.emitter.height;
    std::array<std::vector<glm::vec4>, 5> texels;
    for (const auto& t : half.texels) {
      texels[0].emplace_back(t.position, t.surface ? 1 : 0);
      texels[1].emplace_back(t.normal, t.ndf);
      texels[2].emplace_back(t.geometric_normal, 0);
      texels[3].emplace_back(t.diffuse, 0);
      texels[4].emplace_back(t.f0, 0);
    }
    for (size_t i = 0; i < 5; ++i) {
      maps_[i] = DeviceImage(test_device(), "map", VK_FORMAT_R32G32B32A32_SFLOAT, w, h,
                             VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
      maps_[i].upload(texels[i].data(), texels[i].size() * sizeof(glm::vec4));
    }
    const auto pyramid = pdf_pyramid(half);
    pdf_ = Buffer(test_device(), "pdf", pyramid.size() * sizeof(float));
    pdf_.upload(std::span<const float>(pyramid));
  }

  KernelLibrary kernels_;
  ScratchPool scratch_;
  Recorder recorder_;
  const MethodInfo& info_;
  MethodContext context_;
  std::unique_ptr<Method> method_;
  std::array<DeviceImage, 5> maps_;
  Buffer pdf_;
};

inline glm::uvec2 lattice_fixed(uint32_t i, uint32_t count, glm::uvec2 shift) {
  return glm::uvec2(i * lattice_step(count), i * 0x9E3779B9u) + shift;
}

// A spot over a wavy floor with random materials; `seed` decides materials, heights and the PDF.
inline oracle::Half random_half(uint32_t width, uint32_t height, uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  oracle::Half half;
  half.emitter = {.position = {0.3f, 4, 0.2f},
                  .perspective = 1,
                  .forward = {0, -1, 0},
                  .width = width,
                  .right = {1, 0, 0},
                  .height = height,
                  .up = {0, 0, -1},
                  .footprint_cosine = 0.1f,
                  .extent = {0.7f, 0.5f},
                  .power = {10, 8, 6},
                  .importance = 0};
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      oracle::Texel t;
      const glm::vec2 plane = {(2 * (x + 0.5f) / width - 1) * 0.7f, (1 - 2 * (y + 0.5f) / height) * 0.5f};
      const float depth = 3.5f + uniform();
      t.position = half.emitter.position + depth * glm::vec3(plane.x, -1, -plane.y);
      t.geometric_normal = glm::normalize(glm::vec3(0.4f * uniform(), 1, 0.4f * uniform()));
      t.normal = glm::normalize(t.geometric_normal + 0.2f * glm::vec3(uniform(), uniform(), uniform()));
      t.diffuse = 0.8f * glm::vec3(uniform(), uniform(), uniform());
      t.f0 = 0.3f * glm::vec3(uniform(), uniform(), uniform());
      t.ndf = uniform() < 0.5f ? 0.05f + 0.9f * uniform() : -(1 + 2000 * uniform());
      t.surface = uniform() > 0.05f;
      half.texels.push_back(t);
      half.pdf.push_back(t.surface ? 0.05f + uniform() * uniform() : 0.0f);
    }
  }
  return half;
}

}  // namespace vsglbench
