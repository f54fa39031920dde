#include "run/references.h"

#include <algorithm>

#include "base/log.h"
#include "base/progress.h"
#include "measure/stopwatch.h"
#include "reference/cache.h"
#include "run/memory.h"

namespace vsglbench {

std::string end_of_search(const ReferenceResult& result, const ReferenceParameters& p) {
  if (p.floor == 0) return "";
  return fmt::format(", {} {} %", result.ended_by == ReferenceEnd::floor ? "reached" : "ended before", p.floor) +
         (result.ended_by == ReferenceEnd::time_limit ? fmt::format(" by the limit of {} s", p.time_limit) : "");
}

const ReferenceResult& References::get(const Case& c) {
  const bool occlusion = c.frame.visibility != Visibility::none;
  Slot& slot = slots_[{c.frame.width, c.frame.height, occlusion}];
  if (!slot.result && !slot.error) {
    const Stopwatch watch;
    try {
      slot.result = std::make_unique<ReferenceResult>(obtain(c, occlusion));
    } catch (const Error& e) {
      slot.error = e;
    }
    wall_->references_s += watch.seconds();
  }
  if (slot.error) throw *slot.error;
  return *slot.result;
}

ReferenceResult References::obtain(const Case& c, bool occlusion) {
  require_reference_memory(c.frame.width, c.frame.height);
  ReferenceParameters p;
  p.width = c.frame.width;
  p.height = c.frame.height;
  p.samples = config_.reference.samples;
  p.batches = config_.reference.batches;
  p.seed = config_.reference.seed;
  p.shading_normals = config_.reference.shading_normals;
  p.floor = config_.reference.floor;
  if (p.floor > 0) p.time_limit = config_.reference.time_limit_s;
  p.occlusion = occlusion;
  const Stopwatch watch;
  bool cached = false;
  ReferenceResult result = load_or_compute(scene_, p, &cached);
  if (std::all_of(result.mean.pixels.begin(), result.mean.pixels.end(),
                  [](const glm::vec3& v) { return v == glm::vec3(0); })) {
    throw fail(ErrorKind::case_failed, "no indirect light reaches the view: the reference is black");
  }
  log_info("{}: reference{} of {} samples {} ({}), noise floor {:.2f} % SMAPE, its mean known to {:.2f} %{}",
           scene_.name, occlusion ? "" : " without occlusion", result.samples,
           cached ? "from the cache" : "computed", format_duration(watch.seconds()), result.noise_floor_smape,
           100 * result.standard_error, end_of_search(result, p));
  return result;
}

}  // namespace vsglbench
