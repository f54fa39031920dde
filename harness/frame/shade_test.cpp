// shade.comp against a double-precision transcription of [MFIS16 App. C] and [VSGL14 Eq. 1] on random inputs.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/file.h"
#include "frame/frame.h"

using namespace vsglbench;

namespace {

constexpr double kPi = 3.14159265358979323846;
using glm::dvec3;

struct Pixel {
  dvec3 position, normal, geometric, view, diffuse, f0;
  double ndf;
};

dvec3 fresnel(const dvec3& f0, double c) {
  const double f90 = std::min(1.0, 50 * std::max({f0.x, f0.y, f0.z}));
  return f0 + (dvec3(f90) - f0) * std::pow(1 - std::clamp(c, 0.0, 1.0), 5);
}
// G2/(4 nl nv) by Heitz's Λ.
double smith(double nl, double nv, double a) {
  const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1 + a * a * (1 / (c * c) - 1)) - 1); };
  return nl > 0 && nv > 0 ? 1 / ((1 + lambda(nl) + lambda(nv)) * 4 * nl * nv) : 0;
}
double masking_alpha(double ndf) { return ndf > 0 ? ndf : std::sqrt(2 / (2 - ndf)); }

dvec3 brdf_cosine(const Pixel& s, const dvec3& l) {
  const double nl = glm::dot(s.normal, l), nv = glm::dot(s.normal, s.view);
  if (nl <= 0 || nv <= 0 || glm::dot(s.geometric, l) <= 0) return dvec3(0);
  const dvec3 h = glm::normalize(l + s.view);
  const double nh = glm::dot(s.normal, h);
  double d;
  if (s.ndf > 0) {
    const double a2 = s.ndf * s.ndf;
    d = a2 / (kPi * std::pow(nh * nh * (a2 - 1) + 1, 2));
  } else {
    d = (2 - s.ndf) / (2 * kPi) * std::pow(nh, -s.ndf);
  }
  return (s.diffuse / kPi + d * smith(nl, nv, masking_alpha(s.ndf)) * fresnel(s.f0, glm::dot(l, h))) * nl;
}

// The paper's chain, with the naive exponents that double precision can afford.
dvec3 shade_lobe(const Pixel& s, const dvec3& amplitude, const dvec3& axis, double sharpness,
                 const dvec3& mean, double variance) {
  const dvec3 to = mean - s.position;
  const double d2 = glm::dot(to, to), spread = d2 / variance;  // Eq. (11)
  const dvec3 sum = spread * glm::normalize(to) - sharpness * axis;
  const double in = glm::length(sum);
  const dvec3 xi = sum / in;
  const dvec3 c = amplitude / (2 * kPi * variance) * std::exp(in - sharpness - spread);  // Eq. (12)
  const double nl = std::max(glm::dot(xi, s.normal), 0.0), nv = std::max(glm::dot(s.normal, s.view), 0.01);
  const double area = 2 * kPi * -std::expm1(-2 * in) / in;
  const dvec3 diffuse = c * s.diffuse / kPi * area * nl;

  const double h = s.ndf > 0 ? 2 / (s.ndf * s.ndf) : -s.ndf, nu = in / 2;
  const double peak = s.ndf > 0 ? 1 / (kPi * s.ndf * s.ndf) : (2 - s.ndf) / (2 * kPi);
  const double ex = h / (8 * nv * nv), ey = h / 8;
  const dvec3 z = 2 * glm::dot(s.view, s.normal) * s.normal - s.view;
  const dvec3 y = glm::normalize(glm::cross(s.normal, s.view)), x = glm::cross(y, z);
  const double g =
      std::max(glm::dot(xi, z), 0.0) * std::exp(-ex * nu / (ex + nu) * std::pow(glm::dot(xi, x), 2) -
                                                ey * nu / (ey + nu) * std::pow(glm::dot(xi, y), 2));
  const double vh = std::sqrt(std::max(0.5 + 0.5 * glm::dot(xi, s.view), 0.0));
  const dvec3 factor = peak * smith(nl, nv, masking_alpha(s.ndf)) * nl * fresnel(s.f0, vh);  // C(ξ)
  return diffuse + c * factor * (kPi * g / std::sqrt((ex + nu) * (ey + nu)));
}

// A G-buffer of random surfaces, as images on the device and in double.
class ShadeTest : public ::testing::Test {
 protected:
  static constexpr uint32_t kWidth = 37, kHeight = 11, kLights = 50;

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
  float uniform() { return static_cast<float>(random_() >> 8) * 0x1p-24f; }
  glm::vec3 color() { return {uniform(), uniform(), uniform()}; }
  glm::vec3 direction() {
    const float z = 2 * uniform() - 1, p = 6.2831853f * uniform(), r = std::sqrt(std::max(1 - z * z, 0.0f));
    return {r * std::cos(p), r * std::sin(p), z};
  }
  glm::vec3 near(const glm::vec3& axis) { return glm::normalize(axis + 0.6f * direction()); }
  float ndf() { return uniform() < 0.5f ? 0.03f + uniform() : -std::exp(uniform() * 8); }

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

  template <class Light>
  std::vector<glm::vec4> shade(const std::vector<Light>& lights, const char* is_vpl) {
    KernelLibrary kernels(device());
    const Kernel& kernel = kernels.get(data_root() / "harness" / "frame" / "shade.comp",
                                       {{"LIGHT_VPL", is_vpl}, {"VISIBILITY", "0"}});
    Buffer light_buffer(device(), "lights", lights.size() * sizeof(Light));
    light_buffer.upload(std::span<const Light>(lights));
    Buffer out(device(), "out", pixels_.size() * sizeof(glm::vec4));
    const struct {
      gpu::Emitter emitter;
      uint32_t first, count, words, accumulate, map_size;
    } push{camera_, 0, static_cast<uint32_t>(lights.size()), 0, 0, 0};
    Recorder recorder(device());
    recorder.begin();
    recorder.pass("shade", [&] {
      recorder.dispatch(kernel,
                        {images_[0], images_[1], images_[2], images_[3], images_[4], light_buffer, out}, push,
                        groups_for(kWidth, 8), groups_for(kHeight, 8));
    });
    recorder.submit_and_wait();
    return out.download<glm::vec4>(pixels_.size());
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
  std::vector<Pixel> pixels_;
  std::vector<DeviceImage> images_;
};

}  // namespace

TEST_F(ShadeTest, VsglsMatchDouble) {
  std::vector<gpu::Vsgl> lights(kLights);
  for (auto& l : lights) {
    l.mean = 3.0f * (2.0f * color() - 1.0f);
    l.variance = std::exp(6 * uniform() - 7);
    l.diffuse = color();
    l.diffuse_sharpness = 0.3f + 1.7f * uniform();
    l.diffuse_axis = direction();
    l.specular = color();
    l.specular_sharpness = std::exp(7 * uniform());
    l.specular_axis = direction();
    l.power = 1;
  }
  std::vector<dvec3> host(pixels_.size(), dvec3(0));
  for (size_t i = 0; i < pixels_.size(); ++i) {
    for (const auto& l : lights) {
      host[i] += shade_lobe(pixels_[i], l.diffuse, glm::normalize(dvec3(l.diffuse_axis)), l.diffuse_sharpness,
                            l.mean, l.variance);
      host[i] += shade_lobe(pixels_[i], l.specular, glm::normalize(dvec3(l.specular_axis)),
                            l.specular_sharpness, l.mean, l.variance);
    }
  }
  EXPECT_LT(worst(shade(lights, "0"), host), 1e-4);
}

TEST_F(ShadeTest, VplsMatchDouble) {
  std::vector<gpu::Vpl> lights(kLights);
  for (auto& l : lights) {
    l.position = 3.0f * (2.0f * color() - 1.0f);
    l.geometric_normal = direction();
    l.normal = near(l.geometric_normal);
    l.incident = near(l.normal);
    l.ndf = ndf();
    l.flux = color();
    l.power = 1;
    l.diffuse = color();
    l.f0 = color();
  }
  std::vector<dvec3> host(pixels_.size(), dvec3(0));
  for (size_t i = 0; i < pixels_.size(); ++i) {
    for (const auto& l : lights) {
      const dvec3 to = dvec3(l.position) - pixels_[i].position, w = glm::normalize(to);
      const Pixel emitter{l.position,
                          glm::normalize(dvec3(l.normal)),
                          l.geometric_normal,
                          glm::normalize(dvec3(l.incident)),
                          l.diffuse,
                          l.f0,
                          l.ndf};
      host[i] += dvec3(l.flux) * brdf_cosine(emitter, -w) * brdf_cosine(pixels_[i], w) / glm::dot(to, to);
    }
  }
  EXPECT_LT(worst(shade(lights, "1"), host), 1e-4);
}

TEST_F(ShadeTest, ALightWithoutPowerAddsNothing) {
  const std::vector<gpu::Vsgl> lights(3);
  for (const auto& p : shade(lights, "0")) EXPECT_EQ(glm::vec3(p), glm::vec3(0));
}
