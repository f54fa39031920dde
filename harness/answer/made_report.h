// Tests only: reports with chosen times and errors.
#pragma once

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "report/report.h"

namespace vsglbench {

struct MadeCase {
  std::string scene = "box", method = "fis";
  Json parameters = Json::object();
  std::map<std::string, double> passes;  // median ms
  double error = 10;                     // SMAPE, mean over seeds; RMSE is a hundredth
  double bias = 0;
  std::string reference = "0123";
  // Mean over seeds of temporal.derivative and of the seeds' distances in temporal.static; 0: still.
  double flicker = 0;
  double detail = 1;
};

class MadeReport {
 public:
  // Times scatter by `time_noise`, errors by `seed_noise`, both relative.
  MadeReport(uint64_t seed, double time_noise, double seed_noise, uint64_t frames = 16, uint64_t seeds = 8)
      : random_(seed), time_noise_(time_noise), seed_noise_(seed_noise), frames_(frames), seeds_(seeds) {
    report.device.name = "made";
  }

  CaseResult& add(const MadeCase& made) {
    CaseResult c;
    c.scene = made.scene;
    c.method = made.method;
    c.parameters = made.parameters;
    c.id = made.scene + "/" + made.method + "/";
    for (const auto& item : made.parameters.items())
      c.id += (c.id.ends_with('/') ? "" : ",") + item.key() + "=" +
              (item.value().is_string() ? item.value().get<std::string>() : item.value().dump());
    std::vector<double> span(frames_, 0);
    for (const auto& [name, ms] : made.passes) {
      std::vector<double> samples;
      for (uint64_t k = 0; k < frames_; ++k) {
        samples.push_back(ms * scatter(time_noise_));
        span[k] += samples.back();
      }
      c.passes.push_back({parse_pass_name(name), summarize(samples)});
    }
    c.frame = frame_timing(span, c.passes);
    for (uint64_t s = 0; s < seeds_; ++s) {
      SeedResult seed;
      seed.seed = s;
      const double error = made.error * seed_scatter(s);
      seed.errors = {error, 0.01 * error, 0.1 * error, 0.2 * error, made.bias, 1000, {}, {}, {}, {}};
      c.seeds.push_back(seed);
    }
    ReferenceInfo reference;
    reference.hash = made.reference;
    c.accuracy = accuracy_over_seeds(c.seeds, reference);
    if (made.flicker > 0) c.temporal = temporal_of(made);
    report.cases.push_back(std::move(c));
    return report.cases.back();
  }

  Report report;

 private:
  double scatter(double share) {
    return share > 0 ? std::exp(std::normal_distribution<>(0, share)(random_)) : 1;
  }
  // The same for every case: a seed moves all methods alike.
  double seed_scatter(uint64_t seed) const {
    std::mt19937_64 of_seed(seed + 17);
    return seed_noise_ > 0 ? std::exp(std::normal_distribution<>(0, seed_noise_)(of_seed)) : 1;
  }
  Temporal temporal_of(const MadeCase& made) const {
    Temporal t;
    t.derivative.value = made.flicker;
    t.still.emplace().value = made.flicker;
    t.detail.emplace().value = made.detail;
    for (uint64_t s = 0; s < seeds_; ++s) {
      t.derivative.values.push_back(made.flicker * seed_scatter(s));
      t.still->series.push_back(made.flicker * seed_scatter(s));
      t.detail->values.push_back(made.detail * seed_scatter(s));
    }
    t.frames = 16;
    t.seeds = seeds_;
    return t;
  }
  std::mt19937_64 random_;
  double time_noise_, seed_noise_;
  uint64_t frames_, seeds_;
};

}  // namespace vsglbench
