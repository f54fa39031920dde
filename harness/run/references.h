// The references that one scene's cases are compared with, each computed or read once.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "reference/reference.h"
#include "report/report.h"
#include "run/config.h"

namespace vsglbench {

// ", reached 2 %" or ", ended before 2 % by the limit of 600 s"; nothing where no floor was asked for.
std::string end_of_search(const ReferenceResult& result, const ReferenceParameters& parameters);

// " (100 asked for, rounded up to 16 equal batches)"; nothing where it is what was asked for, or a floor was.
std::string rounding_of(const ReferenceResult& result, const ReferenceParameters& parameters);

// Why a reference says little: it is nearly black (kNearlyBlack), or its mean is known to no better than a
// half. Nothing where it says much. Throws Error(case_failed) where it is black.
std::optional<std::string> doubt_about(const Scene& scene, const ReferenceResult& result);

// Of the reference that a case is compared with.
ReferenceParameters reference_parameters(const Config& config, const Case& c);

// By frame size and occlusion: `none` is compared without occlusion between the bounces, all else with it.
class References {
 public:
  References(const Scene& scene, const Config& config, WallTime* wall)
      : scene_(scene), config_(config), wall_(wall) {}

  // Throws Error(case_failed) when it does not fit into memory, the camera or the light sees nothing, or no
  // light comes back; asked again, the same error at once.
  const ReferenceResult& get(const Case& c);
  // What the report says of it: its floors, and whether there is light in it at all.
  const ReferenceInfo& info(const Case& c);

 private:
  struct Slot {
    std::unique_ptr<ReferenceResult> result;
    std::optional<ReferenceInfo> info;
    std::optional<Error> error;
  };
  Slot& slot(const Case& c);
  ReferenceResult obtain(const Case& c);
  const Scene& scene_;
  const Config& config_;
  WallTime* wall_;
  std::map<std::tuple<uint32_t, uint32_t, bool>, Slot> slots_;
};

}  // namespace vsglbench
