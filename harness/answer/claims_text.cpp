// Tried claims for a terminal, or as Markdown.
#include <algorithm>

#include "answer/claims.h"
#include "base/printable.h"

namespace vsglbench {
namespace {

std::string ratio_text(const ClaimRow& r) {
  return r.pairs == 0 ? "" : fmt::format("{:.3g} [{:.3g}, {:.3g}]", r.ratio, r.ci95.lo, r.ci95.hi);
}

// "6 pairs, 0.61 … 1.2: 4 as said, 1 contrary, 1 open", by what each shows alone.
std::string pairs_text(const ClaimRow& r) {
  if (r.pairs == 0) return r.why;
  if (r.pairs == 1) return "1 pair";
  std::vector<std::string> parts;
  const auto add = [&](size_t count, const char* what) {
    if (count > 0)
      parts.push_back(fmt::format("{} {}", count == r.pairs ? "all" : std::to_string(count), what));
  };
  add(r.holding, "as said");
  add(r.contrary, "contrary");
  add(r.pairs - r.holding - r.contrary, "open");
  return fmt::format("{} pairs, {:.3g} … {:.3g}: {}", r.pairs, r.lowest, r.highest, fmt::join(parts, ", "));
}

// "holds in 3, undecided in 1 of 4"
std::string summary(const TriedClaim& claim) {
  if (claim.rows.empty()) return "not run";
  std::vector<std::string> parts;
  for (const Ruling ruling :
       {Ruling::holds, Ruling::in_part, Ruling::undecided, Ruling::does_not_hold, Ruling::not_run}) {
    const auto count = std::ranges::count(claim.rows, ruling, &ClaimRow::ruling);
    if (count > 0) parts.push_back(fmt::format("{} {}", name(ruling), count));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

// Where nothing was run for one reason, that; else empty.
std::string why_not_at_all(const TriedClaim& tried) {
  if (tried.rows.empty()) return fmt::format("no scene {}", fmt::join(tried.claim.scenes, ", "));
  const auto same = [&](const ClaimRow& r) { return r.pairs == 0 && r.why == tried.rows.front().why; };
  return std::ranges::all_of(tried.rows, same) ? tried.rows.front().why : "";
}

std::string terminal(const TriedClaim& tried) {
  std::string out = fmt::format("{}: {}\n  {}  {}\n  {}\n", tried.claim.name, summary(tried),
                                tried.claim.text, tried.claim.source, comparison_text(tried.claim));
  if (const std::string why = why_not_at_all(tried); !why.empty()) return out + "    " + why + "\n";
  size_t scene = 5, metric = 19;
  for (const ClaimRow& r : tried.rows) scene = std::max(scene, r.scene.size());
  for (const ClaimRow& r : tried.rows) metric = std::max(metric, r.metric.size());
  out += fmt::format("    {:<{}}  {:<{}}  {:<13}  {:<24}  {}\n", "scene", scene, "metric", metric, "claim",
                     "ratio [95 %]", "pairs, each alone");
  for (const ClaimRow& r : tried.rows) {
    out += fmt::format("    {:<{}}  {:<{}}  {:<13}  {:<24}  {}\n", printable(r.scene), scene, r.metric,
                       metric, name(r.ruling), ratio_text(r), pairs_text(r));
  }
  return out;
}

// Stars of a glob are no emphasis.
std::string as_code(const std::string& metric) {
  return metric.find('*') == std::string::npos ? metric : "`" + metric + "`";
}

std::string markdown(const TriedClaim& tried) {
  std::string out = fmt::format("**{}**: {}. {} {}\n\n{}.\n\n", tried.claim.name, summary(tried),
                                tried.claim.text, tried.claim.source, comparison_text(tried.claim));
  out += "| scene | metric | ruling | ratio [95 %] | pairs, each alone |\n| --- | --- | --- | ---: | --- |\n";
  for (const ClaimRow& r : tried.rows)
    out += fmt::format("| {} | {} | {} | {} | {} |\n", printable(r.scene), as_code(r.metric), name(r.ruling),
                       ratio_text(r), pairs_text(r));
  return out + "\n";
}

}  // namespace

std::string settings_text(const Json& settings) {
  std::vector<std::string> parts;
  for (const auto& item : settings.items()) {
    std::vector<std::string> values;
    for (const Json& v : item.value().is_array() ? item.value() : Json::array({item.value()}))
      values.push_back(v.is_string() ? v.get<std::string>() : v.dump());
    const std::string value = fmt::format("{}", fmt::join(values, "|"));
    parts.push_back(item.key() == "method" ? value : item.key() + "=" + value);
  }
  return fmt::format("{}", fmt::join(parts, " "));
}

std::string comparison_text(const PaperClaim& c) {
  const std::string step = c.step.empty() ? "" : c.step + " beside the next smaller " + c.step;
  std::string out = c.step.empty() ? settings_text(c.a) + " beside " + settings_text(c.b) : step;
  if (!c.both.empty()) out += ", both " + settings_text(c.both);
  out += c.equal_time ? ", at equal time" : c.a.contains("N") || c.step == "N" ? "" : ", at equal N";
  return out + fmt::format("; the ratio must be {} {:.3g}",
                           c.says == Says::less   ? "below"
                           : c.says == Says::more ? "above"
                                                  : "no more than",
                           c.factor);
}

std::string claims_text(const Report& report, const std::vector<TriedClaim>& claims, bool as_markdown) {
  std::string out;
  std::string not_run;
  for (const TriedClaim& c : claims) {
    const std::string why = as_markdown ? why_not_at_all(c) : "";
    if (why.empty()) {
      out += as_markdown ? markdown(c) : terminal(c) + "\n";
    } else {
      not_run += fmt::format("* {}: {}\n", c.claim.name, why);
    }
  }
  if (!not_run.empty()) out += "Not run here:\n\n" + not_run + "\n";
  return printable_lines(out) +
         fmt::format(
             "ratios: geometric means over pairs of cases alike in all else, with Student's interval over "
             "seeds "
             "(of times: the ends of the medians' intervals and the A/A noise; of temporal.static: of the "
             "seeds' "
             "mean distances from the others' images, by the jackknife);\n"
             "temporal.derivative counts light that lags, is blurred away or never comes, too, and what "
             "loses light flickers less: see "
             "the gain, the noise floor and a black image's flicker in `table`;\n"
             "a claim holds where this interval is wholly as said and no pair is contrary; a pair is as said "
             "or "
             "contrary where its own interval is wholly so, else open: pairs that are all open can tell "
             "together; {}{}\n",
             printable(report.device.name),
             report.device.type == "cpu" ? ", a CPU: its times say nothing of a GPU's" : "");
}

}  // namespace vsglbench
