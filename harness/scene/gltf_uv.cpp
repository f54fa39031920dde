#include "scene/gltf_uv.h"

#include <cmath>

namespace vsglbench {
namespace {

double number(const GltfFile& file, const tinygltf::Value& value, const std::string& what) {
  const double v = value.IsNumber() ? value.GetNumberAsDouble() : NAN;
  if (!(std::abs(v) <= 1e6)) throw file.error("{}: KHR_texture_transform has no sound number", what);
  return v;
}

glm::dvec2 pair(const GltfFile& file, const tinygltf::Value& value, const std::string& what) {
  if (!value.IsArray() || value.ArrayLen() != 2)
    throw file.error("{}: KHR_texture_transform has no two numbers", what);
  return {number(file, value.Get(0), what), number(file, value.Get(1), what)};
}

}  // namespace

// The sense of rotation is that of the extension's example, which shows the lower left quadrant of an image
// with offset (0, 1), a quarter turn and scale 1/2.
glm::dvec2 UvMapping::operator()(const glm::dvec2& uv) const {
  const glm::dvec2 s = scale * uv;
  const double c = std::cos(rotation), n = std::sin(rotation);
  return {c * s.x + n * s.y + offset.x, -n * s.x + c * s.y + offset.y};
}

UvMapping uv_mapping(const GltfFile& file, int tex_coord, const tinygltf::ExtensionMap& extensions,
                     const std::string& what) {
  UvMapping out;
  out.set = tex_coord;
  out.textured = true;
  if (const auto found = extensions.find("KHR_texture_transform"); found != extensions.end()) {
    const tinygltf::Value& t = found->second;
    if (t.Has("offset")) out.offset = pair(file, t.Get("offset"), what);
    if (t.Has("scale")) out.scale = pair(file, t.Get("scale"), what);
    if (t.Has("rotation")) out.rotation = number(file, t.Get("rotation"), what);
    if (t.Has("texCoord")) out.set = static_cast<int>(number(file, t.Get("texCoord"), what));
  }
  if (out.set < 0) throw file.error("{}: there is no TEXCOORD_{}", what, out.set);
  return out;
}

}  // namespace vsglbench
