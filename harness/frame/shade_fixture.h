// Tests only: a G-buffer of random surfaces, on the device and in double, and shade.comp run on it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/file.h"
#include "frame/frame.h"
#include "shaders/shading_exact.h"

namespace vsglbench {

class ShadeTest : public ::testing::Test {
 protected:
  static constexpr uint32_t kWidth = 37, kHeight = 11, kLights = 50;
  using dvec3 = glm::dvec3;

  ShadeTest() : random_(99) {
    camera_ = {.position = {0, 0, 3},
               .perspective = 1,
               .forward = {0, 0, -1},
               .width = kWidth,
               .right = {1, 0, 0},
               .height = kHeight,
               .up = {0, 1, 0},
               .footprint_cosine = 0.1f,
               .extent = {1, 1},
               .power = {1, 1, 1},
               .importance = 1};
    std::array<std::vector<glm::vec4>, 5> maps;
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) add_pixel(maps);
    for (size_t i = 0; i < 5; ++i) {
      images_.emplace_back(device(), "map", VK_FORMAT_R32G32B32A32_SFLOAT, kWidth, kHeight,
                           VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
      images_.back().upload(maps[i].data(), maps[i].size() * sizeof(glm::vec4));
    }
  }

  static Device& device() {
    static Device device;
    return device;
  }
  static KernelLibrary& kernels() {
    static KernelLibrary kernels(device());
    return kernels;
  }

  float uniform() { return static_cast<float>(random_() >> 8) * 0x1p-24f; }
  glm::vec3 color() {
    const float r = uniform(), g = uniform(), b = uniform();
    return {r, g, b};
  }
  glm::vec3 direction() {
    const float z = 2 * uniform() - 1, p = 6.2831853f * uniform(), r = std::sqrt(std::max(1 - z * z, 0.0f));
    return {r * std::cos(p), r * std::sin(p), z};
  }
  glm::vec3 near(const glm::vec3& axis) { return glm::normalize(axis + 0.6f * direction()); }
  float ndf() { return uniform() < 0.5f ? 0.03f + 0.97f * uniform() : -std::exp(uniform() * 8); }

  void add_pixel(std::array<std::vector<glm::vec4>, 5>& maps) {
    const glm::vec3 p = 2.0f * color() - 1.0f, view = glm::normalize(camera_.position - p);
    glm::vec3 g = near(view), n = near(g);
    if (glm::dot(g, view) < 0) g = -g;
    if (glm::dot(n, view) < 0.05f) n = glm::normalize(n + (0.1f - glm::dot(n, view)) * view);
    const glm::vec3 rd = color(), f0 = color();
    const float a = ndf();
    maps[0].emplace_back(p, 1);
    maps[1].emplace_back(n, a);
    maps[2].emplace_back(g, 0);
    maps[3].emplace_back(rd, 0);
    maps[4].emplace_back(f0, 0);
    pixels_.push_back(
        {p, glm::normalize(dvec3(n)), g, glm::normalize(dvec3(camera_.position) - dvec3(p)), rd, f0, a});
  }

  gpu::Vsgl random_vsgl() {
    gpu::Vsgl l{};
    l.mean = 3.0f * (2.0f * color() - 1.0f);
    l.variance = std::exp(6 * uniform() - 7);
    l.diffuse = color();
    l.diffuse_sharpness = 0.3f + 1.7f * uniform();
    l.diffuse_axis = direction();
    l.specular = color();
    l.specular_sharpness = std::exp(7 * uniform());
    l.specular_axis = direction();
    l.power = 1;
    return l;
  }
  gpu::Vpl random_vpl() {
    gpu::Vpl l{};
    l.position = 3.0f * (2.0f * color() - 1.0f);
    l.geometric_normal = direction();
    l.normal = near(l.geometric_normal);
    l.incident = near(l.normal);
    l.ndf = ndf();
    l.flux = color();
    l.power = 1;
    l.diffuse = color();
    l.f0 = color();
    return l;
  }

  template <class Record>
  Buffer upload(const std::vector<Record>& records) {
    Buffer buffer(device(), "records", records.size() * sizeof(Record));
    buffer.upload(std::span<const Record>(records));
    return buffer;
  }

  // shade.comp as `defines` says, without visibility. Of `push`, emitter is set here, and count where it is
  // 0. `texels`: of the bias reduction. `block`: INTERLEAVE.
  template <class Light>
  std::vector<glm::vec4> shade(const std::vector<Light>& lights, ShaderDefines defines = {},
                               ShadePush push = {}, const std::vector<gpu::Vpl>& texels = {},
                               uint32_t block = 1) {
    if (block > 1) defines["INTERLEAVE"] = fmt::format("{}u", block);
    defines.insert({{"LIGHT_VPL", std::is_same_v<Light, gpu::Vpl> ? "1" : "0"}, {"VISIBILITY", "0"}});
    const Kernel& kernel = kernels().get(data_root() / "harness" / "frame" / "shade.comp", defines);
    const Buffer light_buffer = upload(lights), out(device(), "out", pixels_.size() * sizeof(glm::vec4));
    const FieldMaps maps{&images_[0], &images_[1], &images_[2], &images_[3], &images_[4]};
    Bindings bound = {maps, light_buffer, out};
    Buffer texel_buffer;
    if (!texels.empty()) bound.add(texel_buffer = upload(texels));
    push.emitter = camera_;
    if (push.count == 0) push.count = static_cast<uint32_t>(lights.size());
    Recorder recorder(device());
    recorder.begin();
    recorder.pass({.step = "shade"}, [&] {
      recorder.dispatch(kernel, bound, push, groups_for(kWidth, 8 * block), groups_for(kHeight, 32 * block),
                        block * block);
    });
    recorder.submit_and_wait();
    return out.download<glm::vec4>(pixels_.size());
  }

  // For every pixel, the sum over `lights` of shade_one(pixel, light).
  template <class Light, class ShadeOne>
  std::vector<dvec3> on_host(const std::vector<Light>& lights, const ShadeOne& shade_one) {
    std::vector<dvec3> sums(pixels_.size(), dvec3(0));
    for (size_t i = 0; i < pixels_.size(); ++i) {
      for (const Light& l : lights) sums[i] += shade_one(pixels_[i], l);
    }
    return sums;
  }

  // The largest |gpu - host| / |host| over pixels; near-black pixels are measured against the median.
  double worst(const std::vector<glm::vec4>& gpu, const std::vector<dvec3>& host) {
    std::vector<double> lengths;
    for (const auto& h : host) lengths.push_back(glm::length(h));
    std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
    const double floor = 1e-3 * lengths[lengths.size() / 2];
    double most = 0;
    for (size_t i = 0; i < host.size(); ++i) {
      most = std::max(most, glm::length(dvec3(gpu[i]) - host[i]) / std::max(glm::length(host[i]), floor));
    }
    return most;
  }

  std::mt19937 random_;
  gpu::Emitter camera_{};
  std::vector<exact::Surface> pixels_;
  std::vector<DeviceImage> images_;
};

}  // namespace vsglbench
