#include "run/case_keys.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/json_number.h"
#include "run/pdf_source.h"

namespace vsglbench {
namespace {

constexpr uint32_t kMaxCount = 1 << 30, kMaxRsm = 16384, kMaxProgressive = 1024;
constexpr double kMaxFactor = 1e30;

// --- kinds of keys ---

// What all kinds have.
struct Row {
  std::string name;
  unsigned scope;
  InId in_id;
  std::string help;
  std::string name_in_id = name;
};

CaseKey key_of(const Row& row) {
  CaseKey key;
  key.name = row.name;
  key.scope = row.scope;
  key.in_id = row.in_id;
  key.help = row.help;
  key.name_in_id = row.name_in_id;
  return key;
}

CaseKey count(const Row& row, uint32_t FrameParameters::*field, uint32_t minimum, uint32_t maximum) {
  CaseKey key = key_of(row);
  key.default_value = FrameParameters().*field;
  key.schema = {{"type", "integer"}, {"minimum", minimum}, {"maximum", maximum}};
  key.values = fmt::format("{} … {}", minimum, maximum);
  key.read = [=](const Json& value, FrameParameters* frame) {
    if (!is_whole(value) || value.get<double>() < minimum || value.get<double>() > maximum)
      throw fail(ErrorKind::config, "{} must be an integer within {} … {}", value.dump(), minimum, maximum);
    frame->*field = value.get<uint32_t>();
  };
  key.write = [=](const FrameParameters& frame) { return Json(frame.*field); };
  return key;
}

CaseKey one_of(const Row& row, uint32_t FrameParameters::*field, const std::vector<uint32_t>& choices) {
  CaseKey key = key_of(row);
  key.default_value = FrameParameters().*field;
  key.schema = {{"enum", choices}};
  key.values = fmt::format("{}", fmt::join(choices, ", "));
  key.read = [=, values = key.values](const Json& value, FrameParameters* frame) {
    const bool known = value.is_number() &&
                       std::ranges::any_of(choices, [&](uint32_t c) { return value.get<double>() == c; });
    if (!known) throw fail(ErrorKind::config, "{} must be one of {}", value.dump(), values);
    frame->*field = static_cast<uint32_t>(value.get<double>());
  };
  key.write = [=](const FrameParameters& frame) { return Json(frame.*field); };
  return key;
}

CaseKey number(const Row& row, float FrameParameters::*field, double maximum) {
  CaseKey key = key_of(row);
  const float initial = FrameParameters().*field;
  key.default_value = initial == std::floor(initial) ? Json(static_cast<int64_t>(initial)) : Json(initial);
  key.schema = {{"type", "number"}, {"minimum", 0}, {"maximum", maximum}};
  key.values = "0 or more";
  key.read = [=](const Json& value, FrameParameters* frame) {
    if (!value.is_number() || !(value.get<double>() >= 0) || value.get<double>() > maximum)
      throw fail(ErrorKind::config, "{} must be a number within 0 … {}", value.dump(), maximum);
    frame->*field = std::abs(value.get<float>());  // -0 is 0
  };
  key.write = [=](const FrameParameters& frame) { return Json(frame.*field); };
  return key;
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

template <class Enum>
CaseKey choice(const Row& row, Enum FrameParameters::*field, Enum (*parse)(const std::string&),
               const std::vector<std::string>& names) {
  CaseKey key = key_of(row);
  key.schema = {{"enum", names}};
  key.values = joined(names);
  key.read = [=](const Json& value, FrameParameters* frame) {
    frame->*field = parse(value.is_string() ? value.get<std::string>() : value.dump());
  };
  key.write = [=](const FrameParameters& frame) { return Json(names.at(static_cast<size_t>(frame.*field))); };
  key.default_value = key.write(FrameParameters());
  return key;
}

CaseKey text(const Row& row, std::string FrameParameters::*field, const std::string& values) {
  CaseKey key = key_of(row);
  key.default_value = FrameParameters().*field;
  key.schema = {{"type", "string"}, {"minLength", 1}, {"maxLength", 4096}};
  key.values = values;
  key.read = [=](const Json& value, FrameParameters* frame) {
    if (!value.is_string() || value.get<std::string>().empty())
      throw fail(ErrorKind::config, "{} must be a string that is not empty", value.dump());
    frame->*field = value.get<std::string>();
  };
  key.write = [=](const FrameParameters& frame) { return Json(frame.*field); };
  return key;
}

CaseKey pdf() {
  CaseKey key = text(
      {"pdf", kGeneration | kMethodTakesPdf, InId::where_it_differs,
       "what the RSM's lights are drawn by, the same for all methods: the lights of one method; own, each "
       "method's; flux, nobody's: the power that a texel reflects; or an image's luminance"},
      &FrameParameters::pdf, "own, flux, a method, or the path of an image (.exr, .png)");
  key.look_up = [](const FrameParameters& frame) { pdf_source(frame.pdf); };
  return key;
}

CaseKey effects(const Row& row, EffectSet FrameParameters::*field) {
  CaseKey key = key_of(row);
  key.default_value = "";
  std::vector<std::string> names = effect_names();
  std::erase_if(names, [](const std::string& name) { return effect_named(name) >= Effect::moving_objects; });
  const std::string one = fmt::format("({})", fmt::join(names, "|"));
  key.schema = {{"type", "string"}, {"pattern", fmt::format("^(all|{0}(,{0})*)?$", one)}};
  key.values = "all, or names parted by commas (vsglbench list effects; not moving ones)";
  key.read = [=](const Json& value, FrameParameters* frame) {
    if (!value.is_string()) throw fail(ErrorKind::config, "{} must be a string", value.dump());
    frame->*field = parse_effects(value.get<std::string>());
  };
  key.write = [=](const FrameParameters& frame) { return Json(to_text(frame.*field)); };
  return key;
}

// Nothing for text that is no number.
std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// A choice that is a number may be written as one: 0, 0.0, -0.0 and "0" are the same.
CaseKey shading(const ShadingAxis& axis) {
  CaseKey key = key_of({axis.key, kFrame | kVsgl, InId::where_it_differs, axis.description});
  key.values = joined(axis.choices);
  key.schema = {{"enum", axis.choices}};
  for (const auto& text : axis.choices) {
    if (const auto value = number_in(text)) {
      key.schema["enum"].push_back(*value == std::floor(*value) ? Json(int64_t(*value)) : Json(*value));
    }
  }
  key.read = [name = axis.key](const Json& value, FrameParameters* frame) {
    const std::string text = value.is_string()   ? value.get<std::string>()
                             : value.is_number() ? fmt::format("{}", value.get<double>() + 0.0)
                                                 : value.dump();
    check_shading_choice(name, text);
    frame->shading[name] = text;
  };
  key.write = [name = axis.key](const FrameParameters& frame) { return Json(chosen(frame.shading, name)); };
  key.default_value = key.write(FrameParameters());
  return key;
}

// --- the table ---

std::vector<CaseKey> table() {
  using P = FrameParameters;
  constexpr InId kAlways = InId::always, kIfDifferent = InId::where_it_differs;
  std::vector<CaseKey> keys = {
      count({"N", kMethodTakesCount, kAlways,
             "lights; 0, or more than the RSM has texels, fails the case when it is run"},
            &P::lights, 0, kMaxCount),
      count({"rsm", kEveryCase, kAlways, "texels along an edge of the square reflective shadow map"}, &P::rsm,
            1, kMaxRsm),
      count({"importance_lights", kMethodTakesPdf, kIfDifferent,
             "lights on the G-buffer that make the importance PDF; at most its pixels are used"},
            &P::importance_lights, 1, kMaxCount),
      choice({"visibility", kFrame, kAlways,
              "how a pixel sees a light: by rays (exact), by imperfect shadow maps (ism, aism, tism), or "
              "always (none)",
              "vis"},
             &P::visibility, parse_visibility, visibility_names()),
      choice(
          {"importance", kFrame | kMethodTakesPdf, kIfDifferent,
           "whose lights on the G-buffer make the PDF on the RSM: the method's own; vsgl, of mfis; vpl, of "
           "vpl, as the first BRSM had it [VSGL14 Fig. 4a]; flux, nobody's: the power that a texel "
           "reflects"},
          &P::importance, parse_importance, importance_names()),
      choice({"importance_norm", kFrame | kMethodTakesPdf, kIfDifferent,
              "which mean over the view the PDF on the RSM is proportional to, of what a texel's light adds "
              "to a "
              "pixel: the arithmetic one [VSGL14 §3] (l1) or the quadratic one (l2)"},
             &P::importance_norm, parse_importance_norm, importance_norm_names()),
      pdf(),
      count({"progressive", kFrame, kIfDifferent,
             "images of so many light sets are averaged, the lights' radius × 2/3 from one to the next "
             "[VSGL14 §5]"},
            &P::progressive, 1, kMaxProgressive),
      one_of({"interleave", kFrame, kIfDifferent,
              "the pixels of every block of so many by so many share the lights out, and a filter that keeps "
              "to one surface joins them; 1: each pixel takes all"},
             &P::interleave, {1, 2, 4, 8}),
      choice({"lattice", kFrame, kIfDifferent,
              "of an animation: whether the points that lights are drawn by stay from frame to frame, or are "
              "shifted anew in each"},
             &P::lattice, parse_lattice, lattice_names()),
      number({"bias_reduction", kFrame | kVsgl, kIfDifferent,
              "α of the consistent bias reduction [VSGL14 §3.3]; 0: none"},
             &P::bias_reduction, kMaxFactor),
  };
  for (const ShadingAxis& axis : shading_axes()) keys.push_back(shading(axis));
  keys.push_back(effects({"force_effects", kEveryCase, kIfDifferent,
                          "effects that are simulated though the scene does not call for them"},
                         &P::force_effects));
  keys.push_back(effects({"skip_effects", kEveryCase, kIfDifferent,
                          "effects that are left out though the scene calls for them: what do they cost and "
                          "bring?"},
                         &P::skip_effects));
  return keys;
}

}  // namespace

const std::vector<CaseKey>& case_keys() {
  static const std::vector<CaseKey> keys = table();
  return keys;
}

const CaseKey* find_case_key(const std::string& name) {
  const auto at = std::ranges::find(case_keys(), name, &CaseKey::name);
  return at == case_keys().end() ? nullptr : &*at;
}

std::vector<std::string> case_key_names() {
  std::vector<std::string> names;
  for (const CaseKey& key : case_keys()) names.push_back(key.name);
  return names;
}

}  // namespace vsglbench
