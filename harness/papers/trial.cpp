#include "papers/trial.h"

#include <algorithm>
#include <array>

#include "base/error.h"

namespace vsglbench {
namespace {

constexpr std::array kRulings = {Ruling::holds, Ruling::does_not_hold, Ruling::in_part, Ruling::undecided,
                                 Ruling::not_run};

Ruling ruling_of(Finding finding) {
  switch (finding) {
    case Finding::holds:
      return Ruling::holds;
    case Finding::does_not_hold:
      return Ruling::does_not_hold;
    case Finding::undecided:
      return Ruling::undecided;
  }
  throw std::logic_error("no such finding");
}

std::string pairs_text(const ClaimRow& row) {
  if (row.pairs < 2) return "";
  return fmt::format("{} pairs, {:.3g} … {:.3g}: {} as said, {} contrary", row.pairs, row.lowest, row.highest,
                     row.holding, row.contrary);
}

ClaimTrial trial_of(const ClaimRow& row, const PaperClaim& claim, const Exhibit& exhibit) {
  ClaimTrial t{.exhibit = exhibit.name,
               .claim = claim.name,
               .text = claim.text,
               .source = claim.source,
               .how = comparison_text(claim),
               .place = row.scene,
               .metric = row.metric,
               .ruling = row.ruling,
               .figures = row.pairs == 0 ? row.why : pairs_text(row)};
  if (row.pairs > 0) t.ratio = row.ratio;
  if (row.pairs > 0) t.ci95 = row.ci95;
  return t;
}

const PaperClaim& claim_named(const std::vector<PaperClaim>& claims, const std::string& name,
                              const Exhibit& exhibit) {
  const auto at = std::ranges::find(claims, name, &PaperClaim::name);
  if (at == claims.end()) throw fail(ErrorKind::config, "{}: no claim is named '{}'", exhibit.name, name);
  return *at;
}

const Json& size_of(const Json& sizes, const std::string& method) {
  for (const Json& s : sizes) {
    if (s.at("method") == method) return s;
  }
  throw fail(ErrorKind::config, "the code size of {} is not known", method);
}

// A count of both beside each other, as the table of the paper has them.
ClaimTrial of_counts(const Exhibit& exhibit, const std::string& name, const std::string& text, double a,
                     double b, double factor, const std::string& how) {
  ClaimTrial t{.exhibit = exhibit.name,
               .claim = "code-size/" + name,
               .text = text,
               .source = "[MFIS16 §5, Tab. 3]",
               .how = how,
               .place = "source tree",
               .metric = name};
  t.ratio = b > 0 ? std::optional(a / b) : std::nullopt;
  t.ruling = !t.ratio ? Ruling::undecided : *t.ratio <= factor ? Ruling::holds : Ruling::does_not_hold;
  t.figures = fmt::format("{:g} beside {:g}", a, b);
  return t;
}

// A ratio that must be above (sign 1) or below (-1) 1, by its interval.
ClaimTrial of_edges(const LightsResult& r, const Exhibit& exhibit, const std::string& name,
                    const std::string& text, const std::optional<Ratio>& ratio, int sign) {
  ClaimTrial t{
      .exhibit = exhibit.name,
      .claim = "lights-on-edges/" + name,
      .text = text,
      .source = "[VSGL14 §3.2, Fig. 2]",
      .how = fmt::format("medians of a case's lights whose footprints hold discontinuous geometry beside "
                         "those of the others; the ratio must be {} 1",
                         sign > 0 ? "above" : "below"),
      .place = r.id,
      .metric = name};
  t.figures = fmt::format("{} lights on discontinuities, {} not", r.edges->on, r.edges->off);
  if (!ratio) return t;
  t.ratio = ratio->value;
  t.ci95 = ratio->ci95;
  const bool above = ratio->ci95.lo > 1, below = ratio->ci95.hi < 1;
  t.ruling = (sign > 0 ? above : below)   ? Ruling::holds
             : (sign > 0 ? below : above) ? Ruling::does_not_hold
                                          : Ruling::undecided;
  return t;
}

}  // namespace

std::optional<Ruling> ruling_named(const std::string& text) {
  for (const Ruling r : kRulings) {
    if (name(r) == text) return r;
  }
  return std::nullopt;
}

std::vector<ClaimTrial> trials_of(const Report& report, const Exhibit& exhibit,
                                  const std::vector<PaperClaim>& claims) {
  std::vector<ClaimTrial> out;
  for (const std::string& name : exhibit.claims) {
    const TriedClaim tried = try_claim(report, claim_named(claims, name, exhibit));
    for (const ClaimRow& row : tried.rows) out.push_back(trial_of(row, tried.claim, exhibit));
  }
  return out;
}

std::vector<ClaimTrial> trials_of(const DrawnFigure& figure, const Exhibit& exhibit) {
  std::vector<ClaimTrial> out;
  for (size_t i = 0; i < figure.claims.size(); ++i) {
    const Claim& c = figure.claims[i];
    out.push_back({.exhibit = exhibit.name,
                   .claim = fmt::format("{}/{}", exhibit.figure, i + 1),
                   .text = c.text,
                   .source = c.source,
                   .how = "vsglbench figure " + exhibit.figure,
                   .place = exhibit.figure,
                   .metric = "figure",
                   .ruling = ruling_of(c.finding),
                   .figures = c.figures});
  }
  return out;
}

std::vector<ClaimTrial> trials_of_code_size(const Json& sizes, const Exhibit& exhibit) {
  std::vector<ClaimTrial> out;
  const auto lines = [](const Json& s) {
    return s.at("own_lines").get<double>() + s.at("shared_lines").get<double>();
  };
  const auto dispatches = [](const Json& s) { return s.at("dispatches").at("rsm").get<double>(); };
  const auto kernels = [](const Json& s) { return s.at("kernels").get<double>(); };
  const Json& fis = size_of(sizes, "fis");
  const Json& mfis = size_of(sizes, "mfis");
  out.push_back(of_counts(exhibit, "mfis-kernels",
                          "The modified method has no more shaders than the original", kernels(mfis),
                          kernels(fis), 1, "kernels of mfis beside fis; no more"));
  out.push_back(of_counts(exhibit, "mfis-lines",
                          "The modification takes ten lines: less than a twentieth of the original's code",
                          lines(mfis), lines(fis), 1.05, "lines of mfis beside fis; at most 1.05 times"));
  for (const char* method : {"kmeans2d", "kmeans3d"}) {
    const Json& kmeans = size_of(sizes, method);
    out.push_back(of_counts(exhibit, fmt::format("{}-lines", method),
                            "Filtered sampling takes about a fifth of the lines of k-means clustering",
                            lines(mfis), lines(kmeans), 0.25,
                            fmt::format("lines of mfis beside {}; at most a quarter", method)));
    out.push_back(of_counts(exhibit, fmt::format("{}-kernels", method),
                            "k-means clustering requires more compute shaders", kernels(mfis),
                            kernels(kmeans), 0.999, fmt::format("kernels of mfis beside {}; fewer", method)));
    out.push_back(of_counts(exhibit, fmt::format("{}-dispatches", method),
                            "k-means clustering dispatches some shaders iteratively, for its sort",
                            dispatches(mfis), dispatches(kmeans), 0.999,
                            fmt::format("dispatches of mfis beside {}; fewer", method)));
  }
  return out;
}

std::vector<ClaimTrial> trials_of(const std::vector<LightsResult>& lights, const Exhibit& exhibit) {
  std::vector<ClaimTrial> out;
  for (const LightsResult& r : lights) {
    if (!r.edges || r.seed != 0) continue;  // the seed that is drawn
    out.push_back(of_edges(r, exhibit, "larger", "Filtering makes larger VSGLs on discontinuous geometry",
                           r.edges->sigma, 1));
    out.push_back(of_edges(r, exhibit, "darker", "Filtering makes darker VSGLs on discontinuous geometry",
                           r.edges->density, -1));
  }
  return out;
}

Json to_json(const ClaimTrial& t) {
  Json json = {{"exhibit", t.exhibit}, {"claim", t.claim},
               {"source", t.source},   {"text", t.text},
               {"how", t.how},         {"place", t.place},
               {"metric", t.metric},   {"ruling", std::string(name(t.ruling))}};
  if (t.ratio) json["ratio"] = *t.ratio;
  if (t.ci95) json["ci95"] = {t.ci95->lo, t.ci95->hi};
  if (!t.figures.empty()) json["figures"] = t.figures;
  return json;
}

ClaimTrial trial_from_json(const Json& json) {
  ClaimTrial t{.exhibit = json.at("exhibit"),
               .claim = json.at("claim"),
               .text = json.value("text", ""),
               .source = json.at("source"),
               .how = json.value("how", ""),
               .place = json.at("place"),
               .metric = json.at("metric"),
               .figures = json.value("figures", "")};
  const auto ruling = ruling_named(json.at("ruling"));
  if (!ruling) throw fail(ErrorKind::config, "no ruling is named {}", json.at("ruling").dump());
  t.ruling = *ruling;
  if (json.contains("ratio")) t.ratio = json["ratio"].get<double>();
  if (json.contains("ci95")) t.ci95 = Interval{json["ci95"].at(0), json["ci95"].at(1)};
  return t;
}

}  // namespace vsglbench
