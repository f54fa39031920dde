#include <fmt/format.h>

#include <algorithm>

#include "base/file.h"
#include "base/log.h"
#include "base/printable.h"
#include "cli/scene_commands.h"
#include "report/image_labels.h"
#include "scene/gltf.h"
#include "scene/model_scene.h"
#include "scene/preview.h"
#include "scene/scene_file.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct NewSceneOptions {
  fs::path model, folder;
  bool force = false;
};

// Numbers stand beside each other, so that a vector is one line.
std::string compact(const Json& json, size_t depth = 0) {
  const std::string pad(2 * depth + 2, ' '), end(2 * depth, ' ');
  const bool flat =
      json.is_array() && std::all_of(json.begin(), json.end(), [](const Json& v) { return v.is_number(); });
  if (!json.is_structured() || json.empty() || flat) {
    if (!flat || json.empty()) return json.dump();
    std::string out = "[";
    for (const Json& v : json) out += (out.size() > 1 ? ", " : "") + v.dump();
    return out + "]";
  }
  std::string out = json.is_object() ? "{\n" : "[\n";
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    out += (first ? "" : ",\n") + pad + (json.is_object() ? Json(key).dump() + ": " : "") +
           compact(value, depth + 1);
    first = false;
  }
  return out + "\n" + end + (json.is_object() ? "}" : "]");
}

void make(const NewSceneOptions& options) {
  if (!is_model(options.model))
    throw fail(ErrorKind::usage, "{}: is no glTF file; give a .gltf or .glb", options.model.string());
  const fs::path file = options.folder / "scene.json";
  std::error_code ec;
  if (fs::exists(file, ec) && !options.force)
    throw fail(ErrorKind::output, "{}: is there already; give another --dir, or --force to replace it",
               file.string());
  Scene geometry;
  load_gltf(options.model, 1, &geometry);
  const fs::path from = fs::weakly_canonical(fs::absolute(options.folder));
  const fs::path relative = fs::weakly_canonical(fs::absolute(options.model)).lexically_relative(from);
  const ModelScene made = model_scene(options.model, geometry, relative.string());
  write_text(file, compact(made.json) + "\n");
  const Scene scene = load_scene(file.string(), {});
  write_png(options.folder / "preview.png", preview_picture(TriangleTree(scene)),
            image_labels("preview of camera and light", scene.name, scene.hash));
  for (const std::string& warning : scene.warnings) log_warning("{}", printable(warning));
  for (const std::string& note : made.notes) fmt::print("{}\n", printable(note));
  const std::string folder = printable(options.folder.string());
  fmt::print("{0}/scene.json\n{0}/preview.png\nnext: vsglbench view {0}; vsglbench run --scene {0}\n",
             folder);
}

}  // namespace

void add_new_scene_command(CLI::App& app) {
  auto options = std::make_shared<NewSceneOptions>();
  CLI::App* command = app.add_subcommand("new-scene", "the scene.json of a glTF file, for editing by hand");
  command->footer(
      "Writes DIR/scene.json with the views that `run --scene MODEL` would take, bounds, materials and unit, "
      "and\n"
      "DIR/preview.png with camera and light. What its keys mean: scenes/README.md.\n"
      "Example: vsglbench new-scene model.glb --dir my-scene");
  command->add_option("model", options->model, "a .gltf or .glb")->required();
  command->add_option("--dir", options->folder, "folder of scene.json and preview.png")->required();
  command->add_flag("--force", options->force, "replace a scene.json that is there");
  command->callback([=] { make(*options); });
}

}  // namespace vsglbench
