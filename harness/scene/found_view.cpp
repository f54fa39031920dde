#include "scene/found_view.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "scene/subject.h"

namespace vsglbench {
namespace {

constexpr float kAspect = 16.0f / 9;
constexpr float kOutsideVfov = 40, kInsideVfov = 60;  // degrees
constexpr size_t kCameras = 8;                        // of either kind that lights are tried with
constexpr size_t kFinalists = 12;                     // shots that are measured again, by finer rays
constexpr size_t kPlaces = 16;                        // where spots stand within what a camera sees
constexpr double kIrradiance = 40;                    // W/m², see the header
constexpr ShotRays kCoarse{.image = 7, .light = 7, .links = 2, .aspect = kAspect};
constexpr ShotRays kFine{.image = 20, .light = 20, .links = 4, .aspect = kAspect};

float radians(float degrees) { return degrees * std::numbers::pi_v<float> / 180; }

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

// A camera and what it sees, by coarse rays.
struct Candidate {
  Camera camera;
  bool inside = false;
  std::vector<ShotPoint> seen;
  double score = 0;
};

double ramp(double value, double enough) { return std::clamp(value / enough, 0.0, 1.0); }

// How glad one is of an outside camera's direction: somewhat from above, and from the front, which is +z in
// glTF.
double taste(const Camera& camera) {
  const glm::vec3 back = -camera.direction;
  const float level = std::hypot(back.x, back.z);
  const double height = std::asin(std::clamp(back.y, -1.0f, 1.0f)) * 180 / std::numbers::pi;
  return (height > 15 && height < 45 ? 1 : 0.85) * (0.9 + 0.1 * (level > 0 ? back.z / level : 1));
}

// What a camera promises without a light: it sees much, not from too near, and surfaces that face each other.
double promise(const TriangleTree& tree, const Candidate& c, uint32_t subject, double full) {
  const auto cells = static_cast<double>(std::lround(kCoarse.aspect * kCoarse.image) * kCoarse.image);
  const auto n = c.seen.size();
  if (n < 4) return 0;
  size_t on_subject = 0, facing = 0, pairs = 0, front = 0;
  std::vector<float> depths;
  std::set<uint32_t> triangles;
  for (size_t i = 0; i < n; ++i) {
    triangles.insert(c.seen[i].triangle);
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
  // From within one wants to see far, and more than a few bare walls, as between two shells of a building.
  const double place = c.inside ? ramp(depths[n / 10], 0.08 * radius) * ramp(depths[n / 2], 0.6 * radius) *
                                      ramp(fronts, 0.2) *
                                      (0.2 + ramp(static_cast<double>(triangles.size()), 0.3 * cells))
                                : taste(c.camera);
  return ramp(static_cast<double>(n) / cells, full) * place *
         (0.02 + ramp(static_cast<double>(on_subject) / static_cast<double>(n), 0.35)) *
         (0.02 + ramp(static_cast<double>(facing) / static_cast<double>(pairs), 0.4));
}

// What is wanted of a shot, each from 0 to about 1, multiplied: the subject fills much of the picture and
// nothing stands before it; from within one sees far; the light falls on the subject, where the camera sees
// it; part of the picture is lit directly and part is not, so that indirect light has something to show; and
// much of it gets some.
double score_of(const ShotMeasure& m, const FoundView& shot, float radius, double full) {
  const double place = shot.inside ? 0.8 * ramp(m.depth, 0.6 * radius) : taste(shot.shot.camera);
  return ramp(m.seen, full) * place * (0.02 + ramp(m.subject, 0.35)) * (0.2 + 0.8 * ramp(m.lit, 0.7)) *
         (0.05 + ramp(m.subject_direct, 0.3)) * ramp(m.lit_seen, 0.35) * ramp(m.reached, 0.8) *
         (0.3 + 0.7 * ramp(1 - m.direct, 0.35)) * (0.2 + 0.8 * ramp(m.direct, 0.25)) *
         std::sqrt(ramp(m.strength, 0.15)) * ramp(m.nearest, 0.15 * radius);
}

class Search {
 public:
  Search(const TriangleTree& tree, const ViewSearch& wanted)
      : tree_(tree), wanted_(wanted), subject_(tree, wanted.subject_triangles) {}

  std::optional<FoundView> run() {
    std::vector<FoundView> shots;
    for (const Candidate& candidate : cameras()) try_lights(candidate, &shots);
    std::ranges::stable_sort(shots, std::greater<>(), &FoundView::score);
    if (shots.size() > kFinalists) shots.resize(kFinalists);
    for (FoundView& found : shots) {
      found.measure = measure_shot(tree_, found.shot, rays(kFine));
      found.score = score_of(found.measure, found, radius(), full(found.inside));
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
  // How much of a picture may well show surfaces: all within a place or before scenery, and less of an object
  // by itself, round which there is nothing.
  double full(bool inside) const {
    return inside || wanted_.subject_triangles < tree_.scene().triangles.size() ? 0.9 : 0.4;
  }
  ShotRays rays(ShotRays base) const {
    base.subject_triangles = wanted_.subject_triangles;
    return base;
  }

  Candidate candidate(const Camera& camera, bool inside) const {
    Candidate c{camera, inside, {}, 0};
    const auto across = static_cast<uint32_t>(std::lround(kCoarse.aspect * kCoarse.image));
    c.seen = points_seen(tree_, view_of(camera, kAspect), across, kCoarse.image);
    c.score = promise(tree_, c, wanted_.subject_triangles, full(inside));
    return c;
  }

  // The most promising ones: before the subject, and within it where it is a place. A light that is given may
  // shine in any hollow.
  std::vector<Candidate> cameras() const {
    if (wanted_.fixed_camera)
      return {candidate(*wanted_.fixed_camera, subject_.contains(wanted_.fixed_camera->position))};
    std::vector<Candidate> best = outside_cameras(), inside;
    if (wanted_.fixed_light || subject_.is_place()) inside = inside_cameras();
    for (auto* list : {&best, &inside}) {
      std::ranges::stable_sort(*list, std::greater<>(), &Candidate::score);
      if (list->size() > kCameras) list->resize(kCameras);
    }
    std::ranges::move(inside, std::back_inserter(best));
    return best;
  }

  std::vector<Candidate> outside_cameras() const {
    std::vector<Candidate> out;
    for (const float elevation : {5.0f, 20.0f, 40.0f, 65.0f}) {
      for (int k = 0; k < 16; ++k) {
        const glm::vec3 direction = -direction_of(22.5f * static_cast<float>(k), elevation);
        const glm::vec3 eye = subject_.eye_before(direction, radians(kOutsideVfov), kAspect);
        out.push_back(candidate(camera_at(eye, direction, kOutsideVfov), false));
      }
    }
    return out;
  }

  std::vector<Candidate> inside_cameras() const {
    std::vector<Candidate> out;
    for (const glm::vec3& eye : subject_.grid({0.12f, 0.37f, 0.63f, 0.88f}, {0.2f, 0.45f, 0.75f})) {
      if (!subject_.surrounds(eye)) continue;
      for (int k = 0; k < 8; ++k)
        out.push_back(
            candidate(camera_at(eye, direction_of(45.0f * static_cast<float>(k), -8), kInsideVfov), true));
    }
    return out;
  }

  void try_lights(const Candidate& c, std::vector<FoundView>* shots) const {
    if (c.seen.empty() || !(c.score > 0 || wanted_.fixed_camera)) return;
    for (const Light& light : lights_for(c)) {
      FoundView found{.shot = {c.camera, light}, .measure = {}, .inside = c.inside};
      found.measure = measure_shot(tree_, found.shot, c.seen, rays(kCoarse));
      found.score = score_of(found.measure, found, radius(), full(c.inside));
      if (found.score > 0) shots->push_back(found);
    }
  }

  // Spots from above and beside the subject on its centre; within a place, or for a camera that stays, also
  // from the air between the camera and a point that it sees, on another one.
  std::vector<Light> lights_for(const Candidate& c) const {
    if (wanted_.fixed_light) return {*wanted_.fixed_light};
    std::vector<Light> out;
    const glm::vec3 back = -c.camera.direction;
    const float azimuth = std::atan2(back.x, back.z) * 180 / std::numbers::pi_v<float>;
    for (const float elevation : {20.0f, 45.0f, 70.0f}) {
      for (const float turn : {-120.0f, -75.0f, -40.0f, 40.0f, 75.0f, 120.0f}) {
        const glm::vec3 side = direction_of(azimuth + turn, elevation);
        for (const float fov : {30.0f, 50.0f})
          out.push_back(spot_at(subject_.eye_before(-side, radians(40), 1), subject_.centre(), fov));
      }
    }
    if (!c.inside && !wanted_.fixed_camera) return out;
    const size_t n = c.seen.size();
    for (size_t i = 0; i < kPlaces; ++i) {
      const glm::vec3 place = glm::mix(c.camera.position, c.seen[i * n / kPlaces].position, 0.6f);
      for (size_t k = 1; k <= 2; ++k) {
        const ShotPoint& target = c.seen[(i * n / kPlaces + k * n / 3) % n];
        if (glm::length(target.position - place) > 0.1f * radius())
          out.push_back(spot_at(place, target.position, 60));
      }
    }
    return out;
  }

  const TriangleTree& tree_;
  const ViewSearch& wanted_;
  Subject subject_;
};

}  // namespace

bool is_good(const ShotMeasure& m, const WantedShot& wanted) {
  return m.seen >= wanted.seen && m.lit_seen >= wanted.lit_seen &&
         m.subject_direct >= wanted.subject_direct && m.reached >= wanted.reached &&
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
