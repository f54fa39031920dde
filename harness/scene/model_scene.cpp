#include "scene/model_scene.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>

#include "scene/found_view.h"
#include "scene/gltf_views.h"
#include "scene/scene_objects.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr double kDegree = 180 / std::numbers::pi;
constexpr double kPointCone = 120;     // degrees, of a point light's spot
constexpr size_t kMostMaterials = 64;  // that `about` lists
constexpr size_t kMostViews = 16;      // of a file's cameras, and of its lights

// Letters, digits, '_', '.' and '-' stay, anything else becomes '_'.
std::string plain(const std::string& text, const std::string& otherwise) {
  std::string out = text.substr(0, 64);
  for (char& c : out)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
  if (out.starts_with('.')) out.front() = '_';
  return out.empty() ? otherwise : out;
}

// A number of so many decimals, without the digits that binary adds.
double rounded(double value, int decimals) {
  return std::stod(fmt::format("{:.{}f}", value, std::max(0, decimals))) + 0.0;
}

Json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Of the scenery behind a lone object.
Json quad(const std::string& name, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v,
          const glm::dvec3& color) {
  return {{"name", name},
          {"quad", {{"corner", numbers(corner)}, {"u", numbers(u)}, {"v", numbers(v)}}},
          {"material", {{"base_color", numbers(color)}, {"roughness", 1}, {"specular", 0}}}};
}

class Maker {
 public:
  Maker(const fs::path& path, const Scene& geometry, const std::string& file)
      : geometry_(geometry), subject_(static_cast<uint32_t>(geometry.triangles.size())) {
    // Four digits of the scene's size.
    decimals_ = 3 - static_cast<int>(std::floor(std::log10(std::max(1e-30f, geometry.diagonal()))));
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
    out_.json["about"] = about();
    out_.json["default_view"] = standard;
    out_.json["views"] = views_;
    return std::move(out_);
  }

 private:
  glm::dvec3 world(const glm::vec3& p) const { return glm::dvec3(p) + geometry_.origin; }
  Json place(const glm::dvec3& p) const {
    return {rounded(p.x, decimals_), rounded(p.y, decimals_), rounded(p.z, decimals_)};
  }
  void note(const std::string& text) { out_.notes.push_back(text); }

  // A view of a name that no other has.
  void add(std::string name, Json view) {
    const std::string stem = name;
    for (int k = 2; views_.contains(name); ++k) name = fmt::format("{}-{}", stem, k);
    if (default_.empty()) default_ = name;
    views_[name] = std::move(view);
  }

  // --- What the file brings
  // ---------------------------------------------------------------------------------

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
    const auto seen = points_seen(tree, camera_view(camera, 4096 * 16 / 9, 4096), 16, 9);
    for (const ShotPoint& p : seen) sum += glm::dvec3(p.position) + origin;
    const glm::dvec3 way =
        seen.empty() ? glm::dvec3(camera.direction) : sum / static_cast<double>(seen.size()) - light.position;
    light.direction = glm::length(way) > 0 ? glm::normalize(way) : glm::dvec3(camera.direction);
    const glm::dvec3 axis = std::abs(light.direction.y) > 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    light.up = glm::normalize(axis - glm::dot(axis, light.direction) * light.direction);
    light.type = GltfLight::Type::spot;
    return light;
  }

  static Json json_of(const GltfCamera& c) {
    return {{"eye", numbers(c.eye)},
            {"direction", numbers(c.direction)},
            {"up", numbers(c.up)},
            {"vfov", c.vfov}};
  }
  static Json json_of(const GltfLight& l) {
    if (l.type == GltfLight::Type::sun) {
      Json sun = {
          {"direction", numbers(l.direction)}, {"up", numbers(l.up)}, {"irradiance", numbers(l.power)}};
      if (l.half_extent) {
        sun["centre"] = numbers(l.position);
        sun["half_extent"] = {l.half_extent->x, l.half_extent->y};
      }
      return {{"sun", sun}};
    }
    return {{"spot",
             {{"position", numbers(l.position)},
              {"direction", numbers(l.direction)},
              {"up", numbers(l.up)},
              {"fov", l.fov},
              {"intensity", numbers(l.power)}}}};
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
      return note(
          fmt::format("camera '{}' is left out: no light was found that it would see the indirect light of",
                      camera.name));
    }
    note(fmt::format("the file has no light: a spot was found for its camera '{}'", camera.name));
    add(name, {{"description", fmt::format("camera '{}' of the file, with a found spot", camera.name)},
               {"camera", json_of(camera)},
               {"light", json_of(*found).at("light")}});
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
         {"camera", json_of(*found).at("camera")},
         {"light", json_of(light)}});
  }

  // --- What is found
  // ----------------------------------------------------------------------------------------

  ShotRays fine() const { return {.image = 20, .light = 20, .links = 4, .subject_triangles = subject_}; }

  Json json_of(const FoundView& found) const {
    const Camera& c = found.shot.camera;
    const Light& l = found.shot.light;
    const auto metres = static_cast<float>(std::max(found.measure.depth, 1e-3 * geometry_.diagonal()));
    const auto reach = std::max(static_cast<float>(found.measure.nearest), 1e-3f * geometry_.diagonal());
    return {
        {"description",
         fmt::format(
             "found from the bounds: {:.0f} % of the lit surface is seen, indirect light reaches {:.0f} % "
             "of the picture's surfaces",
             100 * found.measure.lit_seen, 100 * found.measure.reached)},
        {"camera",
         {{"eye", place(world(c.position))},
          {"target", place(world(c.position + metres * c.direction))},
          {"vfov", std::round(c.vfov * kDegree)}}},
        {"light",
         {{"spot",
           {{"position", place(world(l.position))},
            {"target", place(world(l.position + reach * l.direction))},
            {"fov", std::round(l.fov * kDegree)},
            {"intensity", std::stod(fmt::format("{:.2g}", l.power.x))}}}}}};
  }

  // A view of the geometry as it is.
  bool find(const TriangleTree& tree) {
    const auto found = find_view(tree);
    if (!found || !is_good(found->measure)) return false;
    note("a view and a spot were found from the bounds of the geometry");
    add("found", json_of(*found));
    return true;
  }

  // A view of the geometry on a floor between two walls.
  void find_with_scenery() {
    out_.json["objects"] = scenery();
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
    add("found", json_of(*found));
  }

  // Behind the object, to its left, and a little below it, so that no surfaces coincide.
  Json scenery() const {
    const glm::dvec3 low = world(geometry_.bounds_min), high = world(geometry_.bounds_max), side = high - low;
    const double size = std::max({side.x, side.y, side.z, 1e-6 * glm::length(side)});
    const double gap = 0.35 * size, x0 = low.x - gap, z0 = low.z - gap, y0 = low.y - 0.005 * size;
    const double x1 = high.x + 0.9 * size, z1 = high.z + 0.9 * size, y1 = high.y + 0.6 * size;
    const auto at = [&](double x, double y, double z) {
      return glm::dvec3(rounded(x, decimals_), rounded(y, decimals_), rounded(z, decimals_));
    };
    const glm::dvec3 corner = at(x0, y0, z0), far = at(x1, y1, z1), reach = far - corner;
    const auto along = [&](int axis) {
      glm::dvec3 v(0);
      v[axis] = rounded(reach[axis], decimals_);
      return v;
    };
    const glm::dvec3 grey(0.7), red(0.65, 0.25, 0.2);
    return Json::array({quad("floor", corner, along(2), along(0), grey),
                        quad("back wall", corner, along(0), along(1), grey),
                        quad("side wall", corner, along(1), along(2), red)});
  }

  // --- For the reader
  // ---------------------------------------------------------------------------------------

  Json about() const {
    Json materials = Json::array();
    std::set<uint32_t> used(geometry_.triangle_material.begin(), geometry_.triangle_material.end());
    for (const uint32_t i : used) {
      if (materials.size() == kMostMaterials) break;
      const Material& m = geometry_.materials[i];
      materials.push_back(
          {{"name", m.name},
           {"base_color",
            {rounded(m.base_color.x, 4), rounded(m.base_color.y, 4), rounded(m.base_color.z, 4)}},
           {"metallic", rounded(m.metallic, 4)},
           {"roughness", rounded(m.roughness, 4)},
           {"textured", m.base_color_texture >= 0}});
    }
    return {{"triangles", subject_},
            {"unit", "1 length unit is 1 m, as glTF has it; change `unit` if the file's is another"},
            {"bounds", {place(world(geometry_.bounds_min)), place(world(geometry_.bounds_max))}},
            {"materials", materials},
            {"notes", out_.notes}};
  }

  const Scene& geometry_;
  uint32_t subject_;
  int decimals_ = 3;
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
