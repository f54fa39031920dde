#include "reference/reference.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "image/noise_floor.h"
#include "reference/accumulator.h"
#include "reference/noise.h"
#include "reference/strategies.h"

namespace vsglbench {
namespace {

// Raise it whenever the same parameters would give another image.
constexpr uint32_t kAlgorithmVersion = 2;
constexpr uint32_t kExploration = ~0u;  // the batch before the first, which only teaches the light guide
constexpr uint32_t kLessons = 4;        // batches before that one, which teach a guidance
constexpr uint32_t kPhotonChunk = 8192, kChunksARound = 64;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void check_parameters(const ReferenceParameters& p) {
  if (p.width == 0 || p.height == 0 || uint64_t(p.width) * p.height > (1u << 28)) {
    throw fail(ErrorKind::config,
               "reference: a {}x{} image; both sides must be at least 1, and at most 2^28 pixels", p.width,
               p.height);
  }
  if (p.samples == 0 || p.samples > (1u << 24)) {
    throw fail(ErrorKind::config, "reference: {} samples a pixel; give 1 to 2^24", p.samples);
  }
  if (p.batches < 2 || p.batches % 2 != 0) {
    throw fail(ErrorKind::config, "reference: {} batches; give an even number, at least 2", p.batches);
  }
  if (!(p.photons_a_sample >= 0 && p.photons_a_sample <= 1024)) {
    throw fail(ErrorKind::config, "reference: {} photons a sample; give 0 (automatic) to 1024",
               p.photons_a_sample);
  }
  if (!(p.floor >= 0 && p.floor < 200)) {
    throw fail(ErrorKind::config, "reference: a noise floor of {} %; give 0 (none) to under 200", p.floor);
  }
  if ((p.strategies & strategy_all) == 0 || p.strategies > strategy_all) {
    throw fail(ErrorKind::config, "reference: strategies {}; give a sum of 1, 2 and 4", p.strategies);
  }
}

// At least those asked for; more where the largest pool would serve too many samples.
uint32_t planned_batches(const ReferenceParameters& p) {
  const double most = Strategies::connections_a_point * std::exp2(2 * Strategies::most_pool_bits);
  const double needed = double(p.width) * p.height * p.samples / most;
  return std::max(p.batches, 2 * static_cast<uint32_t>(std::ceil(needed / 2)));
}

// Samples of one batch; strategies that are off take none, and so weigh nothing.
SampleCounts sample_counts(const ReferenceParameters& p, uint32_t batches, double photons_a_sample) {
  const uint32_t a_pixel = (p.samples + batches - 1) / batches;
  const double photons = std::ceil(photons_a_sample * a_pixel * p.width * p.height);
  SampleCounts counts;
  if (p.strategies & strategy_light) counts.light = a_pixel;
  if (p.strategies & strategy_receiver) counts.receiver = a_pixel;
  if (p.strategies & strategy_emitter) counts.photons = static_cast<uint32_t>(std::min(photons, 0x1p31));
  return counts;
}

// One computation: its pixels, its threads' rays, its batches.
class Run {
 public:
  Run(const Tracer& tracer, const ReferenceParameters& parameters, std::vector<RayLog>* logs,
      const Guidance* guidance);
  ReferenceResult compute();
  Guidance learn();

 private:
  void trace_pool(uint32_t batch);
  void choose_counts();
  void trace_footprints();
  void learn_guide();
  void explore();
  void gather(uint32_t batch, bool teach);
  void emit(uint32_t batch);
  void accumulate(uint32_t batch);
  std::optional<ReferenceEnd> ended(uint32_t batches);
  double noise_floor(uint32_t batches) const;
  void check_finite(const Image& mean) const;
  ReferenceResult result(uint32_t batches, ReferenceEnd ended_by) const;

  const Tracer& tracer_;
  const ReferenceParameters& p_;
  const Guidance* guidance_;  // nothing: it teaches itself
  double sharp_ = 0;
  uint32_t batches_;  // planned; more when they miss the floor
  const Clock::time_point start_ = Clock::now();
  SampleCounts counts_;
  ImagePlane camera_;
  std::vector<RayStream> streams_;  // one a thread
  std::vector<Footprint> footprints_;
  Strategies strategies_;
  std::vector<glm::vec3> estimate_;         // of this batch
  std::vector<std::vector<Splat>> splats_;  // of this round, one a chunk
  BatchAccumulator sums_;
  std::vector<double> means_;  // of the image, one a batch
  std::vector<uint8_t> mask_;
  Progress progress_;
};

Run::Run(const Tracer& tracer, const ReferenceParameters& parameters, std::vector<RayLog>* logs,
         const Guidance* guidance)
    : tracer_(tracer),
      p_(parameters),
      guidance_(guidance),
      batches_(planned_batches(parameters)),
      camera_(camera_view(tracer.scene().camera, parameters.width, parameters.height)),
      footprints_(size_t(parameters.width) * parameters.height),
      strategies_(tracer, camera_, parameters.width, parameters.height, parameters, footprints_),
      estimate_(footprints_.size()),
      splats_(kChunksARound),
      sums_(parameters.width, parameters.height),
      progress_("reference of " + tracer.scene().name, uint64_t(batches_) + 1) {
  const unsigned threads = thread_count(parameters.threads);
  if (logs) logs->assign(threads, {});
  for (unsigned t = 0; t < threads; ++t) streams_.emplace_back(tracer, logs ? &(*logs)[t] : nullptr);
}

void Run::trace_pool(uint32_t batch) {
  parallel_for(strategies_.pool_size(), p_.threads, [&](uint64_t row, unsigned thread) {
    strategies_.trace_pool_row(static_cast<uint32_t>(row), batch, streams_[thread]);
  });
}

void Run::choose_counts() {
  trace_pool(kExploration);
  const std::optional<double> sharp = strategies_.aim_photons();
  if (!sharp) {
    throw fail(ErrorKind::case_failed, "{}: the light sees no surface; check its position and direction",
               tracer_.scene().name);
  }
  sharp_ = guidance_ ? guidance_->sharp : *sharp;
  if (guidance_) strategies_.follow(*guidance_);
  counts_ =
      sample_counts(p_, batches_, p_.photons_a_sample > 0 ? p_.photons_a_sample : 1.0 / 32 + sharp_ / 4);
  strategies_.set_counts(counts_);
}

void Run::trace_footprints() {
  parallel_for(p_.height, p_.threads, [&](uint64_t y, unsigned thread) {
    for (uint32_t x = 0; x < p_.width; ++x) {
      Footprint& footprint = footprints_[y * p_.width + x];
      footprint = trace_footprint(camera_, p_.width, p_.height, x, uint32_t(y), p_.seed, streams_[thread]);
      footprint.tile = strategies_.guide().tile(x, uint32_t(y));
    }
  });
  mask_.resize(footprints_.size());
  std::transform(footprints_.begin(), footprints_.end(), mask_.begin(),
                 [](const Footprint& f) { return f.valid; });
  if (std::any_of(mask_.begin(), mask_.end(), [](uint8_t seen) { return seen; })) return;
  throw fail(ErrorKind::case_failed, "{}: the camera sees no surface; check its position and direction",
             tracer_.scene().name);
}

void Run::gather(uint32_t batch, bool teach) {
  parallel_for(strategies_.guide().tiles(), p_.threads, [&](uint64_t tile, unsigned thread) {
    strategies_.gather(static_cast<uint32_t>(tile), batch, teach, streams_[thread], estimate_.data());
  });
  progress_.advance();
}

void Run::learn_guide() {
  parallel_for(strategies_.guide().tiles(), p_.threads,
               [&](uint64_t tile, unsigned) { strategies_.guide().learn(static_cast<uint32_t>(tile)); });
}

void Run::explore() {
  trace_pool(kExploration);
  gather(kExploration, true);
  learn_guide();
}

// Chunks of a round run on any thread; their splats are added in order, so that sums round alike.
void Run::emit(uint32_t batch) {
  for (uint64_t first = 0; first < counts_.photons; first += uint64_t(kChunksARound) * kPhotonChunk) {
    const uint64_t left = counts_.photons - first;
    const uint64_t chunks = std::min<uint64_t>((left + kPhotonChunk - 1) / kPhotonChunk, kChunksARound);
    parallel_for(chunks, p_.threads, [&](uint64_t chunk, unsigned thread) {
      const uint64_t begin = first + chunk * kPhotonChunk;
      const uint64_t end = std::min<uint64_t>(begin + kPhotonChunk, counts_.photons);
      splats_[chunk].clear();
      strategies_.emit(static_cast<uint32_t>(begin), static_cast<uint32_t>(end), batch, streams_[thread],
                       &splats_[chunk]);
    });
    for (uint64_t chunk = 0; chunk < chunks; ++chunk) {
      for (const Splat& splat : splats_[chunk]) estimate_[splat.pixel] += splat.radiance;
    }
  }
}

void Run::accumulate(uint32_t batch) {
  parallel_for(p_.height, p_.threads, [&](uint64_t y, unsigned) {
    for (size_t i = y * p_.width; i < (y + 1) * p_.width; ++i) sums_.add(i, batch, estimate_[i]);
  });
  means_.push_back(mean_of_batch(estimate_, footprints_));
}

double Run::noise_floor(uint32_t batches) const {
  return noise_floor_of(sums_.half(0, batches), sums_.half(1, batches), sums_.mean(batches), mask_).smape;
}

// Looks at the floor when the planned batches are done, then after every eighth more: a look at each would
// prefer the lucky ones.
std::optional<ReferenceEnd> Run::ended(uint32_t batches) {
  if (batches == batches_) {
    const double samples = double(batches) * std::max(counts_.light, counts_.receiver);
    if (p_.floor == 0 || samples >= 0x1p24) return ReferenceEnd::samples;
    if (noise_floor(batches) <= p_.floor) return ReferenceEnd::floor;
    batches_ += std::max(2u, batches / 16 * 2);
  }
  const bool late = p_.time_limit > 0 && batches % 2 == 0 && seconds_since(start_) > p_.time_limit;
  return late ? std::optional(ReferenceEnd::time_limit) : std::nullopt;
}

// A NaN or Inf is never averaged away.
void Run::check_finite(const Image& mean) const {
  const Health health = check_health(mean);
  if (health.finite()) return;
  throw fail(ErrorKind::case_failed,
             "{}: the reference has {} NaN and {} infinite pixels, the first at ({}, {})",
             tracer_.scene().name, health.nan, health.inf, health.first_bad->x, health.first_bad->y);
}

ReferenceResult Run::result(uint32_t batches, ReferenceEnd ended_by) const {
  ReferenceResult r;
  r.mean = sums_.mean(batches);
  r.variance = sums_.variance_of_mean(batches);
  r.half[0] = sums_.half(0, batches);
  r.half[1] = sums_.half(1, batches);
  check_finite(r.mean);
  r.mask = mask_;
  r.noise_floor_smape = noise_floor(batches);
  r.standard_error = relative_standard_error(means_);
  r.ended_by = ended_by;
  r.batches = batches;
  r.samples = batches * std::max(counts_.light, counts_.receiver);
  r.photons = uint64_t(batches) * counts_.photons;
  for (const RayStream& stream : streams_) r.rays += stream.rays();
  r.seconds = seconds_since(start_);
  r.hash = reference_hash(tracer_.scene(), p_, guidance_ ? guidance_->taught_by : "");
  return r;
}

// Batches are uncorrelated with one mean, whatever the guide has learned from earlier ones; so their scatter
// gives the variance of their mean without bias.
ReferenceResult Run::compute() {
  choose_counts();
  trace_footprints();
  if (!guidance_) explore();
  uint32_t batch = 0;
  std::optional<ReferenceEnd> end;
  while (!end) {
    trace_pool(batch);
    gather(batch, !guidance_);
    emit(batch);
    accumulate(batch);
    ++batch;
    if (!guidance_ && std::has_single_bit(batch)) learn_guide();  // after 1, 2, 4, 8 ... of them
    end = ended(batch);
  }
  return result(batch, *end);
}

Guidance Run::learn() {
  choose_counts();
  trace_footprints();
  explore();
  for (uint32_t lesson = 1; lesson <= kLessons; ++lesson) {
    trace_pool(kExploration - lesson);
    gather(kExploration - lesson, true);
    if (std::has_single_bit(lesson)) learn_guide();
  }
  return {tracer_.scene().hash, strategies_.guide(), strategies_.photon_guide(), sharp_};
}

}  // namespace

std::string reference_hash(const Scene& scene, const ReferenceParameters& p, const std::string& taught_by) {
  Hasher hasher;
  hasher.text("vsglbench.reference").value(kAlgorithmVersion).text(scene.hash);
  hasher.value(p.width)
      .value(p.height)
      .value(p.samples)
      .value(p.batches)
      .value(p.photons_a_sample)
      .value(p.floor);
  hasher.value(p.seed).value(p.occlusion).value(p.strategies).value(p.shading_normals).value(p.time_limit);
  if (!taught_by.empty()) hasher.text("taught by").text(taught_by);
  return hasher.hex();
}

ReferenceResult compute_reference(const Tracer& tracer, const ReferenceParameters& parameters,
                                  std::vector<RayLog>* logs, const Guidance* guidance) {
  check_parameters(parameters);
  return Run(tracer, parameters, logs, guidance).compute();
}

Guidance learn_guidance(const Tracer& tracer, const ReferenceParameters& parameters) {
  check_parameters(parameters);
  return Run(tracer, parameters, nullptr, nullptr).learn();
}

ReferenceResult compute_reference(const Scene& scene, const ReferenceParameters& parameters) {
  check_parameters(parameters);
  return compute_reference(Tracer(scene), parameters);
}

}  // namespace vsglbench
