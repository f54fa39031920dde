// The errors of a case's seeds, measured on other threads while the device renders the next seed.
#pragma once

#include <deque>
#include <future>
#include <optional>
#include <vector>

#include "image/crop.h"
#include "image/flip.h"
#include "image/metrics.h"
#include "reference/reference.h"
#include "report/report.h"

namespace vsglbench {

// Of one image against the reference.
struct SeedScore {
  uint64_t seed = 0;
  Errors errors;
  std::optional<ErrorQuantiles> quantiles;  // of seed 0
  std::optional<double> detail, spikes;     // as SeedResult's
  std::optional<RegionErrors> region;
};

// The last references as FLIP sees them, for all cases that are compared with one over the same pixels.
class FlipKeeper {
 public:
  // Made on another thread where it isn't kept; `reference` outlives the making.
  std::shared_future<FlipReference> get(const ReferenceResult& reference, const Mask& mask,
                                        const FlipExposures& exposures);

 private:
  struct Kept {
    std::string hash;
    Mask mask;
    std::shared_future<FlipReference> flip;
  };
  std::vector<Kept> kept_;  // two, those of cases with exact visibility and without; the latest last
};

class Scoring {
 public:
  // `reference` outlives it. FLIP looks at an image once an exposure: where that takes long, it is measured
  // for seed 0 alone. `region`: where errors are also measured by themselves.
  Scoring(const ReferenceResult& reference, Mask mask, const std::optional<Crop>& region = std::nullopt,
          FlipKeeper* keeper = nullptr);
  // Starts. Waits while more images are open than memory should hold.
  void add(uint64_t seed, Image image);
  // Waits for all of them; by seed. Throws what measuring threw.
  std::vector<SeedScore> collect();

  const Mask& mask() const { return mask_; }
  bool has_region() const { return region_.has_value(); }  // and a pixel of it counts
  // Nothing for a black reference.
  const std::optional<FlipExposures>& flip_exposures() const { return exposures_; }

 private:
  struct Part {
    Crop crop;
    Mask mask;  // of that part
  };
  SeedScore score(uint64_t seed, const Image& image) const;
  RegionErrors score_region(const Image& image) const;
  void take_region(const Crop& crop);
  void take_oldest();
  const ReferenceResult& reference_;
  Mask mask_;
  std::optional<Part> region_;
  std::optional<FlipExposures> exposures_;
  std::shared_future<FlipReference> flip_;  // not valid for a black reference
  std::deque<std::future<SeedScore>> open_;
  std::vector<SeedScore> scores_;
};

}  // namespace vsglbench
