#include "scene/subject.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsglbench {
namespace {

constexpr int kOutline = 128;  // directions in which the farthest corner is kept
constexpr float kMargin =
    1.22f;  // a tenth of the picture on either side: 1 / 0.8, less what outlines round off

float radians(float degrees) { return degrees * std::numbers::pi_v<float> / 180; }

// `count` unit vectors, spread evenly by a golden section.
std::vector<glm::vec3> sphere_of(int count) {
  std::vector<glm::vec3> out;
  for (int i = 0; i < count; ++i) {
    const float y = 1 - (2 * static_cast<float>(i) + 1) / static_cast<float>(count);
    const float turn = 2 * std::numbers::pi_v<float> * 0.618034f * static_cast<float>(i);
    const float across = std::sqrt(std::max(0.0f, 1 - y * y));
    out.emplace_back(across * std::cos(turn), y, across * std::sin(turn));
  }
  return out;
}

}  // namespace

glm::vec3 direction_of(float azimuth, float elevation) {
  const float a = radians(azimuth), e = radians(elevation);
  return {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
}

glm::vec3 up_for(const glm::vec3& direction) {
  const glm::vec3 axis = std::abs(direction.y) > 0.999f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
  return glm::normalize(axis - glm::dot(axis, direction) * direction);
}

Subject::Subject(const TriangleTree& tree, uint32_t triangles)
    : tree_(tree), low_(INFINITY), high_(-INFINITY) {
  const Scene& scene = tree.scene();
  const std::vector<glm::vec3> directions = sphere_of(kOutline);
  std::vector<float> farthest(directions.size(), -INFINITY);
  outline_.resize(directions.size());
  std::vector<bool> met(scene.positions.size(), false);
  const size_t count = std::min<size_t>(triangles, scene.triangles.size());
  for (size_t i = 0; i < count; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const uint32_t index = scene.triangles[i][corner];
      if (met[index]) continue;
      met[index] = true;
      const glm::vec3& p = scene.positions[index];
      low_ = glm::min(low_, p);
      high_ = glm::max(high_, p);
      for (size_t k = 0; k < directions.size(); ++k) {
        const float reach = glm::dot(p, directions[k]);
        if (reach > farthest[k]) {
          farthest[k] = reach;
          outline_[k] = p;
        }
      }
    }
  }
}

bool Subject::contains(const glm::vec3& p) const {
  return glm::all(glm::greaterThan(p, low_)) && glm::all(glm::lessThan(p, high_));
}

std::vector<glm::vec3> Subject::grid(const std::vector<float>& sides,
                                     const std::vector<float>& heights) const {
  std::vector<glm::vec3> out;
  for (const float y : heights)
    for (const float x : sides)
      for (const float z : sides) out.push_back(low_ + glm::vec3(x, y, z) * (high_ - low_));
  return out;
}

glm::vec3 Subject::eye_before(const glm::vec3& direction, float vfov, float aspect) const {
  const glm::vec3 up = up_for(direction), right = glm::cross(direction, up);
  const glm::vec2 t = std::tan(0.5f * vfov) / kMargin * glm::vec2(aspect, 1);
  // The middle of what is seen from far away, and from there how far back.
  glm::vec3 low(INFINITY), high(-INFINITY);
  for (const glm::vec3& p : outline_) {
    const glm::vec3 d = p - centre();
    const glm::vec3 seen(glm::dot(d, right), glm::dot(d, up), glm::dot(d, direction));
    low = glm::min(low, seen);
    high = glm::max(high, seen);
  }
  const glm::vec3 shift = 0.5f * (low + high);
  float back = 0;
  for (const glm::vec3& p : outline_) {
    const glm::vec3 d = p - centre();
    const float depth = glm::dot(d, direction);
    back = std::max({back, std::abs(glm::dot(d, right) - shift.x) / t.x - depth,
                     std::abs(glm::dot(d, up) - shift.y) / t.y - depth});
  }
  return centre() + shift.x * right + shift.y * up - back * direction;
}

Subject::Round Subject::look_round(const glm::vec3& point) const {
  Round round;
  const Scene& scene = tree_.scene();
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const glm::vec3 way = glm::normalize(glm::vec3(x, y, z));
        const auto hit = tree_.intersect(point, way);
        ++round.directions;
        if (!hit) continue;
        ++round.hits;
        const glm::uvec3& t = scene.triangles[hit->triangle];
        const glm::vec3& a = scene.positions[t.x];
        round.fronts += glm::dot(glm::cross(scene.positions[t.y] - a, scene.positions[t.z] - a), way) < 0;
      }
    }
  }
  return round;
}

bool Subject::surrounds(const glm::vec3& point) const {
  const Round round = look_round(point);
  return round.hits > 0.65 * round.directions;
}

bool Subject::is_place() const {
  const std::vector<glm::vec3> points = grid({0.1f, 0.3f, 0.5f, 0.7f, 0.9f}, {0.15f, 0.4f, 0.65f, 0.9f});
  const auto within = [&](const glm::vec3& p) {
    const Round round = look_round(p);
    return round.hits >= 0.85 * round.directions && round.fronts >= 0.8 * round.hits;
  };
  return std::ranges::count_if(points, within) * 3 >= std::ssize(points);
}

}  // namespace vsglbench
