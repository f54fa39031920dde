#include "run/case_run.h"

#include <algorithm>

#include "measure/stopwatch.h"

namespace vsglbench {

std::string error_kind(const Error& error) {
  return error.exit_code() == 1 ? "case_failed" : error.exit_code() == 3 ? "device" : "input";
}

CaseRun::CaseRun(const Case& description, const Config& config, const ReferenceResult* reference)
    : case_(description), config_(config), reference_(reference) {
  result_.id = case_.id;
  result_.scene = case_.scene;
  result_.method = case_.method;
  result_.parameters = case_.parameters;
}

void CaseRun::fail_with(const std::string& kind, const std::string& message) {
  result_.status = kind == "asset_missing" ? Status::skipped : Status::failed;
  result_.error = CaseError{kind, message};
  frame_.reset();
}

void CaseRun::fail_with(const Error& error) { fail_with(error_kind(error), error.what()); }

void CaseRun::open(Stage& stage, ExactVisibility exact) {
  if (failed()) return;
  try {
    frame_ = std::make_unique<Frame>(stage, find_method(case_.method), case_.method_parameters, case_.frame,
                                     std::move(exact));
  } catch (const Error& e) {
    fail_with(e);
  }
}

bool CaseRun::randomised() const { return find_method(case_.method).takes_light_count; }

uint64_t CaseRun::frames_left() const {
  if (finished()) return 0;
  const uint64_t wanted = std::max<uint64_t>(config_.timing.min_samples, randomised() ? config_.seeds : 1);
  return wanted > span_ms_.size() ? wanted - span_ms_.size() : 1;
}

void CaseRun::warm_up(WallTime* wall) {
  if (failed()) return;
  try {
    const Stopwatch watch;
    const FrameTimes times = frame_->render(0);
    wall->device += times.span_ms * 1e-3;
    ++warmups_;
  } catch (const Error& e) {
    fail_with(e);
  }
}

void CaseRun::step(WallTime* wall) {
  if (finished()) return;
  try {
    const Stopwatch watch;
    const size_t seeds = randomised() ? config_.seeds : 1;
    const bool scored = seeds_.size() < seeds;
    const uint32_t seed = scored ? static_cast<uint32_t>(seeds_.size()) : 0;
    const FrameTimes times = frame_->render(seed);
    wall->device += times.span_ms * 1e-3;
    record(times);
    if (scored) {
      const Image image = frame_->indirect();
      if (mask_.empty()) {
        mask_ = frame_->surface_mask();
        for (size_t i = 0; i < mask_.size(); ++i) mask_[i] = mask_[i] && reference_->mask[i];
      }
      if (!check(image)) return;
      seeds_.push_back({seed, measure_errors(image, reference_->mean, mask_)});
      if (seed == 0) {
        describe_lights();
        result_.accuracy.emplace().quantiles = error_quantiles(image, reference_->mean, mask_);
        first_image_ = image;
      }
    }
    elapsed_s_ += watch.seconds();
    if (seeds_.size() < seeds) return;
    reason_ = should_stop(config_.timing, span_ms_, elapsed_s_);
    finished_ = reason_.has_value();
  } catch (const Error& e) {
    fail_with(e);
  }
}

// One NaN or Inf fails the case and names the pass that first held one; it is never averaged away.
bool CaseRun::check(const Image& image) {
  const Health health = check_health(image);
  HealthReport report = health_report(health);
  if (result_.health) {  // counts add up over seeds
    report.nan += result_.health->nan;
    report.inf += result_.health->inf;
    report.negative += result_.health->negative;
  }
  result_.health = report;
  if (health.finite()) return true;
  const std::string pass = frame_->first_bad_pass();
  result_.health = health_report(health, pass);
  fail_with("not_finite", fmt::format("{} NaN and {} Inf pixels, the first at ({}, {}); pass {} is the first to hold one",
                                      health.nan, health.inf, health.first_bad->x, health.first_bad->y, pass));
  return false;
}

void CaseRun::record(const FrameTimes& times) {
  if (pass_names_.empty()) {
    for (const auto& pass : times.passes) pass_names_.push_back(pass.name);
    pass_ms_.resize(pass_names_.size());
  }
  for (size_t i = 0; i < pass_names_.size(); ++i) pass_ms_[i].push_back(times.passes.at(i).ms);
  span_ms_.push_back(times.span_ms);
  auto& generate = result_.generate ? *result_.generate : result_.generate.emplace();
  generate.dispatches = times.generate_dispatches;
}

void CaseRun::describe_lights() {
  GenerateResult& generate = *result_.generate;
  generate.lights = frame_->light_count();
  const auto dark = [](const auto& lights) {
    return static_cast<uint64_t>(std::count_if(lights.begin(), lights.end(), [](const auto& l) { return !(l.power > 0); }));
  };
  generate.empty = dark(frame_->vsgls()) + dark(frame_->vpls());
  generate.shaders = frame_->method_kernels();
  generate.memory_bytes = frame_->method_bytes();
  if (generate.empty == generate.lights) {
    throw fail(ErrorKind::case_failed,
               "no light carries power: the primary light sees no surface, or no surface that the camera's importance reaches");
  }
}

CaseResult CaseRun::result() {
  for (size_t i = 0; i < pass_names_.size(); ++i) result_.passes.push_back({pass_names_[i], summarize(pass_ms_[i])});
  if (!span_ms_.empty()) {
    result_.frame = frame_timing(span_ms_, result_.passes);
    GenerateResult& generate = *result_.generate;
    const auto gbuffer = sum_of_passes(result_.passes, {"generate.gbuffer."});
    const auto rsm = sum_of_passes(result_.passes, {"generate.rsm."});
    generate.gbuffer_ms = gbuffer ? gbuffer->median : 0;
    generate.rsm_ms = rsm ? rsm->median : 0;
    generate.total = *sum_of_passes(result_.passes, {"generate."});
  }
  if (!seeds_.empty()) {
    const ReferenceInfo info{reference_->hash, reference_->samples, reference_->noise_floor_smape, {}};
    const auto quantiles = result_.accuracy->quantiles;
    result_.accuracy = accuracy_over_seeds(seeds_, info);
    result_.accuracy->quantiles = quantiles;
    result_.seeds = seeds_;
  }
  if (reason_) result_.stopping = Stopping{*reason_, span_ms_.size(), warmups_};
  return result_;
}

}  // namespace vsglbench
