#include "scene/gltf_json.h"

#include <utility>

#include "base/printable.h"

namespace vsglbench {
namespace {

// All strings but those that name what lies elsewhere; what exporters add for themselves is dropped.
void cut_strings(Json* value) {
  if (value->is_string()) *value = excerpt(value->get_ref<const std::string&>());
  if (!value->is_structured()) return;
  if (value->is_object()) value->erase("extras");
  for (Json& v : *value) cut_strings(&v);
}

// Calls `f` for each object in an array of this name, where there is one.
template <class F>
void for_each_in(Json* object, const char* key, F f) {
  if (!object->is_object()) return;
  const auto list = object->find(key);
  if (list == object->end() || !list->is_array()) return;
  for (Json& v : *list)
    if (v.is_object()) f(&v);
}

// Matrices of a skin are the identity where it has none (glTF 2.0, 3.7.3.1), and a channel without a node
// moves nothing (5.5): the parser wants both, if only to hear that there are none.
void add_defaults(Json* root) {
  for_each_in(root, "skins", [](Json* skin) {
    if (!skin->contains("inverseBindMatrices")) (*skin)["inverseBindMatrices"] = -1;
  });
  for_each_in(root, "animations", [](Json* animation) {
    for_each_in(animation, "channels", [](Json* channel) {
      const auto target = channel->find("target");
      if (target != channel->end() && target->is_object() && !target->contains("node"))
        (*target)["node"] = -1;
    });
  });
}

// The accessor of a primitive's indices, where it has no bytes of its own: zeros, or sparse alone. That is
// valid, but refused by the parser.
bool has_no_view(const Json& root, const Json& index) {
  const auto list = root.find("accessors");
  if (list == root.end() || !index.is_number_unsigned() || index.get<size_t>() >= list->size()) return false;
  const Json& accessor = (*list)[index.get<size_t>()];
  return accessor.is_object() && !accessor.contains("bufferView");
}

struct TakenIndices {
  size_t mesh, primitive;
  int accessor;
};

std::vector<TakenIndices> take_viewless_indices(Json* root) {
  std::vector<TakenIndices> taken;
  size_t mesh = 0;
  for_each_in(root, "meshes", [&](Json* m) {
    size_t primitive = 0;
    for_each_in(m, "primitives", [&](Json* p) {
      const auto indices = p->find("indices");
      if (indices != p->end() && has_no_view(*root, *indices)) {
        taken.push_back({mesh, primitive, indices->get<int>()});
        p->erase("indices");
      }
      ++primitive;
    });
    ++mesh;
  });
  return taken;
}

std::string one_line(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  for (size_t at; (at = text.find('\n')) != std::string::npos;) text.replace(at, 1, "; ");
  return excerpt(text, 2 * kExcerpt);
}

}  // namespace

void check_version(const GltfFile& file, const Json& root) {
  const Json& asset = root.is_object() && root.contains("asset") ? root["asset"] : Json();
  if (!asset.is_object() || !asset.contains("version"))
    throw file.error("is no glTF 2.0 file: it has no asset.version");
  for (const char* key : {"minVersion", "version"}) {
    if (!asset.contains(key)) continue;
    const Json& value = asset[key];
    const std::string version = value.is_string() ? value.get<std::string>() : value.dump();
    if (version.starts_with("2.") || (key == std::string_view("version") && version == "2")) {
      if (key == std::string_view("minVersion") && version != "2.0")
        throw file.error("needs a reader of glTF version {}, but only 2.0 is read", excerpt(version));
      continue;
    }
    throw file.error("is glTF version {}, but only version 2 is read", excerpt(version));
  }
}

void parse_model(GltfFile* file, Json root) {
  for (const char* key : {"buffers", "images"}) root.erase(key);
  cut_strings(&root);
  add_defaults(&root);
  const std::vector<TakenIndices> taken = take_viewless_indices(&root);
  const std::string text = root.dump();
  root = Json();
  if (text.size() > 0xffffffffu) throw file->error("its JSON is larger than 4 GiB");
  // The parser empties the model first.
  auto buffers = std::exchange(file->model.buffers, {});
  auto images = std::exchange(file->model.images, {});
  std::string problem, ignored;
  tinygltf::TinyGLTF parser;
  bool read = false;
  try {
    read = parser.LoadASCIIFromString(&file->model, &problem, &ignored, text.data(),
                                      static_cast<unsigned>(text.size()), "");
  } catch (const std::exception& e) {
    problem = e.what();
  }
  if (!read || !problem.empty())
    throw file->error("is no readable glTF file{}", problem.empty() ? "" : ": " + one_line(problem));
  file->model.buffers = std::move(buffers);
  file->model.images = std::move(images);
  for (const TakenIndices& t : taken)
    file->model.meshes.at(t.mesh).primitives.at(t.primitive).indices = t.accessor;
}

}  // namespace vsglbench
