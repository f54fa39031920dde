#include "scene/scene_view.h"

#include <algorithm>
#include <cmath>

#include "scene/animation.h"
#include "scene/scene_keys.h"
#include "scene/view_motion.h"

namespace vsglbench {
namespace {

constexpr double kLargestLength = 1e15;  // metres; keeps squares finite in float

class ViewReader {
 public:
  ViewReader(const JsonDocument& document, double unit) : document_(document), unit_(unit) {}

  CameraMotion camera(const std::string& at) const {
    const KeyList keys(document_, at);
    const auto angle = [this](const std::string& p) { return number(p); };
    return {aim(at, keys, "eye"), keys.track("vfov", number(at + "/vfov"), angle)};
  }

  LightMotion light(const std::string& at) const {
    const Json& json = value(at);
    if (json.size() != 1) throw document_.error(at, "must hold one light, either 'spot' or 'sun'");
    return json.contains("spot") ? spot(at + "/spot") : sun(at + "/sun");
  }

  std::optional<Region> region(const std::string& at) const {
    if (!has(at)) return std::nullopt;
    const Json& v = value(at);
    const Region r{v[0].get<double>(), v[1].get<double>(), v[2].get<double>(), v[3].get<double>()};
    if (!(r.x0 < r.x1))
      throw document_.error(at, fmt::format("has x0 = {}, which is not below x1 = {}", r.x0, r.x1));
    if (!(r.y0 < r.y1))
      throw document_.error(at, fmt::format("has y0 = {}, which is not below y1 = {}", r.y0, r.y1));
    return r;
  }

 private:
  const Json& value(const std::string& at) const { return document_.root().at(Json::json_pointer(at)); }
  bool has(const std::string& at) const { return document_.root().contains(Json::json_pointer(at)); }
  double number(const std::string& at) const { return value(at).get<double>(); }

  glm::dvec3 vector(const std::string& at) const {
    const Json& v = value(at);
    const glm::dvec3 out(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
    if (!(glm::length(out) * unit_ < kLargestLength)) throw document_.error(at, "is too large");
    return out;
  }

  glm::dvec3 power(const std::string& at, double scale) const {
    const Json& v = value(at);
    const glm::dvec3 p = v.is_number() ? glm::dvec3(v.get<double>()) : vector(at);
    if (!(scale * std::max({p.x, p.y, p.z}) < 1e30)) throw document_.error(at, "is too large");
    return p;
  }

  Track<glm::dvec3> vectors(const KeyList& keys, const std::string& property,
                            const glm::dvec3& constant) const {
    return keys.track(property, constant, [this](const std::string& p) { return vector(p); });
  }
  Track<glm::dvec3> powers(const KeyList& keys, const std::string& at, const std::string& property,
                           double scale) const {
    return keys.track(property, power(at + "/" + property, scale),
                      [&](const std::string& p) { return power(p, scale); });
  }

  // `position` is the key of where it stands; "" for a sun.
  AimMotion aim(const std::string& at, const KeyList& keys, const std::string& position) const {
    const bool given = has(at + "/direction"), aimed = has(at + "/target");
    if (given == aimed) throw document_.error(at, "must have either 'direction' or 'target'");
    const std::string used = aimed ? "target" : "direction", other = aimed ? "direction" : "target";
    keys.refuse(other, fmt::format("can't be keyed, since '{}' is what it has without keys", used));
    const glm::dvec3 from = position.empty() ? glm::dvec3(0) : vector(at + "/" + position);
    const glm::dvec3 to = vector(at + "/" + used);
    if (!(glm::length(aimed ? to - from : to) > 0)) {
      throw document_.error(at + "/" + used, aimed ? "is where it looks from" : "has no length");
    }
    const glm::dvec3 up = has(at + "/up") ? vector(at + "/up") : glm::dvec3(0, 1, 0);
    if (!(glm::length(up) > 0)) throw document_.error(at + "/up", "has no length");
    return {unit_, vectors(keys, position, from), vectors(keys, used, to), vectors(keys, "up", up), aimed};
  }

  LightMotion spot(const std::string& at) const {
    const KeyList keys(document_, at);
    LightMotion light;
    light.aim = aim(at, keys, "position");
    light.power = powers(keys, at, "intensity", unit_ * unit_);
    light.fov = keys.track("fov", number(at + "/fov"), [this](const std::string& p) { return number(p); });
    return light;
  }

  LightMotion sun(const std::string& at) const {
    const KeyList keys(document_, at);
    LightMotion light;
    light.sun = true;
    light.aim = aim(at, keys, "");
    light.power = powers(keys, at, "irradiance", 1);
    if (has(at + "/centre") != has(at + "/half_extent")) {
      throw document_.error(at, "must have both 'centre' and 'half_extent', or neither");
    }
    if (!has(at + "/centre")) return light;
    light.aim.position = Track(vector(at + "/centre"));
    const Json& half = value(at + "/half_extent");
    light.half_extent = glm::dvec2(half[0].get<double>(), half[1].get<double>());
    const glm::dvec2 metres = *light.half_extent * unit_;
    if (!(metres.x > 0 && metres.y > 0 && glm::length(metres) < kLargestLength)) {
      throw document_.error(at + "/half_extent", "must be positive");
    }
    return light;
  }

  const JsonDocument& document_;
  double unit_;
};

bool keyed(const AimMotion& aim) { return aim.position.keyed() || aim.aim.keyed() || aim.up.keyed(); }
bool keyed(const CameraMotion& camera) { return keyed(camera.aim) || camera.vfov.keyed(); }
bool keyed(const LightMotion& light) { return keyed(light.aim) || light.power.keyed() || light.fov.keyed(); }

// A rectangle that was fitted to what stands still must light the objects, too.
void check_rectangle(const Scene& scene, const Light& light, uint32_t frame) {
  const glm::vec3 right = glm::cross(light.direction, light.up);
  const glm::vec2 half = light.half_extent * 1.001f;
  for (const MovingObject& object : scene.animation.objects) {
    const Extent& box = object.extents[frame];
    for (int k = 0; k < 8; ++k) {
      const glm::vec3 d = glm::vec3(k & 1 ? box.high.x : box.low.x, k & 2 ? box.high.y : box.low.y,
                                    k & 4 ? box.high.z : box.low.z) -
                          light.position;
      if (std::abs(glm::dot(d, right)) <= half.x && std::abs(glm::dot(d, light.up)) <= half.y) continue;
      throw fail(ErrorKind::scene,
                 "'{}' is outside the sun's rectangle, which covers what stands still; give 'centre' and "
                 "'half_extent'",
                 object.name);
    }
  }
}

// Poses `motion` in all frames, each of which check(pose, frame) may refuse; whether they differ. `first`
// becomes the first pose.
template <class Motion, class Pose, class Check>
bool pose_all(const JsonDocument& document, const std::string& at, const Motion& motion, const Scene& scene,
              Pose* first, const Check& check) {
  bool moves = false;
  for (uint32_t frame = 0; frame < frame_count(scene); ++frame) {
    try {
      const bool anew = frame == 0 || keyed(motion);
      const Pose pose = anew ? posed(motion, scene, frame_time(scene, frame)) : *first;
      if (frame == 0) *first = pose;
      moves |= !same_bits(pose, *first);
      check(pose, frame);
    } catch (const Error& e) {
      const bool several = frame_count(scene) > 1;
      throw document.error(at, several ? fmt::format("at frame {}: {}", frame, e.what()) : e.what());
    }
  }
  return moves;
}

}  // namespace

void check_view(const std::string& pointer, double unit, SceneProblems* problems) {
  const ViewReader reader(problems->document(), unit);
  problems->check(pointer + "/region", [&](const std::string& at) { reader.region(at); });
  problems->check(pointer + "/camera", [&](const std::string& at) { reader.camera(at); });
  problems->check(pointer + "/light", [&](const std::string& at) { reader.light(at); });
}

void apply_view(const JsonDocument& document, const std::string& pointer, double unit, Scene* scene) {
  const ViewReader reader(document, unit);
  const std::string camera_at = pointer + "/camera", light_at = pointer + "/light";
  Animation& animation = scene->animation;
  scene->region = reader.region(pointer + "/region");
  const CameraMotion camera = reader.camera(camera_at);
  animation.moves.camera =
      pose_all(document, camera_at, camera, *scene, &scene->camera, [](const Camera&, uint32_t) {});
  if (keyed(camera)) animation.camera = camera;

  const LightMotion light = reader.light(light_at);
  const bool fitted = light.sun && !light.half_extent;
  animation.moves.light =
      pose_all(document, light_at, light, *scene, &scene->light, [&](const Light& pose, uint32_t frame) {
        if (fitted) check_rectangle(*scene, pose, frame);
      });
  if (keyed(light)) animation.light = light;
  if (light.sun && animation.frames > 0) animation.sun_place = scene->light.position;
  fit_depth_ranges(scene);
}

}  // namespace vsglbench
