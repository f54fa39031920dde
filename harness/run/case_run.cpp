#include "run/case_run.h"

#include <algorithm>

#include "base/log.h"
#include "lights/coverage.h"
#include "measure/stopwatch.h"
#include "method/registry.h"
#include "run/flux_check.h"

namespace vsglbench {
namespace {

void state_exposures(const FlipExposures& exposures, MetricResult* flip) {
  flip->constants["start_exposure"] = exposures.start;
  flip->constants["stop_exposure"] = exposures.stop;
  flip->constants["exposures"] = exposures.count;
}

}  // namespace

std::string one_line(std::string text) {
  constexpr size_t kMostCharacters = 500;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  size_t characters = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool starts_character = (byte & 0xC0) != 0x80;  // UTF-8
    if (starts_character && ++characters > kMostCharacters) return text.substr(0, i) + "…";
    if (byte < 0x20 || byte == 0x7F) text[i] = ' ';
  }
  return text;
}

CaseRun::CaseRun(const Case& description, const Config& config, WallTime* wall, Announce announce,
                 CaseProgress progress)
    : case_(description), config_(config), wall_(wall), announce_(std::move(announce)) {
  scored_ = progress.scored.has_value();
  if (scored_) result_ = std::move(progress.scored->result);
  if (scored_) rays_ms_ = std::move(progress.scored->rays_ms);
  result_.id = case_.id;
  result_.scene = case_.scene;
  result_.method = case_.method;
  result_.measure = config_.measure;
  result_.parameters = case_.parameters;
  const auto failed = [this](ErrorKind kind, const std::string& message) { fail_with(kind, message); };
  const auto take = [&] {
    for (const FrameTimes& frame : progress.frames) record(frame, 1e-3 * frame.span_ms);
  };
  guarded(take, failed);
}

void CaseRun::fail_with(ErrorKind kind, const std::string& message) {
  if (failed()) return;
  result_.status = kind == ErrorKind::asset_missing ? Status::skipped : Status::failed;
  result_.error = CaseError{kind, message};
  frame_.reset();
}

void CaseRun::fail_in_the_end(ErrorKind kind, const std::string& message) {
  if (!result_.error) result_.error = CaseError{kind, message};
}

template <class Action>
void CaseRun::attempt(const std::string& name, const Action& action) {
  if (finished()) return;
  action_ = name;
  const auto announced = [&] {
    announce(true);
    action();
  };
  guarded(announced, [this](ErrorKind kind, const std::string& message) { fail_with(kind, message); });
}

void CaseRun::announce(bool limited) const {
  if (announce_) announce_({case_.id, action_, limited});
}

void CaseRun::conclude() {
  concluded_ = true;
  first_image_.reset();
  cancellation_.reset();
  scoring_.reset();
  if (!frame_) return;
  action_ = "closing";
  announce(true);
  frame_.reset();
}

void CaseRun::open(Stage& stage, CaseInput input) {
  const Stopwatch watch;
  input_ = std::move(input);
  attempt("opening", [&] {
    frame_ = std::make_unique<Frame>(stage, load_method(case_.method, stage.device.info()),
                                     case_.method_parameters, case_.frame, input_.exact);
  });
  wall_->compilation_s += watch.seconds();
}

// A method that does not draw its lights gives the same image for every seed. Generation is looked at once.
uint32_t CaseRun::seeds() const {
  if (config_.measure == Measure::generation) return 1;
  return find_method(case_.method).takes_light_count ? config_.seeds : 1;
}

uint64_t CaseRun::frames_left() const {
  if (finished()) return 0;
  const uint64_t wanted = config_.timing.min_samples;
  return wanted > span_ms_.size() ? wanted - span_ms_.size() : 1;
}

// The first frame compiles kernels: what it takes beyond the device's and the ray tracer's time is
// compilation.
template <class Render>
FrameTimes CaseRun::run_frame(bool watched, const Render& render) {
  const double visibility_before = wall_->visibility_s;
  const Stopwatch watch;
  FrameTimes times = render();
  const double device_s = times.span_ms * 1e-3, visibility_s = wall_->visibility_s - visibility_before;
  wall_->device_s += device_s;
  if (visibility_s > 0) rays_ms_.push_back(1e3 * visibility_s);
  if (!rendered_) {
    wall_->compilation_s += std::max(0.0, watch.seconds() - device_s - visibility_s);
  }
  rendered_ = true;
  check_passes();
  if (watched) check_memory();
  return times;
}

FrameTimes CaseRun::render(uint32_t seed, bool watched) {
  return run_frame(watched, [&] {
    return config_.measure == Measure::generation ? frame_->generate_only(seed, *input_.pdfs, watched)
                                                  : frame_->render(seed, watched);
  });
}

// Seed 0 is the last, so that the frames that are timed find its shadow rays already traced.
void CaseRun::look() {
  if (scored_) return;
  for (uint32_t seed = seeds(); seed-- > 0;) attempt(fmt::format("seed {}", seed), [&] { look_at(seed); });
}

void CaseRun::look_at(uint32_t seed) {
  render(seed, true);
  const bool has_image = config_.measure == Measure::frame;
  if (has_image && !scoring_) start_scoring();
  Image image;
  if (has_image) image = frame_->results().indirect();
  if (has_image) check_health_of(image);
  if (!has_image) result_.health.emplace();
  check_lights();
  const double flux = check_flux();
  // Only what shades with exact BRDFs has more to say of other seeds than of the first.
  ShadingNotes notes;
  if (has_image && (seed == 0 || frame_->results().reduces_bias())) notes = frame_->results().shading_notes();
  SeedResult result = seed_of(seed);
  if (*texel_power_ > 0) result.flux = flux;
  result.cancellation_rate = notes.cancellation_rate;
  if (seed == 0) describe_lights(result.coverage);
  if (has_image) result_.seeds.push_back(std::move(result));
  if (seed == 0 && has_image) describe_shading(std::move(notes));
  if (seed == 0 && has_image) first_image_ = image;
  if (has_image) scoring_->add(seed, std::move(image));
}

void CaseRun::start_scoring() {
  const auto crop =
      input_.region ? pixels_of(*input_.region, case_.frame.width, case_.frame.height) : std::nullopt;
  scoring_ = std::make_unique<Scoring>(*input_.reference, make_mask(*input_.reference), crop, input_.flip);
}

void CaseRun::settle() {
  if (scored_ || failed()) return;
  const auto failed = [this](ErrorKind kind, const std::string& message) { fail_with(kind, message); };
  const auto take = [this] {
    if (!flux_.empty()) result_.generate->flux = flux_over_seeds(flux_);
    if (!scoring_) return;
    std::ranges::sort(result_.seeds, {}, &SeedResult::seed);
    const std::vector<SeedScore> scores = scoring_->collect();
    for (size_t i = 0; i < scores.size(); ++i) {
      SeedResult& seed = result_.seeds[i];
      seed.errors = scores[i].errors;
      seed.detail = scores[i].detail;
      seed.spikes = scores[i].spikes;
      seed.region = scores[i].region;
    }
    result_.accuracy = accuracy_over_seeds(result_.seeds, *input_.reference_info);
    if (scoring_->flip_exposures()) state_exposures(*scoring_->flip_exposures(), &result_.accuracy->flip);
    result_.accuracy->quantiles = scores.front().quantiles;
  };
  guarded(take, failed);
  scored_ = !this->failed();
}

void CaseRun::warm_up() {
  attempt("warm-up", [&] {
    render(0);
    ++warmups_;
  });
}

void CaseRun::step() {
  attempt(fmt::format("frame {}", span_ms_.size() + 1), [&] {
    const Stopwatch watch;
    last_ = render(0);
    record(last_, watch.seconds());
  });
}

void CaseRun::follow(const Moved& moved) {
  if (frame_) frame_->follow(moved);
}

// Rays of frames in motion are not those of the frames that are timed.
std::optional<CaseRun::Look> CaseRun::look_in_motion(uint32_t frame, uint32_t seed,
                                                     const ReferenceResult& reference, Carried* carried) {
  std::optional<Look> look;
  attempt(fmt::format("frame {} in motion, seed {}", frame, seed), [&] {
    const size_t rays = rays_ms_.size();
    const uint32_t own = seed_in_frame(seed, frame, case_.frame.lattice);
    run_frame(true, [&] { return frame_->render_in_motion(own, carried); });
    rays_ms_.resize(rays);
    Image image = frame_->results().indirect();
    if (!check_health(image).finite()) check_health_of(image);
    check_lights();
    look = Look{std::move(image), make_mask(reference)};
  });
  return look;
}

Mask CaseRun::make_mask(const ReferenceResult& reference) const {
  Mask mask = frame_->results().surface_mask();
  for (size_t i = 0; i < mask.size(); ++i) mask[i] = mask[i] && reference.mask[i];
  return mask;
}

void CaseRun::record(const FrameTimes& times, double elapsed_s) {
  if (passes_.empty()) {
    for (const PassTime& time : times.passes) passes_.push_back(time.pass);
    pass_ms_.resize(passes_.size());
  }
  if (!std::ranges::equal(passes_, times.passes, {}, {}, &PassTime::pass)) {
    throw fail(ErrorKind::case_failed, "frame {} had other passes than the first", span_ms_.size());
  }
  for (size_t i = 0; i < passes_.size(); ++i) pass_ms_[i].push_back(times.passes[i].ms);
  span_ms_.push_back(times.span_ms);
  if (!result_.generate) result_.generate.emplace();
  result_.generate->dispatches = times.generate_dispatches;
  elapsed_s_ += elapsed_s;
  reason_ = should_stop(config_.timing, span_ms_, elapsed_s_);
  finished_ = reason_.has_value();
}

// How the last frame's lights lie on the RSM, beneath the PDF that they were drawn by: in a whole frame its
// own. Reading both back and two passes over the texels, some milliseconds for 512², beside an image of each
// seed.
SeedResult CaseRun::seed_of(uint32_t seed) const {
  SeedResult result{.seed = seed};
  const uint32_t side = case_.frame.rsm;
  const RsmShapes shapes = read_shapes(frame_->light_shapes(), frame_->light_count(), uint64_t(side) * side);
  const bool own_pdf = config_.measure == Measure::frame;
  const std::vector<float> pdf = own_pdf ? frame_->results().importance() : std::vector<float>();
  result.coverage = coverage_of(shapes, frame_->light_count(), side, side, pdf);
  result.kernels = kernels_of(shapes, side, side, pdf);
  return result;
}

void CaseRun::describe_lights(const std::optional<Coverage>& coverage) {
  GenerateResult& generate = result_.generate.emplace();
  generate.lights = frame_->light_count();
  generate.empty = count_without_power(frame_->results().lights());
  generate.shaders = frame_->method_kernels();
  generate.memory_bytes = frame_->method_bytes();
  if (coverage) {
    generate.overlap = coverage->overlap;
    generate.gap = coverage->gap;
  }
  // Black, and measured as such: that the reference is not is the method's error.
  if (generate.empty == generate.lights) {
    log_warning("{}: no light carries power; the method found no texel that matters to the camera", case_.id);
  }
}

void CaseRun::describe_shading(ShadingNotes notes) {
  if (notes.clamp_removed || notes.cancellation_rate)
    result_.shading = ShadingResult{notes.clamp_removed, notes.cancellation_rate};
  cancellation_ = std::move(notes.cancellation);
}

CaseResult CaseRun::result() const {
  CaseResult r = result_;
  if (r.status == Status::ok && r.error) r.status = Status::failed;
  for (size_t i = 0; i < passes_.size(); ++i) r.passes.push_back({passes_[i], summarize(pass_ms_[i])});
  if (span_ms_.empty()) r.generate.reset();
  if (!span_ms_.empty()) {
    r.frame = frame_timing(span_ms_, r.passes);
    if (!rays_ms_.empty()) r.frame->host_visibility = summarize(rays_ms_);
    const auto total = generate_time(r.passes);
    const auto gbuffer = generate_time(r.passes, Half::gbuffer), rsm = generate_time(r.passes, Half::rsm);
    r.generate->total = total ? *total : summarize(std::vector<double>(span_ms_.size(), 0));
    r.generate->gbuffer_ms = gbuffer ? gbuffer->median : 0;
    r.generate->rsm_ms = rsm ? rsm->median : 0;
  }
  if (reason_) r.stopping = Stopping{*reason_, span_ms_.size(), warmups_};
  return r;
}

}  // namespace vsglbench
