// What every frame of a case is checked for: values, memory, lights and flux. Whatever is wrong is thrown.
#include "method/registry.h"
#include "run/case_run.h"
#include "run/flux_check.h"

namespace vsglbench {

// One NaN or Inf fails the case and names the pass that first held one; it is never averaged away.
void CaseRun::check_health_of(const Image& image) {
  const Health health = check_health(image);
  const auto bad = health.finite() ? std::nullopt : frame_->results().first_bad_pass();
  const std::string pass = bad ? bad->name() : "";
  HealthReport report = health_report(health, pass);
  if (result_.health) {  // counts add up over seeds
    report.nan += result_.health->nan;
    report.inf += result_.health->inf;
    report.negative += result_.health->negative;
  }
  result_.health = report;
  if (health.finite()) return;
  throw fail(ErrorKind::not_finite,
             "{} NaN and {} Inf pixels, the first at ({}, {}); pass {} is the first to hold one", health.nan,
             health.inf, health.first_bad->x, health.first_bad->y, pass);
}

// The same for the lights and the importance. A light of NaNs need not show in the image: what has no power
// above 0 is not shaded; and from a PDF with a NaN no light is drawn.
void CaseRun::check_lights() {
  const std::optional<BadValues> bad = frame_->results().bad_values();
  if (!bad) return;
  FirstBad first{.pass = bad->pass.name()};
  if (bad->are_lights) {
    first.light = bad->first;
  } else {
    first.buffer = "pdf.rsm";
    first.element = bad->first;
    first.texel = bad->texel;
  }
  result_.health = HealthReport{bad->nan, bad->inf, 0, first};
  throw Error(ErrorKind::not_finite, bad->message());
}

// Lights that no kernel wrote are what another case left there, and what is written past a buffer's end
// another's memory: neither may be scored, however plausible the picture.
void CaseRun::check_memory() {
  if (!frame_->memory_fault().empty()) throw Error(ErrorKind::refused, frame_->memory_fault());
}

// Σ light power / Σ texel power of the last frame, or 0 where the texels have none. The RSM is the same for
// all seeds.
double CaseRun::check_flux() {
  if (!texel_power_) texel_power_ = frame_->results().texel_power();
  const double power = frame_->results().light_power();
  if (!(*texel_power_ > 0)) {
    if (power > 0)
      throw fail(ErrorKind::refused,
                 "power from nothing: the lights carry {:.4g} W, and the RSM's texels reflect none", power);
    return 0;
  }
  // A PDF that is zero everywhere asks for no light.
  const double flux = power / *texel_power_;
  if (flux > 0 || frame_->results().has_importance()) flux_.push_back(flux);
  const std::string fault = flux_fault(find_method(case_.method), flux_);
  if (!fault.empty()) throw Error(ErrorKind::refused, fault);
  return flux;
}

// With check_passes, and in every frame: what any pass wrote, though nothing of it may be left at the end.
void CaseRun::check_passes() {
  const std::optional<BadOutput> bad = frame_->bad_output();
  if (!bad) return;
  FirstBad first{.pass = bad->pass.name(), .buffer = bad->buffer, .field = bad->field};
  (bad->is_light ? first.light : first.element) = bad->element;
  first.texel = bad->texel;
  first.level = bad->level;
  result_.health = HealthReport{bad->nan, bad->inf, 0, first};
  throw Error(ErrorKind::not_finite, bad->message());
}

}  // namespace vsglbench
