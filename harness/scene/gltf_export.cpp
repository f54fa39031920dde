#include "scene/gltf_export.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/file.h"
#include "image/png.h"
#include "scene/gltf_views.h"
#include "scene/model_scene.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr int kFloat = 5126, kUint = 5125, kVertices = 34962, kIndices = 34963;
constexpr double kDegree = 180 / std::numbers::pi;

Json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// GGX's alpha is its square.
float roughness_of(const Material& m) {
  return m.phong_exponent > 0 ? std::pow(2 / (m.phong_exponent + 2), 0.25f) : m.roughness;
}

// Names must differ: scene.json tells materials apart by them.
std::string name_of(const Scene& scene, size_t i) { return fmt::format("{}-{}", i, scene.materials[i].name); }

class Writer {
 public:
  Writer(const Scene& scene, const fs::path& folder) : scene_(scene), folder_(folder) {}

  void write() {
    add_geometry();
    add_materials();
    add_textures();
    add_camera();
    add_light();
    write_text(folder_ / "scene.bin", bin_);
    json_["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", bin_.size()}}};
    write_text(folder_ / "scene.gltf", json_.dump(1) + "\n");
  }

 private:
  // Appends an array as a buffer view with an accessor; the accessor's index.
  template <class T>
  size_t add(const std::vector<T>& values, int component, const char* type, int target) {
    json_["bufferViews"].push_back({{"buffer", 0},
                                    {"byteOffset", bin_.size()},
                                    {"byteLength", values.size() * sizeof(T)},
                                    {"target", target}});
    bin_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", component},
                                  {"count", values.size()},
                                  {"type", type}});
    return json_["accessors"].size() - 1;
  }

  // One mesh whose primitives, one a batch, share their vertices; they stand relative to the scene's origin.
  void add_geometry() {
    const size_t position = add(scene_.positions, kFloat, "VEC3", kVertices);
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& p : scene_.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    json_["accessors"][position]["min"] = {low.x, low.y, low.z};
    json_["accessors"][position]["max"] = {high.x, high.y, high.z};
    const Json attributes = {{"POSITION", position},
                             {"NORMAL", add(scene_.normals, kFloat, "VEC3", kVertices)},
                             {"TANGENT", add(scene_.tangents, kFloat, "VEC4", kVertices)},
                             {"TEXCOORD_0", add(scene_.uvs, kFloat, "VEC2", kVertices)}};
    Json primitives = Json::array();
    for (const Batch& batch : scene_.batches) {
      std::vector<uint32_t> indices;
      for (uint32_t i = batch.first_triangle; i < batch.first_triangle + batch.triangle_count; ++i)
        for (int k = 0; k < 3; ++k) indices.push_back(scene_.triangles[i][k]);
      primitives.push_back({{"attributes", attributes},
                            {"indices", add(indices, kUint, "SCALAR", kIndices)},
                            {"material", batch.material}});
    }
    json_["meshes"] = {{{"name", scene_.name}, {"primitives", primitives}}};
    add_node({{"name", "geometry"}, {"mesh", 0}, {"translation", numbers(scene_.origin)}});
  }

  void add_materials() {
    json_["materials"] = Json::array();
    for (size_t i = 0; i < scene_.materials.size(); ++i) {
      const Material& m = scene_.materials[i];
      Json pbr = {{"baseColorFactor", {m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w}},
                  {"metallicFactor", m.metallic},
                  {"roughnessFactor", roughness_of(m)}};
      if (m.base_color_texture >= 0) pbr["baseColorTexture"] = {{"index", m.base_color_texture}};
      if (m.metallic_roughness_texture >= 0)
        pbr["metallicRoughnessTexture"] = {{"index", m.metallic_roughness_texture}};
      Json material = {{"name", name_of(scene_, i)}, {"pbrMetallicRoughness", pbr}, {"doubleSided", true}};
      if (m.normal_texture >= 0)
        material["normalTexture"] = {{"index", m.normal_texture}, {"scale", m.normal_scale}};
      if (m.alpha_cutoff >= 0) material.update({{"alphaMode", "MASK"}, {"alphaCutoff", m.alpha_cutoff}});
      json_["materials"].push_back(material);
    }
  }

  void add_textures() {
    for (size_t i = 0; i < scene_.textures.size(); ++i) {
      const Texture& t = scene_.textures[i];
      const std::string file = fmt::format("texture-{}.png", i);
      Bitmap bitmap(t.width, t.height, 4);
      bitmap.bytes = t.rgba;
      write_png(folder_ / file, bitmap);
      json_["images"].push_back({{"uri", file}});
      json_["textures"].push_back({{"source", i}});
    }
  }

  void add_node(Json node) {
    json_["nodes"].push_back(std::move(node));
    json_["scenes"][0]["nodes"].push_back(json_["nodes"].size() - 1);
  }

  // What looks along -z with +y up.
  Json placed(const glm::vec3& position, const glm::vec3& direction, const glm::vec3& up) const {
    const glm::dvec3 d(direction), u(up), right = glm::cross(d, u), p = glm::dvec3(position) + scene_.origin;
    return {
        {"matrix", {right.x, right.y, right.z, 0, u.x, u.y, u.z, 0, -d.x, -d.y, -d.z, 0, p.x, p.y, p.z, 1}}};
  }

  void add_camera() {
    const Camera& c = scene_.camera;
    json_["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", c.vfov}, {"znear", c.near}, {"zfar", c.far}}}}};
    Json node = placed(c.position, c.direction, c.up);
    node.update({{"name", "camera"}, {"camera", 0}});
    add_node(node);
  }

  void add_light() {
    const Light& l = scene_.light;
    const glm::dvec3 power(l.power);
    const double most = std::max({power.x, power.y, power.z});
    Json light = {{"name", "light"},
                  {"color", numbers(most > 0 ? power / most : glm::dvec3(1))},
                  {"intensity", kLumensAWatt * most}};
    Json node = placed(l.position, l.direction, l.up);
    node.update({{"name", "light"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    if (l.type == Light::Type::spot) {
      light.update(
          {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.499 * l.fov}, {"outerConeAngle", 0.5 * l.fov}}}});
    } else {
      light["type"] = "directional";
      node["extras"] = {{"half_extent", {l.half_extent.x, l.half_extent.y}}};
    }
    json_["extensionsUsed"] = {"KHR_lights_punctual"};
    json_["extensions"] = {{"KHR_lights_punctual", {{"lights", {light}}}}};
    add_node(node);
  }

  const Scene& scene_;
  const fs::path& folder_;
  std::string bin_;
  Json json_ = {{"asset", {{"version", "2.0"}, {"generator", "vsglbench"}}},
                {"scene", 0},
                {"scenes", {{{"nodes", Json::array()}}}},
                {"nodes", Json::array()}};
};

// The exact view and light, and what glTF does not say of materials.
Json scene_json(const Scene& scene) {
  const Camera& c = scene.camera;
  const Light& l = scene.light;
  const auto place = [&](const glm::vec3& p) { return numbers(glm::dvec3(p) + scene.origin); };
  Json light;
  if (l.type == Light::Type::spot) {
    light["spot"] = {{"position", place(l.position)},
                     {"direction", numbers(l.direction)},
                     {"up", numbers(l.up)},
                     {"fov", l.fov * kDegree},
                     {"intensity", numbers(l.power)}};
  } else {
    light["sun"] = {{"direction", numbers(l.direction)},
                    {"up", numbers(l.up)},
                    {"irradiance", numbers(l.power)},
                    {"centre", place(l.position)},
                    {"half_extent", {l.half_extent.x, l.half_extent.y}}};
  }
  Json materials = Json::array();
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    if (m.specular != 1 || m.phong_exponent > 0)
      materials.push_back({{"match", name_of(scene, i)},
                           {"specular", m.specular},
                           {"phong_exponent", m.phong_exponent},
                           {"roughness", m.roughness}});
  }
  Json json = {{"name", model_name(fs::path(scene.name + ".gltf"))},
               {"description", "exported: " + scene.name},
               {"geometry", {{"file", "scene.gltf"}}}};
  if (!materials.empty()) json["materials"] = materials;
  json["default_view"] = "exported";
  json["views"]["exported"] = {{"camera",
                                {{"eye", place(c.position)},
                                 {"direction", numbers(c.direction)},
                                 {"up", numbers(c.up)},
                                 {"vfov", c.vfov * kDegree}}},
                               {"light", light}};
  return json;
}

// What the script needs and glTF does not hold.
Json facts(const Scene& scene, uint32_t width, uint32_t height) {
  Json view = scene_json(scene).at("views").at("exported");
  Json materials = Json::object();
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    materials[name_of(scene, i)] = {{"lambert", m.specular == 0}, {"phong", m.phong_exponent > 0}};
  }
  return {{"scene", scene.name},      {"width", width},         {"height", height},
          {"camera", view["camera"]}, {"light", view["light"]}, {"materials", materials}};
}

}  // namespace

void export_scene(const Scene& scene, const fs::path& folder, uint32_t width, uint32_t height) {
  ensure_writable_directory(folder);
  Writer(scene, folder).write();
  write_text(folder / "scene.json", scene_json(scene).dump(2) + "\n");
  write_text(folder / "facts.json", facts(scene, width, height).dump(2) + "\n");
  const fs::path texts = data_root() / "harness" / "scene" / "exported";
  for (const char* file : {"README.md", "render_cycles.py"})
    write_text(folder / file, read_text(texts / file));
}

}  // namespace vsglbench
