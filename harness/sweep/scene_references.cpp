#include "sweep/scene_references.h"

#include <algorithm>
#include <map>

#include "base/file.h"
#include "base/log.h"
#include "reference/sequence.h"
#include "run/ground_truth.h"
#include "run/overrides.h"
#include "scene/animation.h"
#include "scene/scene_file.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// One case of each size and occlusion: others share its reference.
std::vector<Case> distinct(const Config& config, const std::string& scene) {
  std::map<std::tuple<uint32_t, uint32_t, bool>, Case> cases;
  for (const Case& c : config.cases) {
    const ReferenceParameters p = reference_parameters(config, c);
    if (c.scene == scene) cases.emplace(std::tuple(p.width, p.height, p.occlusion), c);
  }
  std::vector<Case> out;
  for (const auto& [key, c] : cases) out.push_back(c);
  return out;
}

size_t make_still(const Scene& scene, const Config& config, const std::vector<Case>& cases) {
  WallTime wall;
  GroundTruth truth(scene, config, &wall);
  for (const Case& c : cases) truth.references.get(c);
  return cases.size();
}

// As `run` asks for them: of the scene posed in its frames.
size_t make_moving(Scene* scene, const Config& config, const std::vector<Case>& cases) {
  const uint32_t all = frame_count(*scene), wanted = config.motion->frames;
  const uint32_t frames = wanted > 0 ? std::min(wanted, all) : all;
  for (const Case& c : cases) {
    set_frame(scene, 0);
    Tracer tracer(*scene);
    ReferenceSequence sequence(*scene, reference_parameters(config, c));
    for (uint32_t frame = 0; frame < frames; ++frame) {
      tracer.update(set_frame(scene, frame));
      sequence.present([&]() -> const Tracer& { return tracer; });
    }
  }
  return cases.size() * frames;
}

}  // namespace

MadeReferences make_references(const fs::path& sweep, size_t index) {
  const SweepPlan plan = read_plan(sweep);
  const std::vector<std::string> scenes = plan.scenes();
  if (index >= scenes.size())
    throw fail(ErrorKind::usage, "{}: has scenes 0 to {}, and no {}", sweep.string(), scenes.size() - 1,
               index);
  if (fs::exists(plan.folder)) fs::current_path(plan.folder);
  check_unchanged(plan);
  const RunOptions& run = plan.run;
  const Config config = load_config(run.config, parse_overrides(run.set), run.scale, run.scenes);
  MadeReferences made{scenes[index], 0, ""};
  if (config.measure != Measure::frame) return made;
  try {
    const std::vector<Case> cases = distinct(config, made.scene);
    Scene scene = load_scene(made.scene, {data_root() / "scenes", assets_directory(run.assets)});
    for (const std::string& warning : scene.warnings) log_warning("{}: {}", made.scene, warning);
    made.count += make_still(scene, config, cases);
    if (config.motion && frame_count(scene) > 1) made.count += make_moving(&scene, config, cases);
  } catch (const Error& e) {
    made.impossible = e.what();
  }
  return made;
}

}  // namespace vsglbench
