#include "lights/light_pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/canvas.h"
#include "image/metrics.h"
#include "lights/picture_frame.h"

namespace vsglbench {
namespace {

// Colours of Okabe and Ito's palette: the colour-blind tell them apart, and both from grey.
constexpr glm::u8vec3 kPoint{230, 159, 0}, kOutline{86, 180, 233};
constexpr double kLabel = 15;
constexpr uint32_t kLeastWidth = 1280;  // of a picture
constexpr uint32_t kRsmEdge = 1024, kMostPixels = 16;
constexpr size_t kDisks = 96, kLabels = 10;  // of the strongest lights in view

// --- on the RSM ---

// Square root of each value over the 99.5th percentile of those above 0.
std::vector<float> brightness_of(const std::vector<float>& values) {
  std::vector<float> lit;
  std::copy_if(values.begin(), values.end(), std::back_inserter(lit), [](float v) { return v > 0; });
  std::vector<float> out(values.size(), 0);
  if (lit.empty()) return out;
  const auto top = lit.begin() + static_cast<ptrdiff_t>(0.995 * static_cast<double>(lit.size() - 1));
  std::nth_element(lit.begin(), top, lit.end());
  for (size_t i = 0; i < values.size(); ++i) out[i] = std::sqrt(std::clamp(values[i] / *top, 0.0f, 1.0f));
  return out;
}

// Neighbouring numbers get hues far apart.
glm::vec3 tint_of(uint32_t cluster) {
  const float hue = 6 * std::fmod(0.618034f * static_cast<float>(cluster % 65536), 1.0f);
  const glm::vec3 rgb(std::abs(hue - 3) - 1, 2 - std::abs(hue - 2), 2 - std::abs(hue - 4));
  return glm::clamp(rgb, 0.0f, 1.0f);
}

// Maps texels of the RSM to pixels of its picture.
struct Magnifier {
  explicit Magnifier(uint32_t texels)
      : rsm(texels),
        scale(texels <= kRsmEdge ? std::min(kRsmEdge / texels, kMostPixels) : double(kRsmEdge) / texels),
        pixels(static_cast<uint32_t>(std::lround(texels * scale))) {}
  uint32_t texel(uint32_t x, uint32_t y) const {
    const auto to = [&](uint32_t v) { return std::min(static_cast<uint32_t>((v + 0.5) / scale), rsm - 1); };
    return to(y) * rsm + to(x);
  }
  uint32_t rsm;
  double scale;  // pixels a texel
  uint32_t pixels;
};

Bitmap draw_values(const LightSet& lights, const std::vector<float>& values, const Magnifier& m) {
  const auto brightness = brightness_of(values);
  const auto& clusters = lights.shapes.clusters;
  Bitmap out(m.pixels, m.pixels);
  for (uint32_t y = 0; y < m.pixels; ++y) {
    for (uint32_t x = 0; x < m.pixels; ++x) {
      const uint32_t t = m.texel(x, y);
      glm::vec3 color(brightness[t]);
      // A cell can be told from its neighbours where the PDF is dark, too.
      if (!clusters.empty() && clusters[t] < lights.count())
        color = (0.15f + 0.85f * brightness[t]) * glm::mix(glm::vec3(1), tint_of(clusters[t]), 0.5f);
      for (int k = 0; k < 3; ++k) out.at(x, y)[k] = static_cast<uint8_t>(std::lround(255 * color[k]));
    }
  }
  return out;
}

void draw_borders(Bitmap& bitmap, const std::vector<uint32_t>& clusters, const Magnifier& m) {
  for (uint32_t y = 0; y < m.pixels; ++y) {
    for (uint32_t x = 0; x < m.pixels; ++x) {
      const uint32_t here = clusters[m.texel(x, y)];
      const bool right = x + 1 < m.pixels && clusters[m.texel(x + 1, y)] != here;
      const bool below = y + 1 < m.pixels && clusters[m.texel(x, y + 1)] != here;
      if (right || below) std::copy_n(&kOutline.x, 3, bitmap.at(x, y));
    }
  }
}

void draw_squares(Canvas& canvas, const std::vector<glm::vec4>& squares, const Magnifier& m) {
  for (const glm::vec4& s : squares) {
    if (!(s.z > 0)) continue;
    const glm::dvec2 centre(s), half(0.5 * s.z);
    const glm::dvec2 from = glm::round(m.scale * (centre - half)), to = glm::round(m.scale * (centre + half));
    canvas.outline_rectangle(from, glm::max(to, from + 1.0), 1, {kOutline, 0.8f});
  }
}

// In texels: the footprints' centres, or the lights' projected positions.
std::vector<glm::dvec2> points_of(const LightSet& lights, const View& light) {
  std::vector<glm::dvec2> points;
  for (const glm::vec4& s : lights.shapes.squares) {
    if (s.z > 0) points.emplace_back(s.x, s.y);
  }
  if (!lights.shapes.squares.empty()) return points;
  for (const LightMark& mark : light_marks(lights)) {
    if (const auto uv = light.project(mark.position)) points.push_back(double(lights.rsm) * glm::dvec2(*uv));
  }
  return points;
}

std::vector<std::string> rsm_legend(const LightSet& lights, const std::optional<Coverage>& c) {
  std::vector<std::string> legend;
  if (c) {
    legend.push_back(
        fmt::format("overlap {:.3f}, gap {:.3f}: means over the RSM's texels", c->overlap, c->gap));
    if (c->pdf_gap)
      legend.push_back(
          fmt::format("overlap {:.3f}, gap {:.3f}: weighted by the PDF p", *c->pdf_overlap, *c->pdf_gap));
  }
  const bool squares = !lights.shapes.squares.empty(), clusters = !lights.shapes.clusters.empty();
  legend.push_back(
      squares    ? "orange dots: footprint centres; blue squares: footprints"
      : clusters ? "orange dots: lights as the primary light sees them; blue borders and tints: clusters"
                 : "orange dots: lights as the primary light sees them");
  legend.push_back(lights.pdf.empty() ? "brightness: √ of diffuse reflectance (the method uses no PDF)"
                                      : "brightness: √(p / its 99.5th percentile)");
  return legend;
}

// --- in the scene ---

// Direct light at a third of its brightness over a little of how surfaces face the camera, so that what is
// not lit shows.
Bitmap background(const CameraView& camera, uint32_t scale) {
  Mask mask;
  for (const auto& p : camera.position) mask.push_back(p.w > 0);
  const Bitmap lit = tone_map(camera.direct, auto_exposure(camera.direct, mask));
  Bitmap out(camera.direct.width * scale, camera.direct.height * scale);
  for (uint32_t y = 0; y < out.height; ++y) {
    for (uint32_t x = 0; x < out.width; ++x) {
      const size_t i = size_t(y / scale) * camera.direct.width + x / scale;
      const glm::vec3 to_eye = glm::normalize(camera.view.position - glm::vec3(camera.position[i]));
      const float facing = mask[i] ? 15 + 45 * std::abs(glm::dot(to_eye, glm::vec3(camera.normal[i]))) : 0;
      const uint8_t* from = lit.at(x / scale, y / scale);
      for (int k = 0; k < 3; ++k)
        out.at(x, y)[k] = static_cast<uint8_t>(std::lround(facing + 0.35f * from[k]));
    }
  }
  return out;
}

// A light as the camera sees it, in pixels of the image.
struct Disk {
  glm::dvec2 centre;
  double radius;
  glm::u8vec3 color;
  bool hidden;
  uint32_t index;
  float power;
  bool strong = false;  // among the strongest
};

// By the farthest surface of the pixel and its neighbours: on a slanted one a light lies between two pixels'.
bool is_hidden(const LightMark& mark, const CameraView& camera, const glm::vec2& uv) {
  const glm::ivec2 last(camera.direct.width - 1, camera.direct.height - 1);
  const glm::ivec2 pixel(uv * glm::vec2(last + 1));
  const float distance = glm::distance(mark.position, camera.view.position);
  const float allowed = distance - mark.sigma - 1e-3f * distance;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const glm::ivec2 at = glm::clamp(pixel + glm::ivec2(x, y), glm::ivec2(0), last);
      const glm::vec4& surface = camera.position[static_cast<size_t>(at.y) * static_cast<size_t>(last.x + 1) +
                                                 static_cast<size_t>(at.x)];
      if (!(surface.w > 0) || glm::distance(glm::vec3(surface), camera.view.position) >= allowed)
        return false;
    }
  }
  return true;
}

// The disks of the lights within the camera's view, largest first, hidden ones before all others.
std::vector<Disk> disks_of(const LightSet& lights, const CameraView& camera) {
  std::vector<Disk> disks;
  const glm::dvec2 size(camera.direct.width, camera.direct.height);
  for (const LightMark& mark : light_marks(lights)) {
    const auto uv = camera.view.project(mark.position);
    if (!uv) continue;
    const double depth = glm::dot(mark.position - camera.view.position, camera.view.forward);
    disks.push_back({glm::dvec2(*uv) * size, 0.5 * size.y * mark.sigma / (depth * camera.view.extent.y),
                     glm::u8vec3(glm::round(255.0f * mark.color)), is_hidden(mark, camera, *uv), mark.index,
                     mark.power});
  }
  std::stable_sort(disks.begin(), disks.end(),
                   [](const Disk& a, const Disk& b) { return a.power > b.power; });
  for (size_t i = 0; i < std::min(disks.size(), kDisks); ++i) disks[i].strong = true;
  std::stable_sort(disks.begin(), disks.end(), [](const Disk& a, const Disk& b) {
    return a.hidden != b.hidden ? a.hidden : a.radius > b.radius;
  });
  return disks;
}

std::vector<std::string> scene_legend(const LightSet& lights, const std::vector<Disk>& disks) {
  const auto hidden = std::ranges::count_if(disks, [](const Disk& d) { return d.hidden; });
  const std::string thinned =
      disks.size() > kDisks ? fmt::format("; disks and rings of the {} strongest alone", kDisks) : "";
  return {fmt::format("{} of {} lights in view, {} of them hidden", disks.size(),
                      lights.count() - lights.empty(), hidden),
          fmt::format("{}; rings: hidden ones{}", info_of(lights.lights.kind).marks, thinned),
          "numbers: index of the strongest; colour: of the flux; background: direct light, dimmed"};
}

// The indices of the strongest lights that are not hidden, but those that would stand on another's.
void label(Canvas& canvas, std::vector<Disk> disks, glm::dvec2 size) {
  const Font font(kLabel);
  std::erase_if(disks, [](const Disk& d) { return d.hidden; });
  std::ranges::stable_sort(disks, [](const Disk& a, const Disk& b) { return a.power > b.power; });
  if (disks.size() > kLabels) disks.resize(kLabels);
  std::vector<glm::dvec4> taken;
  for (const Disk& d : disks) {
    const std::string text = std::to_string(d.index);
    const glm::dvec2 box(font.width(text), 1.2 * kLabel);
    const glm::dvec2 at =
        glm::clamp(d.centre + glm::dvec2(5, -1.2 * kLabel), glm::dvec2(2), size - box - 2.0);
    const bool free = std::ranges::none_of(taken, [&](const glm::dvec4& t) {
      return at.x < t.z && t.x < at.x + box.x && at.y < t.w && t.y < at.y + box.y;
    });
    if (!free) continue;
    taken.emplace_back(at, at + box);
    canvas.text(at, text, font, {glm::u8vec3(255)}, glm::u8vec3(0));
  }
}

}  // namespace

std::vector<LightMark> light_marks(const LightSet& lights) {
  std::vector<LightMark> marks;
  uint32_t index = 0;
  for (const LightSummary& light : summaries_of(lights.lights)) {
    const glm::vec3& flux = light.color;
    const float top = std::max({flux.x, flux.y, flux.z, 1e-30f});
    const float size = light.radius > 0 ? light.radius : std::sqrt(light.variance);
    if (light.power > 0)
      marks.push_back({index, light.position, size, glm::clamp(flux / top, 0.0f, 1.0f), light.power});
    ++index;
  }
  return marks;
}

Bitmap draw_on_rsm(const LightSet& lights, const View& light, const std::vector<float>& fallback,
                   const std::optional<Coverage>& coverage, const std::vector<std::string>& captions) {
  const Magnifier magnifier(lights.rsm);
  Bitmap picture = draw_values(lights, lights.pdf.empty() ? fallback : lights.pdf, magnifier);
  if (!lights.shapes.clusters.empty()) draw_borders(picture, lights.shapes.clusters, magnifier);
  Canvas canvas(picture);
  draw_squares(canvas, lights.shapes.squares, magnifier);
  for (const glm::dvec2& point : points_of(lights, light)) {
    canvas.fill_disk(magnifier.scale * point, 3.2, {glm::u8vec3(0), 0.7f});  // a rim, on what is bright
    canvas.fill_disk(magnifier.scale * point, 2.2, {kPoint, 1});
  }
  return framed(canvas.bitmap(), captions, rsm_legend(lights, coverage));
}

Bitmap draw_in_scene(const LightSet& lights, const CameraView& camera,
                     const std::vector<std::string>& captions) {
  const uint32_t scale = std::max(1u, (kLeastWidth + camera.direct.width - 1) / camera.direct.width);
  const Bitmap picture = background(camera, scale);
  auto disks = disks_of(lights, camera);
  double area = 0;
  for (Disk& d : disks) {
    d.centre *= scale;
    d.radius = std::max(scale * d.radius, 2.5);
    if (d.strong) area += std::numbers::pi * d.radius * d.radius;
  }
  // The more the disks pile up the fainter, so that what is behind them shows.
  const double pixels = double(picture.width) * picture.height;
  const auto opacity = static_cast<float>(std::clamp(0.15 * pixels / std::max(area, 1.0), 0.02, 0.3));
  Canvas canvas(picture);
  for (const Disk& d : disks) {
    if (!d.strong) continue;
    if (!d.hidden) canvas.fill_disk(d.centre, d.radius, {d.color, opacity});
    canvas.outline_disk(d.centre, d.radius, 1.2, {d.color, d.hidden ? 0.3f : 0.6f});
  }
  for (const bool strong : {false, true}) {  // weaker ones below
    for (const Disk& d : disks) {
      if (d.strong == strong && !d.hidden) canvas.fill_disk(d.centre, strong ? 2.5 : 1.3, {d.color, 1});
    }
  }
  label(canvas, disks, {picture.width, picture.height});
  return framed(canvas.bitmap(), captions, scene_legend(lights, disks));
}

}  // namespace vsglbench
