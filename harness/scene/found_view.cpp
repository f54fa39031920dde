#include "scene/found_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "scene/depth_range.h"

namespace vsglbench {
namespace {

constexpr float kAspect = 16.0f / 9;
constexpr float kOutsideVfov = 40, kInsideVfov = 60;  // degrees
constexpr size_t kCameras = 12;                       // of either kind that lights are tried with
constexpr size_t kFinalists = 24;                     // shots that are measured again, by finer rays
constexpr double kIrradiance = 40;                    // W/m², see the header
constexpr ShotRays kCoarse{.image = 7, .light = 7, .links = 2, .aspect = kAspect};
constexpr ShotRays kFine{.image = 20, .light = 20, .links = 4, .aspect = kAspect};

float radians(float degrees) { return degrees * std::numbers::pi_v<float> / 180; }

// Unit, `azimuth` round the vertical axis from +z towards +x, `elevation` above the horizon, degrees.
glm::vec3 direction_of(float azimuth, float elevation) {
  const float a = radians(azimuth), e = radians(elevation);
  return {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
}

// An up for a view along `direction`: Y as far as that goes.
glm::vec3 up_for(const glm::vec3& direction) {
  const glm::vec3 axis = std::abs(direction.y) > 0.999f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
  return glm::normalize(axis - glm::dot(axis, direction) * direction);
}

Camera camera_at(const glm::vec3& eye, const glm::vec3& direction, float vfov) {
  Camera camera;
  camera.position = eye;
  camera.direction = glm::normalize(direction);
  camera.up = up_for(camera.direction);
  camera.vfov = radians(vfov);
  return camera;
}

Light spot_at(const glm::vec3& position, const glm::vec3& target, float fov) {
  Light light;
  light.position = position;
  light.direction = glm::normalize(target - position);
  light.up = up_for(light.direction);
  light.fov = radians(fov);
  return light;
}

struct Box {
  glm::vec3 low, high;
  glm::vec3 centre() const { return 0.5f * (low + high); }
  float radius() const { return 0.5f * glm::length(high - low); }
  // The coordinate along an axis at a share of the side.
  float along(int axis, float share) const { return low[axis] + share * (high[axis] - low[axis]); }
};

// Bounds of the first `triangles` triangles.
Box bounds_of(const Scene& scene, uint32_t triangles) {
  Box box{glm::vec3(INFINITY), glm::vec3(-INFINITY)};
  const size_t count = std::min<size_t>(triangles, scene.triangles.size());
  for (size_t i = 0; i < count; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      box.low = glm::min(box.low, scene.positions[scene.triangles[i][corner]]);
      box.high = glm::max(box.high, scene.positions[scene.triangles[i][corner]]);
    }
  }
  return box;
}

// How far from the centre a camera that looks back along `direction` must stand to have the box in its frame.
float distance_for(const Box& box, const glm::vec3& back, float vfov) {
  const Camera camera = camera_at(back, -back, vfov);
  const glm::vec3 right = glm::cross(camera.direction, camera.up);
  const float t = std::tan(0.5f * camera.vfov);
  float distance = 0;
  for (int k = 0; k < 8; ++k) {
    const glm::vec3 d = glm::vec3(k & 1 ? box.high.x : box.low.x, k & 2 ? box.high.y : box.low.y,
                                  k & 4 ? box.high.z : box.low.z) -
                        box.centre();
    const float depth = glm::dot(d, camera.direction);
    distance = std::max({distance, std::abs(glm::dot(d, camera.up)) / t - depth,
                         std::abs(glm::dot(d, right)) / (t * kAspect) - depth});
  }
  return 1.05f * distance;
}

// A camera and what it sees, by coarse rays.
struct Candidate {
  Camera camera;
  bool inside = false;
  std::vector<ShotPoint> seen;
  double score = 0;
};

double ramp(double value, double enough) { return std::clamp(value / enough, 0.0, 1.0); }

// What a camera promises without a light: it sees much, not from too near, and surfaces that face each other.
double promise(const TriangleTree& tree, const Candidate& c, uint32_t subject) {
  const auto cells = static_cast<double>(std::lround(kCoarse.aspect * kCoarse.image) * kCoarse.image);
  const auto n = c.seen.size();
  if (n < 4) return 0;
  size_t on_subject = 0, facing = 0, pairs = 0, front = 0;
  std::vector<float> depths;
  for (size_t i = 0; i < n; ++i) {
    on_subject += c.seen[i].triangle < subject;
    front += c.seen[i].front;
    depths.push_back(c.seen[i].distance);
    for (const size_t stride : {n / 3, n / 2, 2 * n / 3}) {
      const ShotPoint &a = c.seen[i], &b = c.seen[(i + stride) % n];
      const glm::vec3 way = b.position - a.position;
      ++pairs;
      facing += glm::dot(a.normal, way) > 0 && glm::dot(b.normal, way) < 0 &&
                !tree.occluded(a.position, b.position);
    }
  }
  std::ranges::sort(depths);
  const double radius = 0.5 * tree.scene().diagonal();
  // A camera within a solid sees the backs of its faces, one within a room their fronts.
  const double fronts = static_cast<double>(front) / static_cast<double>(n) - 0.5;
  const double near =
      c.inside ? ramp(depths[n / 10], 0.08 * radius) * ramp(depths[n / 2], 0.35 * radius) * ramp(fronts, 0.2)
               : 1;
  return ramp(static_cast<double>(n) / cells, c.inside ? 0.9 : 0.4) * near *
         ramp(static_cast<double>(on_subject) / static_cast<double>(n), 0.15) *
         (0.02 + ramp(static_cast<double>(facing) / static_cast<double>(pairs), 0.4));
}

// What is wanted of a shot, each from 0 to 1, multiplied.
double score_of(const ShotMeasure& m, double radius, bool inside) {
  const double shade = 1 - m.direct;
  return ramp(m.seen, inside ? 0.9 : 0.4) * ramp(m.subject, 0.15) * (0.2 + 0.8 * ramp(m.lit, 0.7)) *
         ramp(m.lit_seen, 0.35) * ramp(m.reached, 0.8) * (0.3 + 0.7 * ramp(shade, 0.35)) *
         std::sqrt(ramp(m.strength, 0.15)) * ramp(m.nearest, 0.15 * radius) * (inside ? 0.8 : 1);
}

class Search {
 public:
  Search(const TriangleTree& tree, const ViewSearch& wanted)
      : tree_(tree), wanted_(wanted), box_(bounds_of(tree.scene(), wanted.subject_triangles)) {}

  std::optional<FoundView> run() {
    std::vector<FoundView> shots;
    for (const Candidate& candidate : cameras()) try_lights(candidate, &shots);
    std::ranges::stable_sort(shots, std::greater<>(), &FoundView::score);
    if (shots.size() > kFinalists) shots.resize(kFinalists);
    for (FoundView& found : shots) {
      found.measure = measure_shot(tree_, found.shot, rays(kFine));
      found.score = score_of(found.measure, radius(), found.inside);
    }
    // A shot that does all that is asked for goes before a better picture that does not.
    std::ranges::stable_sort(shots, [](const FoundView& a, const FoundView& b) {
      return std::pair(is_good(a.measure), a.score) > std::pair(is_good(b.measure), b.score);
    });
    if (shots.empty() || !(shots.front().measure.lit_seen > 0)) return std::nullopt;
    return shots.front();
  }

 private:
  float radius() const { return 0.5f * tree_.scene().diagonal(); }
  ShotRays rays(ShotRays base) const {
    base.subject_triangles = wanted_.subject_triangles;
    return base;
  }

  Candidate candidate(const Camera& camera, bool inside) const {
    Candidate c{camera, inside, {}, 0};
    const auto across = static_cast<uint32_t>(std::lround(kCoarse.aspect * kCoarse.image));
    c.seen = points_seen(tree_, camera_view(camera, 4096 * 16 / 9, 4096), across, kCoarse.image);
    c.score = promise(tree_, c, wanted_.subject_triangles);
    return c;
  }

  // The most promising ones from outside, and from among the geometry.
  std::vector<Candidate> cameras() const {
    if (wanted_.fixed_camera)
      return {candidate(*wanted_.fixed_camera, is_inside(wanted_.fixed_camera->position))};
    std::vector<Candidate> best = outside_cameras(), inside = inside_cameras();
    for (auto* list : {&best, &inside}) {
      std::ranges::stable_sort(*list, std::greater<>(), &Candidate::score);
      if (list->size() > kCameras) list->resize(kCameras);
    }
    std::ranges::move(inside, std::back_inserter(best));
    return best;
  }

  bool is_inside(const glm::vec3& p) const {
    return glm::all(glm::greaterThan(p, box_.low)) && glm::all(glm::lessThan(p, box_.high));
  }

  std::vector<Candidate> outside_cameras() const {
    std::vector<Candidate> out;
    for (const float elevation : {5.0f, 20.0f, 40.0f, 65.0f}) {
      for (int k = 0; k < 16; ++k) {
        const glm::vec3 back = direction_of(22.5f * static_cast<float>(k), elevation);
        const float distance = distance_for(box_, back, kOutsideVfov);
        out.push_back(candidate(camera_at(box_.centre() + distance * back, -back, kOutsideVfov), false));
      }
    }
    return out;
  }

  std::vector<Candidate> inside_cameras() const {
    std::vector<Candidate> out;
    for (const glm::vec3& eye : grid({0.12f, 0.37f, 0.63f, 0.88f}, {0.2f, 0.45f, 0.75f})) {
      if (!is_enclosed(eye)) continue;
      for (int k = 0; k < 8; ++k)
        out.push_back(
            candidate(camera_at(eye, direction_of(45.0f * static_cast<float>(k), -8), kInsideVfov), true));
    }
    return out;
  }

  // Whether geometry lies round a point in most of 26 directions, as in a room, and not beside it, as in the
  // hollow of an object.
  bool is_enclosed(const glm::vec3& eye) const {
    int hits = 0, all = 0;
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          if (x == 0 && y == 0 && z == 0) continue;
          ++all;
          hits += tree_.intersect(eye, glm::normalize(glm::vec3(x, y, z))).has_value();
        }
      }
    }
    return hits > 0.65 * all;
  }

  // Points among the geometry at shares of the bounds' sides.
  std::vector<glm::vec3> grid(std::initializer_list<float> sides,
                              std::initializer_list<float> heights) const {
    std::vector<glm::vec3> out;
    for (const float y : heights)
      for (const float x : sides)
        for (const float z : sides) out.emplace_back(box_.along(0, x), box_.along(1, y), box_.along(2, z));
    return out;
  }

  void try_lights(const Candidate& c, std::vector<FoundView>* shots) const {
    if (c.seen.empty() || !(c.score > 0 || wanted_.fixed_camera)) return;
    for (const Light& light : lights_for(c)) {
      FoundView found{.shot = {c.camera, light}, .measure = {}, .inside = c.inside};
      found.measure = measure_shot(tree_, found.shot, c.seen, rays(kCoarse));
      found.score = score_of(found.measure, radius(), c.inside);
      if (found.score > 0) shots->push_back(found);
    }
  }

  // Spots from above and beside the geometry on its centre, and from among it on what the camera sees.
  std::vector<Light> lights_for(const Candidate& c) const {
    if (wanted_.fixed_light) return {*wanted_.fixed_light};
    std::vector<Light> out;
    const glm::vec3 back = -c.camera.direction;
    const float azimuth = std::atan2(back.x, back.z) * 180 / std::numbers::pi_v<float>;
    for (const float elevation : {20.0f, 45.0f, 70.0f}) {
      for (const float turn : {-120.0f, -75.0f, -40.0f, 40.0f, 75.0f, 120.0f}) {
        const glm::vec3 side = direction_of(azimuth + turn, elevation);
        for (const float fov : {25.0f, 40.0f})
          out.push_back(spot_at(box_.centre() + distance_for(box_, side, 40) * side, box_.centre(), fov));
      }
    }
    const std::vector<glm::vec3> places = grid({0.15f, 0.5f, 0.85f}, {0.35f, 0.65f, 0.9f});
    for (size_t i = 0; i < places.size(); ++i) {
      for (size_t k = 1; k <= 2; ++k) {
        const ShotPoint& target = c.seen[(i * 7 + k * c.seen.size() / 3) % c.seen.size()];
        if (glm::length(target.position - places[i]) > 0.1f * radius())
          out.push_back(spot_at(places[i], target.position, 60));
      }
    }
    return out;
  }

  const TriangleTree& tree_;
  const ViewSearch& wanted_;
  Box box_;
};

}  // namespace

bool is_good(const ShotMeasure& m, const WantedShot& wanted) {
  return m.seen >= wanted.seen && m.lit_seen >= wanted.lit_seen && m.reached >= wanted.reached &&
         m.strength >= wanted.strength;
}

std::optional<FoundView> find_view(const TriangleTree& tree, const ViewSearch& search) {
  std::optional<FoundView> found = Search(tree, search).run();
  if (!found || search.fixed_light) return found;
  // An intensity of two digits.
  const double wanted = kIrradiance * found->measure.nearest * found->measure.nearest;
  const double step = std::pow(10.0, std::floor(std::log10(std::max(1e-30, wanted))) - 1);
  found->shot.light.power = glm::vec3(static_cast<float>(step * std::round(wanted / step)));
  return found;
}

}  // namespace vsglbench
