#include "scene/preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "image/canvas.h"
#include "image/theme.h"
#include "scene/surface.h"

namespace vsglbench {
namespace {

constexpr float kAmbient = 0.12f;
constexpr uint32_t kMargin = 12, kLine = 22;
constexpr double kText = 16;
constexpr Ink kCameraInk{{86, 180, 233}, 1}, kLightInk{{240, 200, 40}, 1};

struct Spotted {
  Surface surface;
  glm::vec3 to_viewer;
};

std::optional<Spotted> surface_along(const TriangleTree& tree, const glm::vec3& origin,
                                     const glm::vec3& direction) {
  const auto hit = tree.intersect(origin, direction);
  if (!hit) return std::nullopt;
  return Spotted{surface_at(tree.scene(), hit->triangle, hit->barycentric, -direction), -direction};
}

void put(Bitmap* out, uint32_t x, uint32_t y, const glm::vec3& color) {
  for (int k = 0; k < 3; ++k) out->at(x, y)[k] = encode_srgb(color[k]);
}

// Reflectance under a lamp at the camera and, three times as bright, the scene's own.
Bitmap camera_picture(const TriangleTree& tree, uint32_t width, uint32_t height) {
  const Scene& scene = tree.scene();
  const View camera = camera_view(scene.camera, width, height), lamp = light_view(scene.light);
  Bitmap out(width, height);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      glm::vec3 eye, direction;
      camera.ray((glm::vec2(x, y) + 0.5f) / glm::vec2(width, height), &eye, &direction);
      const auto found = surface_along(tree, eye, direction);
      if (!found) {
        put(&out, x, y, glm::vec3(theme().panel) / 255.0f);
        continue;
      }
      const Surface& s = found->surface;
      float brightness = kAmbient * (0.3f + 0.7f * std::abs(glm::dot(s.normal, found->to_viewer)));
      const glm::vec3 to_lamp = lamp.perspective ? glm::normalize(lamp.position - s.position) : -lamp.forward;
      if (sees(tree, lamp, s.position)) brightness += 0.9f * std::max(0.0f, glm::dot(s.normal, to_lamp));
      put(&out, x, y, brightness * glm::min(s.diffuse + s.f0, glm::vec3(1)));
    }
  }
  return out;
}

// Far corners of a view's frustum at `distance` along its axis, and where its edges begin.
struct Frustum {
  std::array<glm::vec3, 4> near, far;
};
Frustum frustum_of(const View& view, float distance) {
  Frustum f;
  for (size_t k = 0; k < 4; ++k) {
    const glm::vec2 side(k == 0 || k == 3 ? -1 : 1, k < 2 ? -1 : 1);
    const glm::vec3 across = side.x * view.extent.x * view.right + side.y * view.extent.y * view.up;
    f.near[k] = view.position + (view.perspective ? glm::vec3(0) : across);
    f.far[k] = view.position + distance * view.forward + (view.perspective ? distance : 1.0f) * across;
  }
  return f;
}

// From a corner above, at right angles, with `points` in the frame.
View overview(const std::vector<glm::vec3>& points, float aspect) {
  View view;
  view.perspective = false;
  view.forward = glm::normalize(glm::vec3(-0.55f, -0.7f, -0.75f));
  view.right = glm::normalize(glm::cross(view.forward, glm::vec3(0, 1, 0)));
  view.up = glm::cross(view.right, view.forward);
  glm::vec3 low(INFINITY), high(-INFINITY);
  for (const glm::vec3& p : points) {
    const glm::vec3 seen(glm::dot(p, view.right), glm::dot(p, view.up), glm::dot(p, view.forward));
    low = glm::min(low, seen);
    high = glm::max(high, seen);
  }
  const glm::vec3 middle = 0.5f * (low + high), half = 0.53f * (high - low);
  view.extent.y = std::max({half.y, half.x / aspect, 1e-6f});
  view.extent.x = view.extent.y * aspect;
  view.position = middle.x * view.right + middle.y * view.up + (low.z - (high.z - low.z) - 1) * view.forward;
  return view;
}

glm::vec3 tint(bool lit, bool seen) {
  if (lit && seen) return {0.45f, 0.95f, 0.5f};
  if (lit) return {1, 0.8f, 0.25f};
  if (seen) return {0.45f, 0.7f, 1};
  return glm::vec3(0.5f);
}

class Overview {
 public:
  Overview(const TriangleTree& tree, uint32_t width, uint32_t height)
      : tree_(tree),
        width_(width),
        height_(height),
        camera_(camera_view(tree.scene().camera, width, height)),
        lamp_(light_view(tree.scene().light)) {
    const Scene& scene = tree.scene();
    const ShotMeasure m = measure_shot(tree, {scene.camera, scene.light});
    const auto reach = [&](double d) { return static_cast<float>(d > 0 ? d : 0.3 * scene.diagonal()); };
    eye_ = frustum_of(camera_, reach(0.5 * m.depth));
    light_ = frustum_of(lamp_, reach(0.8 * m.nearest));
    std::vector<glm::vec3> points;
    for (int k = 0; k < 8; ++k)
      points.emplace_back(k & 1 ? scene.bounds_max.x : scene.bounds_min.x,
                          k & 2 ? scene.bounds_max.y : scene.bounds_min.y,
                          k & 4 ? scene.bounds_max.z : scene.bounds_min.z);
    for (const Frustum* f : {&eye_, &light_}) {
      if (f == &light_ && !lamp_.perspective) continue;  // a sun may stand far off
      points.insert(points.end(), f->near.begin(), f->near.end());
    }
    view_ = overview(points, static_cast<float>(width) / static_cast<float>(height));
    cut_ = camera_.position.y;
    if (lamp_.perspective) cut_ = std::max(cut_, lamp_.position.y);
    cut_ += 1e-3f * scene.diagonal();
  }

  Bitmap draw() const {
    Bitmap out(width_, height_);
    for (uint32_t y = 0; y < height_; ++y)
      for (uint32_t x = 0; x < width_; ++x) put(&out, x, y, color_at(x, y));
    Canvas canvas(out);
    draw(&canvas, eye_, kCameraInk);
    draw(&canvas, light_, kLightInk);
    return canvas.bitmap();
  }

 private:
  glm::vec3 color_at(uint32_t x, uint32_t y) const {
    glm::vec3 origin, direction;
    view_.ray((glm::vec2(x, y) + 0.5f) / glm::vec2(width_, height_), &origin, &direction);
    if (origin.y > cut_) origin += (cut_ - origin.y) / direction.y * direction;
    const auto found = surface_along(tree_, origin, direction);
    if (!found) return glm::vec3(theme().panel) / 255.0f;
    const float facing = 0.15f + 0.6f * std::abs(glm::dot(found->surface.geometric_normal, found->to_viewer));
    const glm::vec3& p = found->surface.position;
    return facing * tint(sees(tree_, lamp_, p), sees(tree_, camera_, p));
  }

  void line(Canvas* canvas, const glm::vec3& from, const glm::vec3& to, Ink ink) const {
    constexpr int kSteps = 400;
    for (int i = 0; i <= kSteps; ++i) {
      const auto uv = view_.project(glm::mix(from, to, static_cast<float>(i) / kSteps));
      if (uv) canvas->fill_disk(glm::dvec2(*uv) * glm::dvec2(width_, height_), 1.1, ink);
    }
  }
  void draw(Canvas* canvas, const Frustum& f, Ink ink) const {
    for (size_t k = 0; k < 4; ++k) {
      line(canvas, f.near[k], f.far[k], ink);
      line(canvas, f.far[k], f.far[(k + 1) % 4], ink);
    }
    if (const auto uv = view_.project(0.25f * (f.near[0] + f.near[1] + f.near[2] + f.near[3])))
      canvas->fill_disk(glm::dvec2(*uv) * glm::dvec2(width_, height_), 4, ink);
  }

  const TriangleTree& tree_;
  uint32_t width_, height_;
  View camera_, lamp_, view_;
  Frustum eye_, light_;
  float cut_ = 0;
};

}  // namespace

std::vector<std::string> shot_notes(const ShotMeasure& m) {
  const auto percent = [](double share) { return fmt::format("{:.0f} %", 100 * share); };
  return {fmt::format(
              "the picture shows a surface in {}; the camera sees {} of the lit surface, and {} of what it "
              "sees is lit",
              percent(m.seen), percent(m.lit_seen), percent(m.direct)),
          fmt::format(
              "indirect light reaches {} of what it sees; its irradiance there is on average about {:.2g} "
              "times the direct light's",
              percent(m.reached), m.strength)};
}

Bitmap preview_picture(const TriangleTree& tree, uint32_t width) {
  const uint32_t height = width * 9 / 16;
  const Scene& scene = tree.scene();
  const ShotMeasure measure =
      measure_shot(tree, {scene.camera, scene.light}, {.image = 24, .light = 24, .links = 4});
  const std::vector<std::string> notes = shot_notes(measure);
  Canvas out(2 * width + 3 * kMargin,
             height + 3 * kMargin + (2 + static_cast<uint32_t>(notes.size())) * kLine, theme().paper);
  const Font font(kText);
  out.text({kMargin, kMargin}, fmt::format("{}: the camera's view", scene.name), font, {theme().ink});
  out.text({2.0 * kMargin + width, kMargin},
           "from above: blue what the camera sees, yellow what the light sees, green both", font,
           {theme().ink});
  const uint32_t top = kMargin + kLine + kMargin / 2;
  out.picture(kMargin, top, camera_picture(tree, width, height));
  out.picture(2 * kMargin + width, top, Overview(tree, width, height).draw());
  double y = top + height + kMargin;
  for (const std::string& line : notes) {
    out.text({kMargin, y}, line, font, {theme().faint});
    y += kLine;
  }
  return out.bitmap();
}

}  // namespace vsglbench
