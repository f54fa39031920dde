#include "method/made_half.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

#include "method/filtered_sampling.h"

namespace vsglbench {
namespace {

// The point at `depth` behind the centre of texel (x, y).
glm::vec3 behind_texel(const gpu::Emitter& e, uint32_t x, uint32_t y, float depth) {
  const float right = (2 * (static_cast<float>(x) + 0.5f) / static_cast<float>(e.width) - 1) * e.extent.x;
  const float up = (1 - 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(e.height)) * e.extent.y;
  return e.position + depth * glm::vec3(right, -1, -up);
}

double reflected_power(const oracle::Half& half, uint32_t x, uint32_t y) {
  const oracle::Sums sums = oracle::texel_sums(half, x, y);
  return oracle::luminance(sums.diffuse) + oracle::luminance(sums.specular);
}

// The PDF where it does not come from random numbers.
void set_honest_pdf(oracle::Half& half) {
  const gpu::Emitter& e = half.emitter;
  half.pdf.clear();
  for (uint32_t y = 0; y < e.height; ++y) {
    for (uint32_t x = 0; x < e.width; ++x) {
      const double importance = 1 + 0.5 * std::sin(5.0 * x / e.width) * std::cos(4.0 * y / e.height);
      half.pdf.push_back(static_cast<float>(reflected_power(half, x, y) * importance));
    }
  }
}

}  // namespace

gpu::Emitter spot(uint32_t width, uint32_t height) {
  return {.position = {0.3f, 4, 0.2f},
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
}

oracle::Half random_half(uint32_t width, uint32_t height, uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  const auto color = [&] {
    const float r = uniform(), g = uniform(), b = uniform();
    return glm::vec3(r, g, b);
  };
  oracle::Half half;
  half.emitter = spot(width, height);
  half.texels.reserve(size_t(width) * height);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      oracle::Texel t;
      t.position = behind_texel(half.emitter, x, y, 3.5f + uniform());
      const glm::vec3 tilt = color();
      t.geometric_normal = glm::normalize(glm::vec3(0.4f * tilt.x, 1, 0.4f * tilt.z));
      t.normal = glm::normalize(t.geometric_normal + 0.2f * color());
      t.diffuse = 0.8f * color();
      t.f0 = 0.3f * color();
      t.ndf = uniform() < 0.5f ? 0.05f + 0.9f * uniform() : -(1 + 2000 * uniform());
      t.surface = uniform() > 0.05f;
      const float a = uniform(), b = uniform();
      half.texels.push_back(t);
      half.pdf.push_back(t.surface ? 0.05f + a * b : 0.0f);
    }
  }
  return half;
}

oracle::Half smooth_half(uint32_t width, uint32_t height) {
  oracle::Half half;
  half.emitter = spot(width, height);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
      const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
      oracle::Texel t;
      t.position = behind_texel(half.emitter, x, y, 4 + 0.2f * std::sin(6 * u) * std::cos(4 * v));
      t.geometric_normal = glm::normalize(glm::vec3(0.3f * std::cos(6 * u), 1, 0.2f * std::sin(4 * v)));
      t.normal = glm::normalize(t.geometric_normal + glm::vec3(0.1f * std::sin(9 * v), 0, 0));
      t.diffuse = glm::vec3(0.3f + 0.2f * std::sin(4 * u), 0.4f, 0.3f + 0.2f * std::cos(5 * v));
      t.f0 = glm::vec3(0.04f + 0.1f * u);
      t.ndf = 0.3f + 0.5f * v;
      half.texels.push_back(t);
    }
  }
  set_honest_pdf(half);
  return half;
}

oracle::Half uneven_half(uint32_t width, uint32_t height) {
  oracle::Half half = smooth_half(width, height);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const double u = (x + 0.5) / width, v = (y + 0.5) / height;
      const bool seen = std::hypot(u - 0.4, v - 0.6) < 0.35;
      const double ripple = std::exp2(2 * std::sin(40 * u) * std::cos(33 * v));
      half.pdf[size_t(y) * width + x] =
          static_cast<float>(reflected_power(half, x, y) * (seen ? 4.0 : 0.25) * ripple);
    }
  }
  return half;
}

void look_from_eye(oracle::Half& half) {
  half.emitter.power = glm::vec3(0);
  half.emitter.importance = 1;
}

std::vector<float> pdf_pyramid(const oracle::Half& half) {
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

double texel_power(const oracle::Half& half, LightKind kind) {
  double total = 0;
  for (uint32_t y = 0; y < half.emitter.height; ++y) {
    for (uint32_t x = 0; x < half.emitter.width; ++x) {
      if (!half.texels[size_t(y) * half.emitter.width + x].surface) continue;
      total += info_of(kind).power_is_incident ? oracle::luminance(oracle::texel_flux(half.emitter, x, y))
                                               : reflected_power(half, x, y);
    }
  }
  return total;
}

DeviceHalf::DeviceHalf(Device& device, const oracle::Half& half) : emitter_(half.emitter) {
  std::vector<glm::vec4> texels(half.texels.size());
  const auto fill = [&](size_t map, const char* name, const auto& texel) {
    std::ranges::transform(half.texels, texels.begin(),
                           [&](const oracle::Texel& t) { return t.surface ? texel(t) : glm::vec4(0); });
    maps_[map] = DeviceImage(device, name, VK_FORMAT_R32G32B32A32_SFLOAT, emitter_.width, emitter_.height,
                             VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    maps_[map].upload(texels.data(), texels.size() * sizeof(glm::vec4));
  };
  fill(0, "position", [](const auto& t) { return glm::vec4(t.position, 1); });
  fill(1, "normal", [](const auto& t) { return glm::vec4(t.normal, t.ndf); });
  fill(2, "geometric normal", [](const auto& t) { return glm::vec4(t.geometric_normal, 0); });
  fill(3, "diffuse", [](const auto& t) { return glm::vec4(t.diffuse, 0); });
  fill(4, "f0", [](const auto& t) { return glm::vec4(t.f0, 0); });
  const auto pyramid = pdf_pyramid(half);
  pdf_ = Buffer(device, "pdf", pyramid.size() * sizeof(float));
  pdf_.upload(std::span<const float>(pyramid));
}

Field DeviceHalf::field(Half half, bool with_pdf) const {
  Field field;
  field.half = half;
  field.emitter = emitter_;
  field.maps = {&maps_[0], &maps_[1], &maps_[2], &maps_[3], &maps_[4]};
  field.pdf = with_pdf ? &pdf_ : nullptr;
  return field;
}

}  // namespace vsglbench
