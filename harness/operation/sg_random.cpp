#include "operation/sg_random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "operation/sg_shade.h"

namespace vsglbench {
namespace {

class Draw {
 public:
  explicit Draw(uint64_t seed) : random_(seed) {}
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double log_uniform(double least, double most) { return least * std::pow(most / least, uniform()); }
  double sign() { return uniform() < 0.5 ? -1 : 1; }

  double cosine() {
    const double which = uniform();
    if (which < 0.5) return 2 * uniform() - 1;
    if (which < 0.7) return sign() * log_uniform(1e-12, 1);
    if (which < 0.9) return sign() * (1 - log_uniform(1e-7, 1));
    return std::floor(3 * uniform()) - 1;
  }
  double within(double least, double most) {
    const double which = uniform();
    return which < 0.05 ? least : which < 0.1 ? most : log_uniform(std::max(least, 1e-6), most);
  }

 private:
  std::mt19937_64 random_;
};

// Sharpness, bandwidths, and then the axis at an angle that makes the exponent up to 80.
std::vector<double> asg_row(Draw& draw) {
  const double sharpness = draw.within(0, 0x1p41), eta_x = draw.within(1e-6, 0x1p41),
               eta_y = draw.within(1e-6, 0x1p41);
  const double nu = sharpness / 2;
  const double exponent = std::max(eta_x * nu / (eta_x + nu), eta_y * nu / (eta_y + nu));
  const double sine = std::min(std::sqrt(draw.log_uniform(1e-6, 80) / std::max(exponent, 1e-6)), 1.0);
  const double azimuth = 2 * std::numbers::pi * draw.uniform();
  return {sine * std::cos(azimuth),
          sine * std::sin(azimuth),
          std::sqrt(1 - sine * sine),
          sharpness,
          eta_x,
          eta_y};
}

// At which e^{-x} with x up to 80 is left of a lobe's product with the light's spread; some facing, opposed
// or anywhere.
double lobe_angle(Draw& draw, double sharpness, double spread) {
  const double which = draw.uniform(), joint = sharpness > 0 ? spread / (spread / sharpness + 1) : 0;
  if (which < 0.1) return 0;
  if (which < 0.2) return std::numbers::pi_v<float>;
  if (which < 0.3 || joint == 0) return std::numbers::pi * draw.uniform();
  return std::min<double>(std::sqrt(2 * draw.log_uniform(1e-6, 80) / joint), std::numbers::pi_v<float>);
}

// In the order of sg_shade::columns(). Half of the lights are near the mirror direction.
std::vector<double> shade_row(Draw& draw) {
  const double distance = draw.within(1e-6, 1e6),
               view = draw.uniform() < 0.1 ? draw.cosine() : std::abs(draw.cosine());
  const double kind = draw.uniform(), spread_drawn = draw.log_uniform(1e-6, 0x1p41);
  const double variance = kind < 0.1   ? 0
                          : kind < 0.6 ? std::min(distance * distance / spread_drawn, 1e6)
                                       : draw.log_uniform(1e-12, 1e6);
  const double spread = variance > 0 ? std::min(distance * distance / variance, 0x1p41) : 0x1p41;
  const bool mirror = draw.uniform() < 0.5;
  const double azimuth =
      draw.uniform() < 0.5 ? 1 - draw.log_uniform(1e-7, 1) : std::floor(2 * draw.uniform());
  const double light =
      mirror ? std::clamp(view + draw.sign() * draw.log_uniform(1e-7, 1), -1.0, 1.0) : draw.cosine();
  const auto unit = [&] {
    return draw.uniform() < 0.2 ? std::floor(2 * draw.uniform()) : draw.log_uniform(1e-3, 1);
  };
  const auto turn = [&] { return std::numbers::pi_v<float> * (2 * draw.uniform() - 1); };
  const double sharpness1 = draw.within(0, 0x1p41), sharpness2 = draw.within(0, 0x1p41);
  const double most = sg_shade::domain("diffuse_intensity").second;
  const double intensity1 = draw.within(0, 1) > 0 ? draw.log_uniform(1e-20, most) : 0;
  const double intensity2 = std::clamp(intensity1 * draw.log_uniform(1e-6, 1e6), 1e-20, most);
  const double ndf = draw.uniform() < 0.5 ? draw.within(1e-3f, 1) : -draw.within(1, 65535);
  return {distance,
          variance,
          light,
          mirror ? std::numbers::pi_v<float> * azimuth : turn(),
          lobe_angle(draw, sharpness1, spread),
          turn(),
          sharpness1,
          intensity1,
          lobe_angle(draw, sharpness2, spread),
          turn(),
          sharpness2,
          intensity2,
          view,
          unit(),
          unit(),
          ndf,
          std::floor(2 * draw.uniform())};
}

// In the order of sg_receiver::columns(), the SG within a few widths of the lobe.
std::vector<double> receiver_row(Draw& draw) {
  const double ndf = draw.uniform() < 0.5 ? draw.within(1e-3f, 1) : -draw.within(1, 65535);
  const double sharpness = ndf > 0 ? 2 / (ndf * ndf) : -ndf;
  const double offset = std::min(180 * draw.uniform(), 180 * draw.uniform() / std::sqrt(sharpness));
  return {ndf,
          draw.uniform(),
          89 * draw.uniform(),
          offset,
          180 * (2 * draw.uniform() - 1),
          sharpness * draw.log_uniform(0.01, 100)};
}

std::vector<double> random_row(const SgQuestion& q, Draw& draw) {
  if (q.function == SgFunction::receiver) return receiver_row(draw);
  if (q.function == SgFunction::shade) return shade_row(draw);
  if (q.info().columns[0] == "axis_x") return asg_row(draw);
  std::vector<double> row;
  for (const auto& column : q.info().columns) {
    const auto [least, most] = sg_domain(q, column);
    if (column == "cosine") {
      row.push_back(draw.cosine());
    } else if (column == "x") {
      row.push_back(std::min(draw.sign() * draw.log_uniform(1e-10, -least), most));
    } else {
      row.push_back(draw.within(least, most));
    }
  }
  return row;
}

// Simpler numbers in a number's stead, the simplest first.
std::vector<float> simpler(float value) {
  std::vector<float> out = {0, 1, -1, 0.5f, -0.5f};
  for (int digits = 1; digits < 8; ++digits) out.push_back(std::stof(fmt::format("{:.{}g}", value, digits)));
  return out;
}

size_t length(float value) { return fmt::format("{}", value).size(); }

}  // namespace

std::vector<float> random_rows(const SgQuestion& question, size_t count, uint64_t seed) {
  Draw draw(seed);
  std::vector<float> rows;
  rows.reserve(count * question.info().columns.size());
  for (size_t i = 0; i < count; ++i) {
    for (const double x : random_row(question, draw)) rows.push_back(static_cast<float>(x));
  }
  return rows;
}

ErrorSpread error_spread(const SgQuestion& question, const SgAnswers& answers) {
  ErrorSpread spread;
  std::vector<double> errors;
  for (size_t i = 0; i < answers.error.size(); ++i) {
    if (!impossible(question, answers, i).empty()) spread.impossible.push_back(i);
    if (!std::isfinite(answers.error[i])) continue;
    errors.push_back(answers.error[i]);
    if (answers.error[i] >= spread.max) spread.worst = i;
    spread.max = std::max(spread.max, answers.error[i]);
  }
  const auto percentile = [&](double p) {
    if (errors.empty()) return 0.0;
    const auto at = errors.begin() + static_cast<ptrdiff_t>(p * static_cast<double>(errors.size() - 1));
    std::nth_element(errors.begin(), at, errors.end());
    return *at;
  };
  spread.p50 = percentile(0.5);
  spread.p99 = percentile(0.99);
  return spread;
}

std::vector<float> shrink(SgEvaluator& evaluator, std::vector<float> row) {
  const SgQuestion& q = evaluator.question();
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t k = 0; k < row.size(); ++k) {
      // All the simpler rows at once; the first that fails still is taken.
      std::vector<float> candidates;
      for (const float value : simpler(row[k])) {
        std::vector<float> candidate = row;
        candidate[k] = value;
        if (length(value) >= length(row[k]) || !out_of_domain(q, candidate).empty()) continue;
        candidates.insert(candidates.end(), candidate.begin(), candidate.end());
      }
      if (candidates.empty()) continue;
      const SgAnswers answers = evaluator.evaluate(candidates);
      for (size_t i = 0; i < answers.error.size() && !changed; ++i) {
        if (impossible(q, answers, i).empty()) continue;
        row.assign(candidates.begin() + i * row.size(), candidates.begin() + (i + 1) * row.size());
        changed = true;
      }
    }
  }
  return row;
}

std::string reproducer(const SgQuestion& question, const std::vector<float>& row) {
  const std::string model = question.has_model() ? " --model " + question.model_name() : "";
  // Without a file it prints its own table.
  const char* in = question.function == SgFunction::receiver ? " --in /dev/stdin" : "";
  return fmt::format("printf '{}\\n{}\\n' | vsglbench sg{} --function {}{}",
                     fmt::join(question.info().columns, ","), fmt::join(row, ","), model,
                     question.info().name, in);
}

}  // namespace vsglbench
