#include <string_view>

#include "fuzz/input.h"
#include "fuzz/targets.h"
#include "scene/check.h"
#include "scene/gltf.h"
#include "scene/scene_file.h"

namespace vsglbench::fuzz {
namespace {

// One triangle, its buffer inside.
constexpr std::string_view kTriangle =
    R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}], "materials": [{"name": "paint"}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36,
 "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

Bytes bytes_of(std::string_view text) { return {reinterpret_cast<const uint8_t*>(text.data()), text.size()}; }

}  // namespace

bool read_gltf(Bytes bytes) {
  const auto path = write_input("input.gltf", bytes);
  Scene scene;
  scene.animation.frames = 2;  // so that animations are read, too
  if (!accepts([&] { load_gltf(path, 1, &scene); })) return false;
  scene.light.up = {0, 0, 1};
  // Whatever loads is sound.
  if (!accepts([&] { check_scene(scene); })) throw std::logic_error("load_gltf made an unsound scene");
  return true;
}

bool read_scene(Bytes bytes) {
  static const auto beside = write_input("triangle.gltf", bytes_of(kTriangle));
  const auto path = write_input("scene.json", bytes);
  return accepts([&] { load_scene(path.string(), {}); });
}

}  // namespace vsglbench::fuzz
