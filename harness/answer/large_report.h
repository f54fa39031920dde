// Tests only: a report that obeys the schema, with as many cases as are asked for, of one scene.
#pragma once

#include <cmath>
#include <random>

#include "report/synthetic_report.h"

namespace vsglbench {

struct LargeSweep {
  std::vector<std::string> methods = {"vpl",
                                      "vsl",
                                      "fis",
                                      "mfis",
                                      "kmeans2d",
                                      "kmeans3d",
                                      "kmeans3d-segmented",
                                      "kmeans2d-segmented",
                                      "cut",
                                      "mfis-mh",
                                      "two-vsgl",
                                      "grid"};
  std::vector<int> N = {16, 32, 64, 128, 256, 512, 1024, 2048};
  std::vector<double> K = {0.5, 1, 2, 4, 8, 16, 32};
  std::vector<int> importance_lights = {64, 128, 256, 512, 1024};
  std::vector<std::string> shading = {"vsgl16", "vsgl14", "sg"};
};

inline void scale(Summary* time, double by) {
  for (double& s : time->samples) s *= by;
  for (double* v :
       {&time->median, &time->min, &time->q1, &time->q3, &time->p95, &time->ci95.lo, &time->ci95.hi})
    *v *= by;
}

// The template with all times as many times as long, and other errors: times grow with N, errors fall with
// it, both scatter from case to case, and errors from seed to seed.
inline CaseResult large_case(const CaseResult& model, size_t i, const Json& parameters,
                             const std::string& method, std::mt19937_64* random) {
  std::lognormal_distribution<> scatter(0, 0.3), small(0, 0.05);
  const double lights = parameters.at("N").get<double>() / 256, ms = std::pow(lights, 0.7) * scatter(*random),
               error = 10 * std::pow(lights, -0.4) * scatter(*random);
  CaseResult c = model;
  c.id = fmt::format("hall/{}/", method);
  for (const auto& item : parameters.items())
    c.id += fmt::format("{}={},", item.key(),
                        item.value().is_string() ? item.value().get<std::string>() : item.value().dump());
  c.id += fmt::format("i={}", i);
  c.method = method;
  c.parameters = parameters;
  for (PassTiming& p : c.passes) scale(&p.ms, ms);
  for (Summary* time : {&c.frame->span, &*c.frame->method, &*c.frame->host_visibility, &c.generate->total})
    scale(time, ms);
  c.frame->sum_ms *= ms;
  c.frame->unattributed_ms *= ms;
  for (SeedResult& s : c.seeds) {
    s.errors.smape = std::min(199.0, error * small(*random));
    s.errors.rmse = 0.01 * error * small(*random);
    s.errors.flip = std::min(1.0, 0.02 * error * small(*random));
  }
  ReferenceInfo reference = model.accuracy->reference;
  reference.hash = parameters.at("visibility") == "none" ? "aa" : "bb";
  const auto quantiles = model.accuracy->quantiles;
  c.accuracy = accuracy_over_seeds(c.seeds, reference);
  c.accuracy->quantiles = quantiles;
  return c;
}

inline Report large_report(size_t cases, const LargeSweep& sweep = {}) {
  Report r = synthetic_report();
  std::mt19937_64 random(7);
  CaseResult model = synthetic_case("hall/model/");
  model.scene = "hall";
  r.cases.clear();
  r.scenes[0].name = "hall";
  r.aa[0].scene = "hall";
  for (const char* visibility : {"none", "exact"}) {
    for (const std::string& method : sweep.methods) {
      for (const int n : sweep.N) {
        for (const double k : sweep.K) {
          for (const int lights : sweep.importance_lights) {
            for (const std::string& shading : sweep.shading) {
              if (r.cases.size() == cases) return r;
              r.cases.push_back(large_case(model, r.cases.size(),
                                           {{"N", n},
                                            {"rsm", 256},
                                            {"visibility", visibility},
                                            {"importance_lights", lights},
                                            {"shading", shading},
                                            {"K", k}},
                                           method, &random));
            }
          }
        }
      }
    }
  }
  return r;
}

}  // namespace vsglbench
