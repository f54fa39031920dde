#include "run/scoring.h"

#include <algorithm>

#include "image/detail.h"
#include "image/spikes.h"

namespace vsglbench {
namespace {

// Pixels times exposures that take FLIP about a tenth of a second: at 480×272, four exposures.
constexpr uint64_t kFlipPixelsOfEverySeed = 600'000;
constexpr size_t kOpenBytes = size_t{256} << 20;

// Nothing without halves of the reference, which alone tell its detail from its noise.
std::optional<double> detail_of(const Image& x, const Image& half0, const Image& half1, const Mask& mask) {
  if (half0.pixels.empty() || half1.pixels.empty()) return std::nullopt;
  DetailMeter meter;
  meter.add(x, half0, half1, mask);
  const auto detail = meter.finish();
  return detail ? std::optional(detail->value) : std::nullopt;
}

}  // namespace

std::shared_future<FlipReference> FlipKeeper::get(const ReferenceResult& reference, const Mask& mask,
                                                  const FlipExposures& exposures) {
  const auto same = std::ranges::find_if(
      kept_, [&](const Kept& kept) { return kept.hash == reference.hash && kept.mask == mask; });
  if (same != kept_.end()) return same->flip;
  if (kept_.size() == 2) kept_.erase(kept_.begin());
  kept_.push_back({reference.hash, mask, std::async(std::launch::async, [&reference, mask, exposures] {
                     return FlipReference(reference.mean, mask, exposures);
                   })});
  return kept_.back().flip;
}

Scoring::Scoring(const ReferenceResult& reference, Mask mask, const std::optional<Crop>& region,
                 FlipKeeper* keeper)
    : reference_(reference),
      mask_(std::move(mask)),
      exposures_(vsglbench::flip_exposures(reference.mean, mask_)) {
  if (region) take_region(*region);
  FlipKeeper own;
  if (exposures_) flip_ = (keeper ? *keeper : own).get(reference_, mask_, *exposures_);
}

// Where no pixel counts there is no region.
void Scoring::take_region(const Crop& crop) {
  Mask mask = crop_mask(mask_, reference_.mean.width, crop);
  const bool any = mask.empty() || std::ranges::any_of(mask, [](uint8_t kept) { return kept != 0; });
  if (any) region_ = Part{crop, std::move(mask)};
}

void Scoring::add(uint64_t seed, Image image) {
  const size_t most = std::max<size_t>(1, kOpenBytes / (1 + image.pixels.size() * sizeof image.pixels[0]));
  while (open_.size() >= most) take_oldest();
  open_.push_back(
      std::async(std::launch::async, [this, seed, image = std::move(image)] { return score(seed, image); }));
}

SeedScore Scoring::score(uint64_t seed, const Image& image) const {
  SeedScore score{.seed = seed, .errors = measure_errors(image, reference_.mean, mask_)};
  if (seed == 0) score.quantiles = error_quantiles(image, reference_.mean, mask_);
  score.detail = detail_of(image, reference_.half[0], reference_.half[1], mask_);
  score.spikes = spike_share(image, reference_.mean, mask_);
  if (region_) score.region = score_region(image);
  const bool every_seed = exposures_ && image.pixels.size() * exposures_->count <= kFlipPixelsOfEverySeed;
  if (!exposures_ || (seed > 0 && !every_seed)) return score;
  const FlipErrors flip = flip_.get().compare(image);
  score.errors.flip = flip.mean;
  score.errors.flip_p99 = flip.p99;
  return score;
}

// Gradients across its border belong to neither side.
RegionErrors Scoring::score_region(const Image& image) const {
  const auto part_of = [this](const Image& of) {
    return of.pixels.empty() ? Image() : crop_image(of, region_->crop);
  };
  const Image part = part_of(image);
  const Errors errors = measure_errors(part, part_of(reference_.mean), region_->mask);
  return {errors.smape, errors.rmse, errors.bias,
          detail_of(part, part_of(reference_.half[0]), part_of(reference_.half[1]), region_->mask)};
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
