#include "gpu/pass_id.h"

#include <array>

namespace vsglbench {
namespace {

// In the order of PassStage; the first and the last have no name of their own.
constexpr std::array kStages = {"", "importance", "generate", "visibility", "shade", "direct"};

std::optional<Half> half_named(const std::string& name) {
  if (name == half_name(Half::gbuffer)) return Half::gbuffer;
  if (name == half_name(Half::rsm)) return Half::rsm;
  return std::nullopt;
}

// Up to the next dot, which goes too.
std::string take_part(std::string* rest) {
  const size_t dot = rest->find('.');
  const std::string part = rest->substr(0, dot);
  *rest = dot == std::string::npos ? "" : rest->substr(dot + 1);
  return part;
}

PassId with_stage(PassStage stage, std::string rest) {
  if (stage != PassStage::importance && stage != PassStage::generate) return {stage, std::nullopt, rest};
  const std::optional<Half> half = half_named(take_part(&rest));
  return {stage, half, rest};
}

}  // namespace

std::string PassId::name() const {
  std::string name = stage == PassStage::other ? "" : kStages.at(static_cast<size_t>(stage));
  const auto append = [&](const std::string& part) { name += (name.empty() ? "" : ".") + part; };
  if (half) append(half_name(*half));
  if (!step.empty()) append(step);
  return name;
}

PassId parse_pass_name(const std::string& name) {
  if (const auto half = half_named(name)) return {PassStage::draw, half, ""};
  std::string rest = name;
  const std::string first = take_part(&rest);
  for (size_t i = 1; i < kStages.size(); ++i) {
    const PassId pass = with_stage(static_cast<PassStage>(i), rest);
    if (first == kStages[i] && pass.name() == name) return pass;
  }
  return {.step = name};
}

}  // namespace vsglbench
