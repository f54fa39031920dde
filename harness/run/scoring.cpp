#include "run/scoring.h"

#include <algorithm>

namespace vsglbench {
namespace {

// Pixels times exposures that take FLIP about a tenth of a second: at 480×272, four exposures.
constexpr uint64_t kFlipPixelsOfEverySeed = 600'000;
constexpr size_t kOpenBytes = size_t{256} << 20;

}  // namespace

Scoring::Scoring(const ReferenceResult& reference, Mask mask)
    : reference_(reference),
      mask_(std::move(mask)),
      exposures_(vsglbench::flip_exposures(reference.mean, mask_)) {
  if (!exposures_) return;
  flip_ =
      std::async(std::launch::async, [this] { return FlipReference(reference_.mean, mask_, *exposures_); });
}

void Scoring::add(uint64_t seed, Image image) {
  const size_t most = std::max<size_t>(1, kOpenBytes / (1 + image.pixels.size() * sizeof image.pixels[0]));
  while (open_.size() >= most) take_oldest();
  open_.push_back(
      std::async(std::launch::async, [this, seed, image = std::move(image)] { return score(seed, image); }));
}

SeedScore Scoring::score(uint64_t seed, const Image& image) const {
  SeedScore score{seed, measure_errors(image, reference_.mean, mask_), std::nullopt};
  if (seed == 0) score.quantiles = error_quantiles(image, reference_.mean, mask_);
  const bool every_seed = exposures_ && image.pixels.size() * exposures_->count <= kFlipPixelsOfEverySeed;
  if (!exposures_ || (seed > 0 && !every_seed)) return score;
  const FlipErrors flip = flip_.get().compare(image);
  score.errors.flip = flip.mean;
  score.errors.flip_p99 = flip.p99;
  return score;
}

void Scoring::take_oldest() {
  std::future<SeedScore> oldest = std::move(open_.front());
  open_.pop_front();
  scores_.push_back(oldest.get());
}

std::vector<SeedScore> Scoring::collect() {
  while (!open_.empty()) take_oldest();
  std::ranges::sort(scores_, {}, &SeedScore::seed);
  return std::move(scores_);
}

}  // namespace vsglbench
