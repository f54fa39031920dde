#include "run/case_flicker.h"

#include <algorithm>

#include "image/static_flicker.h"

namespace vsglbench {
namespace {

constexpr uint32_t kMaxStaticSeeds = 32;  // their images are held together

std::optional<Interval> interval_of(const MeanEstimate& estimate) {
  return estimate.known ? std::optional(estimate.ci95) : std::nullopt;
}

uint64_t place_of_largest(const std::vector<double>& values) {
  return static_cast<uint64_t>(std::ranges::max_element(values) - values.begin());
}

Error black() { return fail(ErrorKind::case_failed, "the references are black: flicker has no measure"); }

}  // namespace

CaseFlicker::CaseFlicker(CaseRun& run, uint32_t seeds) : run_(run), seeds_(run.seeds() > 1 ? seeds : 1) {}

std::optional<CaseRun::Look> CaseFlicker::look(uint32_t frame, const ReferenceResult& reference) {
  const size_t still = frame == 0 ? std::min(run_.seeds(), kMaxStaticSeeds) : 0;
  const size_t wanted = std::max(still, seeds_.size());
  std::optional<CaseRun::Look> first;
  std::vector<Image> frozen;
  for (uint32_t seed = 0; seed < wanted; ++seed) {
    Carried* carried = seed < seeds_.size() ? &seeds_[seed].carried : nullptr;
    auto look = run_.look_in_motion(frame, seed, reference, carried);
    if (!look) return std::nullopt;
    if (seed < seeds_.size()) {
      seeds_[seed].flicker.add(look->image, reference.mean, look->mask);
      seeds_[seed].detail.add(look->image, reference.half[0], reference.half[1], look->mask);
    }
    if (seed < still) frozen.push_back(look->image);
    if (seed == 0) first = std::move(look);
  }
  if (frozen.size() > 1) look_at_frozen(frozen, first->mask, reference);
  references_.push_back(reference.hash);
  return first;
}

void CaseFlicker::look_at_frozen(const std::vector<Image>& images, const Mask& mask,
                                 const ReferenceResult& reference) {
  const auto found = static_flicker(images, reference.mean, mask);
  if (!found) throw black();
  frozen_.emplace();
  frozen_->value = found->value;
  frozen_->p99 = found->p99;
  if (!found->pseudovalues.empty()) frozen_->ci95 = interval_of(mean_ci95(found->pseudovalues));
  frozen_->formula = static_flicker_formula().id;
  frozen_->series = found->series;
  frozen_->values = found->pseudovalues;
  frozen_->worst_frame = place_of_largest(frozen_->series);
}

Temporal CaseFlicker::finish() const {
  std::vector<double> values, tails;
  Temporal out;
  FlickerSeries& all = out.derivative;
  for (const Seed& seed : seeds_) {
    const auto found = seed.flicker.finish();
    if (!found) throw black();
    values.push_back(found->value);
    tails.push_back(found->p99);
    all.series.resize(found->series.size(), 0);
    for (size_t i = 0; i < all.series.size(); ++i)
      all.series[i] += found->series[i] / static_cast<double>(seeds_.size());
  }
  const MeanEstimate estimate = mean_ci95(values);
  all.value = estimate.mean;
  all.ci95 = interval_of(estimate);
  all.values = values;
  all.p99 = mean_ci95(tails).mean;
  all.worst_frame = place_of_largest(all.series) + 1;
  all.formula = derivative_flicker_formula().id;
  out.still = frozen_;
  out.detail = detail();
  out.frames = seeds_.front().flicker.frames();
  out.seeds = seeds_.size();
  out.references = references_;
  return out;
}

std::optional<DetailResult> CaseFlicker::detail() const {
  std::vector<double> values, gains;
  for (const Seed& seed : seeds_) {
    const auto found = seed.detail.finish();
    if (!found) return std::nullopt;
    values.push_back(found->value);
    gains.push_back(found->gain);
  }
  const MeanEstimate estimate = mean_ci95(values);
  return DetailResult{estimate.mean, mean_ci95(gains).mean, interval_of(estimate), detail_formula().id,
                      values};
}

}  // namespace vsglbench
