// The checks of the conformance kit (conformance.h says what each promises).
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "conformance/inspection.h"
#include "frame/frame.h"

namespace vsglbench {
namespace {

constexpr uint32_t kSeed = 3, kOtherSeed = 4;
constexpr uint32_t kShifts = 16;

// Inputs without those that differ only in a PDF that the method does not read.
std::vector<ConformanceInput> readable(Inspection& inspection, std::vector<ConformanceInput> inputs) {
  if (inspection.uses_importance()) return inputs;
  std::vector<ConformanceInput> kept;
  std::set<std::string> names;
  for (ConformanceInput& input : inputs) {
    input.pdf = ConformanceInput::Pdf::made;
    if (names.insert(input.name()).second) kept.push_back(input);
  }
  return kept;
}

// `body` on each input, which it gets in device memory too.
void each(Inspection& inspection, const std::vector<ConformanceInput>& inputs,
          const std::function<void(const ConformanceInput&, const DeviceHalf&)>& body,
          const std::string& suffix = "") {
  for (const ConformanceInput& input : readable(inspection, inputs)) {
    const bool large = input.texels() > 65536;
    if (large && !inspection.wants_large()) continue;
    inspection.on(
        input.name() + suffix, [&] { body(input, DeviceHalf(inspection.device(), input.make())); }, large);
  }
}

void check_repeatable(Inspection& inspection) {
  const auto compare = [&](const char* what, const HalfOutput& a, const HalfOutput& b) {
    if (const auto difference = first_difference(a.lights, b.lights); !difference.empty())
      inspection.found(fmt::format("{}: {}; expected the same bits", what, difference));
  };
  const auto body = [&](const ConformanceInput& in, const DeviceHalf& texels) {
    const auto frame = [&](MethodRun& run, uint32_t seed) {
      return run.frame(texels, in.half, in.count, lattice_shift(seed));
    };
    const auto run = inspection.make();
    const HalfOutput first = frame(*run, kSeed), other = frame(*run, kOtherSeed);
    compare("a later frame of the same seed", first, frame(*run, kSeed));
    compare("a new Method of the same seed", first, frame(*inspection.make(), kSeed));
    const auto dirty = inspection.make();
    dirty->guard_scratch_like(*run);
    compare("scratch memory that another case left full", first, frame(*dirty, kSeed));
    if (inspection.info().takes_light_count && in.count < in.texels() && first.lights == other.lights)
      inspection.found(
          fmt::format("seeds {} and {} give the same lights; expected others", kSeed, kOtherSeed));
  };
  for (const Half half : inspection.halves()) each(inspection, {{half, 7, 5, 35}, {half, 61, 35, 100}}, body);
}

// The choices of every parameter, one by one, but for the default.
std::vector<Json> choice_variants(const MethodInfo& info) {
  std::vector<Json> variants;
  for (const ParameterInfo& p : info.parameters) {
    for (const auto& choice : p.choices) {
      if (p.default_value != choice) variants.push_back({{p.name, choice}});
    }
  }
  return variants;
}

// Every parameter at the ends of its range, one by one, but for the default.
std::vector<Json> range_variants(const MethodInfo& info) {
  std::vector<Json> variants;
  for (const ParameterInfo& p : info.parameters) {
    if (!p.default_value.is_number()) continue;
    for (const double end : {p.minimum, p.maximum}) {
      const Json value = p.default_value.is_number_float() ? Json(end) : Json(static_cast<int64_t>(end));
      if (p.default_value != value) variants.push_back({{p.name, value}});
    }
  }
  return variants;
}

// ", K = 2"; empty for no parameter.
std::string suffix_of(const Json& variant) {
  if (variant.empty()) return "";
  const auto value = variant.items().begin();
  return fmt::format(", {} = {}", value.key(), value.value().dump());
}

void check_lights(Inspection& inspection) {
  Json parameters = Json::object();
  const auto body = [&](const ConformanceInput& in, const DeviceHalf& texels) {
    const auto run = inspection.make(parameters);
    const HalfOutput out = run->frame(texels, in.half, in.count, lattice_shift(kSeed));
    const auto fault = first_fault(out.lights, in.powerless(out.lights.kind));
    if (!fault.empty()) inspection.found(fault);
  };
  for (const Half half : inspection.halves()) each(inspection, all_inputs(half), body);
  if (!inspection.uses_importance()) each(inspection, {{Half::rsm, 1920, 1088, 2048}}, body);
  for (const auto& variants : {choice_variants(inspection.info()), range_variants(inspection.info())}) {
    for (const Json& variant : variants) {
      parameters = variant;
      for (const Half half : inspection.halves())
        each(inspection, few_inputs(half), body, suffix_of(variant));
    }
  }
}

// What the lights of a half carry: mean over shifts, and the standard error of the mean of `carried`.
struct MeanPower {
  LightPower mean;
  double standard_error = 0;
};
MeanPower mean_power(MethodRun& run, const DeviceHalf& texels, Half half, uint32_t wanted) {
  MeanPower m;
  double squares = 0;
  for (uint32_t seed = 1; seed <= kShifts; ++seed) {
    const LightPower sum = sum_power(run.frame(texels, half, wanted, lattice_shift(seed)).lights);
    m.mean.stated += sum.stated / kShifts;
    m.mean.carried += sum.carried / kShifts;
    squares += sum.carried * sum.carried / kShifts;
  }
  m.standard_error = std::sqrt(std::max(squares - m.mean.carried * m.mean.carried, 0.0) / (kShifts - 1));
  return m;
}

struct FluxInput {
  Half half;
  glm::uvec2 size;
  uint32_t wanted;
  bool uneven = false;
};

// On an uneven PDF the mean over 16 shifts is itself uncertain: three standard errors are allowed for.
void check_flux_on(Inspection& inspection, const Json& parameters, const FluxInput& in) {
  const auto name =
      fmt::format("smooth half {} {}×{}, N = {}, {} shifts{}{}", half_name(in.half), in.size.x, in.size.y,
                  in.wanted, kShifts, in.uneven ? ", an uneven PDF" : "", suffix_of(parameters));
  inspection.on(name, [&] {
    oracle::Half half = in.uneven ? uneven_half(in.size.x, in.size.y) : smooth_half(in.size.x, in.size.y);
    if (in.half == Half::gbuffer) look_from_eye(half);
    const auto run = inspection.make(parameters);
    const double expected = texel_power(half, run->method().kind());
    const auto [mean, error] = mean_power(*run, DeviceHalf(inspection.device(), half), in.half, in.wanted);
    const MethodInfo& info = inspection.info();
    const double stated = in.uneven ? info.worst_flux_bound() : info.flux_bound;
    const double bound = in.uneven ? stated + 3 * error / expected : stated;
    inspection.measured(fmt::format("Σ light power is {:.6g} × the texels'{}", mean.carried / expected,
                                    in.uneven ? fmt::format(" ± {:.1g}", error / expected) : ""));
    for (const double sum : {mean.stated, mean.carried}) {
      if (std::abs(sum / expected - 1) <= bound) continue;
      return inspection.found(
          fmt::format("Σ light power is {:.6g} W, {:.6g} × the texels' {:.6g} W; "
                      "expected {:g} … {:g} × ({}flux_bound = {:g})",
                      sum, sum / expected, expected, std::max(1 - bound, 0.0), 1 + bound,
                      in.uneven && info.uneven_flux_bound > info.flux_bound ? "uneven_" : "", stated));
    }
  });
}

void check_flux(Inspection& inspection) {
  std::vector<Json> variants = choice_variants(inspection.info());
  variants.insert(variants.begin(), Json::object());
  for (const Json& parameters : variants) {
    for (const Half half : inspection.halves()) {
      check_flux_on(inspection, parameters, {half, {96, 64}, 256});
      check_flux_on(inspection, parameters, {half, {61, 35}, 100});
      if (inspection.uses_importance()) check_flux_on(inspection, parameters, {half, {96, 64}, 256, true});
    }
  }
  // The ends of a range may cost much, such as a hundred Lloyd steps: the smaller half only.
  for (const Json& parameters : range_variants(inspection.info())) {
    for (const Half half : inspection.halves()) check_flux_on(inspection, parameters, {half, {61, 35}, 100});
  }
}

std::vector<std::string> names_of(const std::vector<PassTime>& passes) {
  std::vector<std::string> names;
  for (const PassTime& time : passes) names.push_back(time.pass.name());
  return names;
}

void check_passes(Inspection& inspection) {
  const auto body = [&](const ConformanceInput& in, const DeviceHalf& texels) {
    const auto run = inspection.make();
    const auto frame = [&] { return run->frame(texels, in.half, in.count, lattice_shift(kSeed)); };
    const HalfOutput first = frame(), second = frame();
    if (first.passes.empty()) inspection.found("no pass was recorded; expected at least one");
    for (const auto& [pass, ms] : second.passes) {
      if (pass.stage != PassStage::generate || pass.half != in.half || pass.step.empty()) {
        inspection.found(fmt::format("a pass is named '{}'; expected {}.<step>", pass,
                                     PassId{PassStage::generate, in.half, ""}));
      }
      if (!std::isfinite(ms) || !(ms > 0))
        inspection.found(fmt::format("pass {} took {} ms; expected a time > 0", pass, ms));
    }
    if (names_of(first.passes) != names_of(second.passes))
      inspection.found(fmt::format("the first frame has the passes {}, the second {}; expected the same",
                                   fmt::join(names_of(first.passes), ", "),
                                   fmt::join(names_of(second.passes), ", ")));
    if (first.dispatches_outside > 0)
      inspection.found(fmt::format("{} dispatches are outside any pass; expected none, or they are not timed",
                                   first.dispatches_outside));
  };
  for (const Half half : inspection.halves()) each(inspection, {{half, 256, 144, 256}}, body);
}

void check_bounds(Inspection& inspection) {
  bool is_wide = false;
  const auto body = [&](const ConformanceInput& in, const DeviceHalf& texels) {
    const auto run = inspection.make(), guarded = inspection.make();
    run->frame(texels, in.half, in.count, lattice_shift(kSeed));
    if (is_wide) guarded->widen_guards(*run);
    guarded->guard_scratch_like(*run);
    const auto overrun = guarded->frame(texels, in.half, in.count, lattice_shift(kSeed)).overrun;
    if (!overrun.empty()) inspection.found(overrun + "; expected what lies behind it unchanged");
  };
  for (const Half half : inspection.halves()) {
    is_wide = false;
    each(inspection, few_inputs(half), body);
    each(inspection, {{half, 1, 64, 64}}, body);
    is_wide = true;
    each(inspection, {{half, 33, 17, 561}}, body);
  }
}

void check_memory(Inspection& inspection) {
  Device& device = inspection.device();
  const auto input = [](Half half) { return ConformanceInput{half, 61, 35, 100}; };
  inspection.on(fmt::format("four frames, {}", input(Half::rsm).name()), [&] {
    const uint64_t before = device.allocated_bytes();
    {
      KernelLibrary kernels(device);
      MethodRun run(kernels, inspection.info(), Json::object());
      const DeviceHalf rsm(device, input(Half::rsm).make()), gbuffer(device, input(Half::gbuffer).make());
      const auto frame = [&](uint32_t seed) {
        if (run.method().uses_importance()) run.frame(gbuffer, Half::gbuffer, 100, lattice_shift(seed));
        run.frame(rsm, Half::rsm, 100, lattice_shift(seed));
        return device.allocated_bytes();
      };
      const uint64_t first = frame(0);
      uint64_t last = first;
      for (uint32_t seed = 1; seed < 4; ++seed) last = frame(seed);
      if (last != first)
        inspection.found(
            fmt::format("{} bytes more device memory after four frames than after one; expected "
                        "no more",
                        static_cast<int64_t>(last - first)));
    }
    const auto left = static_cast<int64_t>(device.allocated_bytes() - before);
    if (left != 0)
      inspection.found(
          fmt::format("{} bytes of device memory are still held after the method's end; expected 0", left));
  });
}

// "VUID-...: what is wrong", in one line of at most 400 bytes, without the list of object handles between.
std::string shorten(std::string message) {
  std::ranges::replace(message, '\n', ' ');
  const size_t open = message.find("[ "), close = message.find(" ]"), text = message.rfind(" | ");
  if (open != std::string::npos && close != std::string::npos && open < close && text != std::string::npos)
    message = message.substr(open + 2, close - open - 2) + ": " + message.substr(text + 3);
  return message.size() <= 400 ? message : message.substr(0, 400) + "...";
}

void check_validation(Inspection& inspection) {
  const auto& messages = inspection.device().validation_messages();
  const auto body = [&](const ConformanceInput& in, const DeviceHalf& texels) {
    const size_t before = messages.size();
    const auto run = inspection.make();
    run->frame(texels, in.half, in.count, lattice_shift(0));
    run->frame(texels, in.half, in.count, lattice_shift(kSeed));
    if (messages.size() > before)
      inspection.found(fmt::format("{} messages of the validation layers, the first: {}; expected silence",
                                   messages.size() - before, shorten(messages[before])));
  };
  for (const Half half : inspection.halves()) each(inspection, few_inputs(half), body);
}

}  // namespace

const std::vector<ConformanceCheck>& all_conformance_checks() {
  static const std::vector<ConformanceCheck> checks = {
      {"repeatable", check_repeatable},
      {"lights", check_lights},
      {"flux", check_flux},
      {"passes", check_passes},
      {"bounds", check_bounds},
      {"memory", check_memory},
      {"validation", check_validation, true},
      {"image", check_image},
  };
  return checks;
}

}  // namespace vsglbench
