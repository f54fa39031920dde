#include "scene/model_scene.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "scene/scene_objects.h"
#include "scene/scene_writer.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr double kDegree = 180 / std::numbers::pi;
constexpr double kPointCone = 120;  // degrees, of a point light's spot
constexpr size_t kMostViews = 16;   // of a file's cameras, and of its lights

// Letters, digits, '_', '.' and '-' stay, anything else becomes '_'.
std::string plain(const std::string& text, const std::string& otherwise) {
  std::string out = text.substr(0, 64);
  for (char& c : out)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
  if (out.starts_with('.')) out.front() = '_';
  return out.empty() ? otherwise : out;
}

class Maker {
 public:
  Maker(const fs::path& path, const Scene& geometry, const std::string& file)
      : geometry_(geometry), subject_(static_cast<uint32_t>(geometry.triangles.size())), write_(geometry) {
    file_ = gltf_views(path);
    out_.notes = file_.notes;
    out_.json = {{"name", model_name(path)},
                 {"description", path.filename().string()},
                 {"geometry", {{"file", file}}},
                 {"unit", 1}};
  }

  ModelScene make() {
    const TriangleTree tree(geometry_);
    const bool own = add_file_views(tree);
    std::string standard = own ? default_ : "";
    if (!own && !find(tree)) find_with_scenery();
    if (!own) standard = "found";
    out_.json["about"] = write_.about(out_.notes);
    out_.json["default_view"] = standard;
    out_.json["views"] = views_;
    return std::move(out_);
  }

 private:
  void note(const std::string& text) { out_.notes.push_back(text); }

  // A view of a name that no other has.
  void add(std::string name, Json view) {
    const std::string stem = name;
    for (int k = 2; views_.contains(name); ++k) name = fmt::format("{}-{}", stem, k);
    if (default_.empty()) default_ = name;
    views_[name] = std::move(view);
  }

  // --- What the file brings

  Shot shot_of(const GltfCamera* camera, const GltfLight* light) const {
    Shot shot;
    const auto local = [&](const glm::dvec3& p) { return glm::vec3(p - geometry_.origin); };
    if (camera) {
      shot.camera.position = local(camera->eye);
      shot.camera.direction = glm::vec3(camera->direction);
      shot.camera.up = glm::vec3(camera->up);
      shot.camera.vfov = static_cast<float>(camera->vfov / kDegree);
    }
    if (!light) return shot;
    Light& l = shot.light;
    l.position = local(light->position);
    l.direction = glm::vec3(light->direction);
    l.up = glm::vec3(light->up);
    l.power = glm::vec3(light->power);
    l.fov = static_cast<float>(light->fov / kDegree);
    if (light->type == GltfLight::Type::sun) {
      l.type = Light::Type::directional;
      const glm::dvec2 half = light->half_extent.value_or(glm::dvec2(0.5 * geometry_.diagonal()));
      if (!light->half_extent) l.position = 0.5f * (geometry_.bounds_min + geometry_.bounds_max);
      l.half_extent = glm::vec2(half);
      l.position -= 2 * geometry_.diagonal() * l.direction;  // before all there is
    }
    return shot;
  }

  // A point light as a spot towards what the camera sees.
  static GltfLight as_spot(const TriangleTree& tree, const Camera& camera, const glm::dvec3& origin,
                           GltfLight light) {
    light.fov = kPointCone;
    glm::dvec3 sum(0);
    const auto seen = points_seen(tree, view_of(camera), 16, 9);
    for (const ShotPoint& p : seen) sum += glm::dvec3(p.position) + origin;
    const glm::dvec3 way =
        seen.empty() ? glm::dvec3(camera.direction) : sum / static_cast<double>(seen.size()) - light.position;
    light.direction = glm::length(way) > 0 ? glm::normalize(way) : glm::dvec3(camera.direction);
    const glm::dvec3 axis = std::abs(light.direction.y) > 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    light.up = glm::normalize(axis - glm::dot(axis, light.direction) * light.direction);
    light.type = GltfLight::Type::spot;
    return light;
  }

  void add_file_view(const TriangleTree& tree, const std::string& name, const GltfCamera& camera,
                     GltfLight light) {
    if (light.type == GltfLight::Type::point) {
      note(fmt::format("point light '{}' is read as a spot of {} degrees towards what camera '{}' sees",
                       light.name, kPointCone, camera.name));
      light = as_spot(tree, shot_of(&camera, nullptr).camera, geometry_.origin, light);
    }
    const ShotMeasure measure = measure_shot(tree, shot_of(&camera, &light), fine());
    const bool works = measure.lit_seen > 0 && measure.reached > 0;
    if (!works) {
      note(fmt::format(
          "camera '{}' sees no indirect light of '{}': of its picture {:.0f} % shows a surface, of "
          "what the light lights it sees {:.0f} %",
          camera.name, light.name, 100 * measure.seen, 100 * measure.lit_seen));
    }
    const std::string before = default_;
    add(name,
        {{"description", fmt::format("camera '{}' and light '{}' of the file", camera.name, light.name)},
         {"camera", json_of(camera)},
         {"light", json_of(light)}});
    if (!works) default_ = before;
  }

  // Whether one of them is fit to be the default.
  bool add_file_views(const TriangleTree& tree) {
    const auto& cameras = file_.cameras;
    const auto& lights = file_.lights;
    if (cameras.size() > kMostViews || lights.size() > kMostViews)
      note(fmt::format("of {} cameras and {} lights of the file the first {} of either make views",
                       cameras.size(), lights.size(), kMostViews));
    for (size_t i = 0; i < std::min(cameras.size(), kMostViews); ++i) {
      const std::string name = plain(cameras[i].name, fmt::format("camera-{}", i));
      if (lights.empty()) {
        add_lit_camera(tree, name, cameras[i]);
      } else {
        add_file_view(tree, name, cameras[i], lights.front());
      }
    }
    for (size_t i = 1; !cameras.empty() && i < std::min(lights.size(), kMostViews); ++i)
      add_file_view(tree, plain(lights[i].name, fmt::format("light-{}", i)), cameras.front(), lights[i]);
    if (cameras.empty() && !lights.empty()) {
      for (size_t i = 0; i < std::min(lights.size(), kMostViews); ++i) add_seen_light(tree, lights[i], i);
    }
    return !default_.empty();
  }

  // The file's camera, with a found spot.
  void add_lit_camera(const TriangleTree& tree, const std::string& name, const GltfCamera& camera) {
    const auto found = find_view(tree, {.fixed_camera = shot_of(&camera, nullptr).camera});
    if (!found || !is_good(found->measure)) {
      return note(fmt::format("camera '{}' is left out: no light was found whose indirect light it would see",
                              camera.name));
    }
    note(fmt::format("the file has no light: a spot was found for its camera '{}'", camera.name));
    add(name, {{"description", fmt::format("camera '{}' of the file, with a found spot", camera.name)},
               {"camera", json_of(camera)},
               {"light", write_.view_of(*found).at("light")}});
  }

  // The file's light, with a found camera.
  void add_seen_light(const TriangleTree& tree, GltfLight light, size_t index) {
    if (light.type == GltfLight::Type::point) {
      Camera middle;  // looks down on the middle of all there is
      middle.position = shot_of(nullptr, &light).light.position;
      middle.direction = glm::vec3(0, -1, 0);
      middle.up = glm::vec3(0, 0, 1);
      middle.vfov = 2;
      note(fmt::format("point light '{}' is read as a spot of {} degrees downwards", light.name, kPointCone));
      light = as_spot(tree, middle, geometry_.origin, light);
    }
    const auto found = find_view(tree, {.fixed_light = shot_of(nullptr, &light).light});
    if (!found || !is_good(found->measure))
      return note(
          fmt::format("light '{}' is left out: no view was found that sees its indirect light", light.name));
    note(fmt::format("the file has no camera: a view was found for its light '{}'", light.name));
    add(plain(light.name, fmt::format("light-{}", index)),
        {{"description", fmt::format("light '{}' of the file, with a found camera", light.name)},
         {"camera", write_.view_of(*found).at("camera")},
         {"light", json_of(light)}});
  }

  // --- What is found

  ShotRays fine() const { return {.image = 20, .light = 20, .links = 4, .subject_triangles = subject_}; }

  // A view of the geometry as it is, where it lights itself.
  bool find(const TriangleTree& tree) {
    const auto found = find_view(tree);
    if (!found || !is_good(found->measure, found->inside ? WantedShot{} : kWantedOfLoneObject)) return false;
    note("a view and a spot were found from the bounds of the geometry");
    add("found", write_.view_of(*found));
    return true;
  }

  // A view of the geometry on a floor between two walls.
  void find_with_scenery() {
    out_.json["objects"] = write_.scenery();
    Scene staged = geometry_;
    add_objects(JsonDocument::parse(out_.json.dump(), "scenery", ErrorKind::scene), 1, &staged);
    const TriangleTree tree(staged);
    const auto found = find_view(tree, {.subject_triangles = subject_});
    if (!found) {
      throw fail(
          ErrorKind::scene,
          "{}: no view and light were found that show anything of it; write a scene.json with a camera and a "
          "light (scenes/README.md)",
          out_.json.at("description").get<std::string>());
    }
    note(
        "by itself the geometry sends little light to itself, as a convex object does: a floor and two walls "
        "were "
        "added, and a view and a spot found");
    if (!is_good(found->measure))
      note("the found view is poor: little of the lit surface is seen, or little light comes back");
    add("found", write_.view_of(*found));
  }

  const Scene& geometry_;
  uint32_t subject_;
  SceneWriter write_;
  GltfViews file_;
  ModelScene out_;
  Json views_ = Json::object();
  std::string default_;
};

}  // namespace

bool is_model(const fs::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".gltf" || ending == ".glb";
}

std::string model_name(const fs::path& path) { return plain(path.stem().string(), "model"); }

ModelScene model_scene(const fs::path& path, const Scene& geometry, const std::string& file) {
  return Maker(path, geometry, file).make();
}

}  // namespace vsglbench
