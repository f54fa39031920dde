#include "stability/cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vsglbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array kStatuses = {Stability::ok, Stability::bias, Stability::bad, Stability::left_out};

}  // namespace

const char* stability_name(Stability status) {
  static constexpr std::array names = {"ok", "bias", "bad", "left out"};
  return names[static_cast<size_t>(status)];
}

void Judgement::error(double relative, const std::string& where, const std::string& explanation) {
  const double e = std::isnan(relative) ? kInfinity : relative;
  if (e <= worst_) return;
  worst_ = e;
  where_ = where;
  explanation_ = explanation;
}

void Judgement::raise(Stability status, const std::string& why) {
  if (status <= status_) return;
  status_ = status;
  why_ = why;
}

void Judgement::bad(const std::string& why) { raise(Stability::bad, why); }
void Judgement::bias(const std::string& why) { raise(Stability::bias, why); }

void Judgement::note(const std::string& text) { note_ = note_.empty() ? text : note_ + "; " + text; }

StabilityCell Judgement::cell(const std::string& hard_case, const std::string& method,
                              const std::string& diffuse) const {
  Judgement all = *this;
  const std::string off = fmt::format("{}{}{}", where_, explanation_.empty() ? "" : ": ", explanation_);
  if (worst_ > kBadError) all.bad(off);
  if (worst_ > kOkError) all.bias(off);
  if (all.why_.empty()) all.why_ = off;
  if (!note_.empty()) all.why_ += (all.why_.empty() ? "" : "; ") + note_;
  if (all.why_.empty()) all.why_ = "no difference";
  return {hard_case, method,  diffuse, all.status_, status_ == Stability::bad ? kInfinity : worst_,
          where_,    all.why_};
}

Json to_json(const StabilityCell& c) {
  return {{"case", c.hard_case},
          {"method", c.method},
          {"diffuse", c.diffuse},
          {"status", stability_name(c.status)},
          {"error", std::isfinite(c.error) ? Json(c.error) : Json("infinite")},
          {"where", c.where},
          {"why", c.why}};
}

StabilityCell cell_from_json(const Json& json) {
  StabilityCell c{json.at("case"), json.at("method"), json.at("diffuse")};
  const auto name = json.at("status").get<std::string>();
  c.status = *std::ranges::find_if(kStatuses, [&](Stability s) { return stability_name(s) == name; });
  c.error = json.at("error").is_number() ? json.at("error").get<double>() : kInfinity;
  c.where = json.at("where");
  c.why = json.at("why");
  return c;
}

}  // namespace vsglbench
