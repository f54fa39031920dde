#include "stability/trial.h"

#include <algorithm>
#include <cmath>

#include "conformance/run.h"
#include "method/registry.h"
#include "stability/light_check.h"
#include "stability/shading_check.h"

namespace vsglbench {
namespace {

constexpr uint32_t kShifts = 8;  // of the lattice, for the lights' mean power

// The shading of VSGLs: the diffuse model, and what the row's parameters or the method's defaults say.
Shading shading_of(const StabilityRow& row, const MethodInfo& method, const std::string& diffuse) {
  Shading shading;
  const Json defaults = method.case_defaults.is_null() ? Json::object() : method.case_defaults;
  for (const ShadingAxis& axis : shading_axes()) {
    const Json own = row.parameters.value(axis.key, defaults.value(axis.key, Json()));
    const Json chosen = axis.key == "diffuse" ? Json(diffuse) : own;
    if (chosen.is_string() && std::ranges::count(axis.choices, chosen.get<std::string>()) > 0)
      shading[axis.key] = chosen;
  }
  return shading;
}

// Nothing for the model that shaders/shading_exact.h lacks.
exact::VsglShading exact_shading(const Shading& shading) {
  exact::VsglShading out;
  if (const auto model = shading.find("shading"); model != shading.end() && model->second == "vsgl14")
    out.model = exact::VsglModel::vsgl14;
  const auto& names = exact::diffuse_model_names();
  if (const auto diffuse = shading.find("diffuse"); diffuse != shading.end())
    out.diffuse = static_cast<exact::DiffuseModel>(std::ranges::find(names, diffuse->second) - names.begin());
  return out;
}

const ParameterInfo* parameter_named(const MethodInfo& method, const std::string& name) {
  const auto it = std::ranges::find(method.parameters, name, &ParameterInfo::name);
  return it == method.parameters.end() ? nullptr : &*it;
}

double mean_of(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}

// The mean of the lights' powers over lattice shifts, against the texels'.
void check_powers(const MethodInfo& method, const std::vector<double>& powers, double texels,
                  Judgement* verdict) {
  if (!(texels > 0)) return;
  const double mean = mean_of(powers);
  double square = 0;
  for (const double p : powers) square += (p - mean) * (p - mean);
  const auto n = static_cast<double>(powers.size());
  const double error = n > 1 ? std::sqrt(square / (n - 1) / n) : 0;
  check_energy(method, mean / texels, error / texels, verdict);
}

oracle::Half downloaded(const DeferredTargets& targets, const gpu::Emitter& emitter) {
  oracle::Half half{.emitter = emitter};
  std::vector<std::vector<glm::vec4>> maps;
  for (const DeviceImage& map : targets.maps) maps.push_back(download_map(map));
  for (size_t i = 0; i < maps[0].size(); ++i) {
    half.texels.push_back({.position = glm::vec3(maps[0][i]),
                           .normal = glm::vec3(maps[1][i]),
                           .geometric_normal = glm::vec3(maps[2][i]),
                           .diffuse = glm::vec3(maps[3][i]),
                           .f0 = glm::vec3(maps[4][i]),
                           .ndf = maps[1][i].w,
                           .surface = maps[0][i].w > 0});
  }
  return half;
}

void check_targets(const oracle::Half& half, const char* name, Judgement* verdict) {
  for (size_t i = 0; i < half.texels.size(); ++i) {
    const oracle::Texel& t = half.texels[i];
    const glm::vec3 sum = t.position + t.normal + t.geometric_normal + t.diffuse + t.f0;
    if (!t.surface || std::isfinite(sum.x + sum.y + sum.z + t.ndf)) continue;
    verdict->bad(
        fmt::format("{}: texel ({},{}) is not finite", name, i % half.emitter.width, i / half.emitter.width));
  }
}

StabilityCell left_out(const HardCase& c, const StabilityRow& row, const std::string& why) {
  return {c.name, row.name, "-", Stability::left_out, 0, "", why};
}

}  // namespace

std::vector<std::string> Trial::models_of(const HardCase& hard_case, const StabilityRow& row) const {
  const MethodInfo& method = find_method(row.method);
  bool vpls = !method.makes_vpls.is_null();
  if (vpls) {
    for (const auto& [key, value] : method.makes_vpls.items()) vpls = vpls && row.parameters.at(key) == value;
  }
  if (vpls) return {"-"};
  return hard_case.models ? diffuse_ : std::vector{diffuse_.front()};
}

std::vector<StabilityCell> Trial::run(const HardCase& hard_case, const StabilityRow& row) {
  const MethodInfo* method = nullptr;
  try {
    method = &load_method(row.method, kernels_.device().info());
  } catch (const Error& e) {  // the device lacks what it needs
    return {left_out(hard_case, row, e.what())};
  }
  try {
    if (hard_case.half) return run_half(hard_case, row, *method);
    std::vector<StabilityCell> cells;
    for (const std::string& diffuse : models_of(hard_case, row)) {
      cells.push_back(run_scene(hard_case, row, *method, diffuse));
    }
    return cells;
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::device_lost) throw;
    Judgement verdict;
    verdict.bad(fmt::format("threw \"{}\"", e.what()));
    return {verdict.cell(hard_case.name, row.name, "-")};
  } catch (const std::exception& e) {
    Judgement verdict;
    verdict.bad(fmt::format("threw \"{}\"", e.what()));
    return {verdict.cell(hard_case.name, row.name, "-")};
  }
}

std::vector<StabilityCell> Trial::run_half(const HardCase& hard_case, const StabilityRow& row,
                                           const MethodInfo& method) {
  const HalfCase c = hard_case.half();
  Judgement verdict;
  Json given = row.parameters;
  if (c.footprint_size) {
    const ParameterInfo* k = parameter_named(method, "K");
    if (!k) return {left_out(hard_case, row, "no parameter K")};
    const double used = std::clamp(*c.footprint_size, k->minimum, k->maximum);
    if (used != *c.footprint_size) verdict.note(fmt::format("K = {:g}, the end of its range", used));
    given["K"] = used;
  }
  if (!method.takes_light_count && hard_case.name.starts_with("n-")) {
    return {left_out(hard_case, row, "takes no N")};
  }
  MethodRun run(kernels_, method, given);
  const bool powerless = c.no_surface || c.no_flux || (c.no_pdf && run.method().uses_importance());
  const DeviceHalf texels(kernels_.device(), c.half);
  const auto lights = [&](uint32_t seed) {
    return run.frame(texels, Half::rsm, c.lights, lattice_shift(seed)).lights;
  };
  const LightRecords first = lights(0);
  const Json parameters = resolve_parameters(method, given);
  check_lights({c.half, method, parameters, lattice_shift(0), powerless}, first, &verdict);
  // Power in the mean over shifts: one alone says little of a sampled half.
  std::vector<double> powers = {sum_power(first).carried};
  while (powers.size() < kShifts) powers.push_back(sum_power(lights(powers.size())).carried);
  if (!powerless) check_powers(method, powers, texel_power(c.half, first.kind), &verdict);

  const oracle::Half receivers = c.receivers(c.half, light_spots(first));
  std::vector<StabilityCell> cells;
  for (const std::string& diffuse : models_of(hard_case, row)) {
    Judgement all = verdict;
    const Shading shading = shading_of(row, method, diffuse);
    const auto shaded = shading_.shade(receivers, texels, first, shading);
    check_shading(receivers, shaded.radiance, first, shaded.filtered, exact_shading(shading), powerless,
                  &all);
    cells.push_back(all.cell(hard_case.name, row.name, diffuse));
  }
  return cells;
}

StabilityCell Trial::run_scene(const HardCase& hard_case, const StabilityRow& row, const MethodInfo& method,
                               const std::string& diffuse) {
  if (!method.takes_light_count && hard_case.name.starts_with("n-")) {
    return left_out(hard_case, row, "takes no N");
  }
  Judgement verdict;
  try {
    const SceneCase c = hard_case.scene();
    Stage stage(kernels_.device(), kernels_, c.scene);
    FrameParameters p{.width = kSceneWidth,
                      .height = kSceneHeight,
                      .rsm = kSceneRsm,
                      .lights = c.lights,
                      .importance_lights = 32,
                      .visibility = Visibility::none};
    p.shading = shading_of(row, method, diffuse);
    const Json parameters = resolve_parameters(method, row.parameters);
    Frame frame(stage, method, parameters, p, nullptr);
    if (!hard_case.refusal.empty()) verdict.bad("accepted; it must be refused");
    frame.render(0);

    oracle::Half rsm = downloaded(frame.rsm(), frame.light());
    const oracle::Half gbuffer = downloaded(frame.gbuffer(), frame.camera());
    check_targets(gbuffer, "G-buffer", &verdict);
    check_targets(rsm, "RSM", &verdict);
    if (!verdict.is_bad()) {
      rsm.pdf = frame.results().importance();
      rsm.pdf.resize(rsm.texels.size(), 1);
      const LightRecords lights = frame.results().lights();
      check_lights({rsm, method, parameters, lattice_shift(0)}, lights, &verdict);
      check_shading(gbuffer, frame.results().indirect().pixels, lights, frame.results().filtered_lights(),
                    exact_shading(p.shading), false, &verdict);
    }
  } catch (const Error& e) {
    const std::string what = e.what();
    if (hard_case.refusal.empty() || what.find(hard_case.refusal) == std::string::npos) throw;
    verdict.note("refused: " + what);
  }
  return verdict.cell(hard_case.name, row.name, diffuse);
}

}  // namespace vsglbench
