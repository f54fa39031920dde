// The report of a run, `vsglbench.report/1`: what report.schema.json describes, as structures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/json.h"
#include "gpu/pass_id.h"
#include "image/crop.h"
#include "image/metrics.h"
#include "measure/statistics.h"
#include "measure/stopping.h"
#include "measure/verdict.h"
#include "report/coverage.h"

namespace vsglbench {

inline constexpr const char* kReportSchema = "vsglbench.report/1";

struct GitState {
  std::string commit = "unknown";  // 40 hex digits, or "unknown" outside a checkout
  bool dirty = false;              // tracked files differed from the commit when it was built
};

struct DeviceReport {
  std::string name, type;  // type: "cpu", "discrete", "integrated", "virtual", "other"
  std::string driver, driver_version, api;
  uint32_t subgroup_size = 0;
  double timestamp_period_ns = 0;
  std::map<std::string, std::string> settings;  // what steers the driver, such as LP_NATIVE_VECTOR_WIDTH
};

struct HostInfo {
  std::string cpu, os;
  uint32_t cores = 0;
  uint64_t memory_bytes = 0;
  std::optional<double> load_at_start, load_at_end;  // mean number of runnable processes over a minute
};

// What a GPU's clocks did while a scene's frames were timed (gpu/clock_watch.h).
struct ClockReport {
  uint64_t readings = 0;
  uint32_t least_sm_mhz = 0, most_sm_mhz = 0, least_memory_mhz = 0, most_memory_mhz = 0;
  uint32_t most_celsius = 0;
  double most_watts = 0;
  std::vector<std::string> power_states;  // "P0", "P2", …, each once
  std::vector<std::string> throttled_by;  // reasons that held a clock down, each once
};

// The ledger of an effect (scene/effects.h): whether its scene calls for it, and why.
struct EffectReport {
  std::string name, reason;
  bool needed = true;
  std::vector<std::string> passes;  // that it concerns, by their names up to a dot
  // What it costs a frame of the scene's first sound case where it is needed, or would cost where it is
  // skipped; absent: not measured.
  std::optional<Interval> ms_ci95;
  std::optional<double> ms;
  std::optional<int64_t> bytes;  // of images and buffers on the device
};

// Of which frame the ledger's prices are, and what it costs beside the same frame with all effects.
struct EffectPricing {
  std::string case_id;
  uint64_t rounds = 0;  // frames of each kind, in turn
  // Medians from the first to the last timestamp: of the case's frame, and with all effects.
  double span_ms = 0, span_ms_all = 0;
  Ratio ratio;  // of the second to the first
  int64_t bytes = 0, bytes_all = 0;
  double seconds = 0;  // that pricing took
};

struct SceneReport {
  std::string name, hash;
  uint64_t triangles = 0;
  std::vector<std::string> warnings;
  glm::dvec3 light_flux{0};                     // W inside the light's frustum
  double exposure = 1;                          // of the scene's previews
  std::string contact;                          // relative path of the contact sheet; empty: none
  std::vector<std::string> notes;               // accuracy_notes() of its cases
  std::optional<ClockReport> clocks;            // absent where no library tells
  std::vector<EffectReport> effects;            // empty in a report of old
  std::optional<EffectPricing> effects_priced;  // absent: not asked for, or no case was sound
  // The view's (scene/region.h), in pixels of the frame of the scene's first case; absent: it has none, or it
  // holds no pixel.
  std::optional<Crop> region;
};

struct TimeNoise {
  std::string column;      // a name of report/noise.h
  Ratio ratio;             // of the medians, case / twin
  double noise_floor = 0;  // relative
};

// Two measurements of one case of a scene under two names: what they show as a difference is noise.
struct AaPair {
  std::string scene, case_id, twin_id;
  std::vector<TimeNoise> times;  // those in which the device's clock saw time pass
};

struct PassTiming {
  PassId pass;  // by its dotted name in the file: "generate.rsm.sort"
  Summary ms;
};

struct FrameTiming {
  Summary span;                            // ms from the first to the last timestamp of each frame
  double sum_ms = 0, unattributed_ms = 0;  // medians over frames of Σ passes, and of span − Σ passes
  std::optional<Summary> method;           // ms of all passes but gbuffer and rsm: method_time()
  // ms that the host's shadow rays took of each frame, warm-up included, whose lights were not the last
  // one's: the same lights are not traced again. None: no rays.
  std::optional<Summary> host_visibility;
};

// Σ power of the lights / Σ power of the RSM's texels, both as luminance of what is reflected: 1 where a
// light set keeps the flux. Mean over seeds with Student's interval (absent for a single seed), and the least
// and the largest.
struct FluxResult {
  double value = 0;
  std::optional<Interval> ci95;
  double least = 0, most = 0;
};
FluxResult flux_over_seeds(const std::vector<double>& ratios);  // at least one

struct GenerateResult {
  double gbuffer_ms = 0, rsm_ms = 0;  // medians of the two halves
  Summary total;                      // ms of both halves in each frame
  uint64_t lights = 0, empty = 0;     // lights asked for and evaluated; those of them without flux
  std::optional<double> overlap,
      gap;  // of c, how often lights hold a texel: means over the RSM of max(c-1,0), max(1-c,0); absent: not
            // defined
  uint64_t shaders = 0, dispatches = 0, memory_bytes = 0;
  std::optional<FluxResult> flux;  // absent where the texels reflect nothing
};

// What shading reported beside the image, of seed 0; a field is absent where the case does not have it.
struct ShadingResult {
  std::optional<double> clamp_removed;  // luminance that the lights' clamp took away / luminance without it
  std::optional<double>
      cancellation_rate;  // mean share of lights shaded with exact BRDFs [VSGL14 §3.3, Fig. 6]
};

// A metric's mean over seeds. Without a value (a black reference) `undefined` says why.
struct MetricResult {
  std::optional<double> value;
  std::optional<Interval> ci95;  // Student's, over seeds; absent for a single seed
  std::string formula;           // MetricFormula::id; empty: not measured, in a report of old
  std::map<std::string, double> constants;
  std::string undefined;
  // Where the largest seed is more than kHeavyTail times the median, mean and interval mean little; these
  // stand beside them. `bias` is judged by 1 + bias, the image's energy over the reference's, which like the
  // other metrics cannot be below 0.
  bool heavy_tailed = false;
  std::optional<double> median, least, largest;
  bool empty() const { return formula.empty(); }
};
inline constexpr double kHeavyTail = 10;

struct ReferenceInfo {
  std::string hash;
  uint64_t samples = 0;  // paths a pixel
  // What an exact image would show beside the reference's own noise (image/noise_floor.h); smape's in
  // percent.
  double noise_floor_smape = 0;
  std::optional<double> noise_floor_rmse, noise_floor_smape_lit, noise_floor_rrmse, noise_floor_mrse,
      noise_floor_flip;
  // π · area of the scene · mean luminance over the pixels / the light's flux: 1 where all the light that is
  // sent, spread evenly and reflected whole, would give this mean. Below kNearlyBlack next to no light
  // reaches what the camera sees, and relative metrics are undefined.
  std::optional<double> light_ratio;
  std::optional<double> black_share;     // of the pixels, 0 … 1, that it leaves exactly black
  std::optional<uint64_t> batches;       // independent estimates
  std::optional<double> standard_error;  // of its mean over pixels and channels, relative to it
  std::optional<std::string> ended_by;   // "samples", "floor", "time_limit"
};
inline constexpr double kNearlyBlack = 1e-6;

struct Accuracy {
  MetricResult smape, rmse, rrmse, mrse, bias, smape_lit, flip;
  std::optional<double> flip_p99;   // mean over seeds of HDR-FLIP's 99th percentile over pixels
  std::optional<double> lit_share;  // of the pixels, 0 … 1, that smape_lit is over
  std::optional<ErrorQuantiles> quantiles;
  ReferenceInfo reference;
  uint64_t pixels = 0;       // that the camera sees a surface at
  bool below_floor = false;  // smape is not above noise_floor_smape
};

// Over the pixels of the view's region (scene/region.h) that count.
struct RegionErrors {
  double smape = 0, rmse = 0;
  std::optional<double> bias;    // absent where the reference is black there
  std::optional<double> detail;  // as SeedResult's
};

struct SeedResult {
  uint64_t seed = 0;
  Errors errors;
  std::optional<double> flux;  // as FluxResult, of this seed's lights
  // Of them, over the PDF that they were drawn by. Absent where the method defines no shapes, or no kernels,
  // and in reports of old.
  std::optional<Coverage> coverage;
  std::optional<KernelStats> kernels;
  // How much of the reference's detail is kept (image/detail.h: slope / gain); absent where the reference has
  // none, or no halves to tell it by.
  std::optional<double> detail;
  std::optional<double> spikes;             // share of the pixels (image/spikes.h); absent: black reference
  std::optional<double> cancellation_rate;  // as ShadingResult's, of this seed's lights
  std::optional<RegionErrors> region;       // absent where the view has none, or no pixel of it counts
};

// How much a case flickers, over mean(r): the mean over seeds with Student's interval (absent for a single
// seed). `derivative` (image/flicker.h): series[i] is of frame i + 1 against frame i, the mean over seeds,
// and worst_frame the frame of its largest. `static` (image/static_flicker.h): series[i] is how far the image
// of seed i is from those of the others, and worst_frame the seed of its largest; its interval is the
// jackknife's over seeds, absent for two.
struct FlickerSeries {
  double value = 0;
  double p99 = 0;  // 99th percentile over pixels; of `derivative` the mean over seeds
  uint64_t worst_frame = 0;
  std::vector<double> series;
  std::optional<Interval> ci95;
  std::string formula;         // MetricFormula::id
  std::vector<double> values;  // of seed 0, 1, …; of `static`, the jackknife's pseudovalues
};

// The reference's detail that is kept (image/detail.h), as FlickerSeries. The interval is over the method's
// seeds alone: the references' noise, which all cases share, is not in it.
struct DetailResult {
  double value = 0;
  double gain = 0;  // mean(x) / mean(r) over all frames
  std::optional<Interval> ci95;
  std::string formula;
  std::vector<double> values;
};

// Over the first `frames` frames of a scene in motion, each rendered with `seeds` seeds.
struct Temporal {
  FlickerSeries derivative;
  std::optional<FlickerSeries> still;  // "static" in the file; absent for a single seed
  std::optional<DetailResult> detail;  // absent where the references have none
  // What `derivative` is of two images that no method makes, by the same references: of a perfect one, for
  // the references' own noise, and of a black one. A value near the first is noise, and one near the second
  // comes of light that is missing.
  double noise_floor = 0, unlit = 0;
  uint64_t frames = 0, seeds = 0;
  std::vector<std::string> references;  // their hashes, one a frame
};

// Where the first NaN or Inf is: in a pixel of the image or, where that shows none, in a light. When every
// pass was checked: in a light or another element of what a pass wrote.
struct FirstBad {
  std::string pass;  // the first pass whose output held one; empty where that is not known
  std::optional<glm::uvec2> pixel;
  std::optional<uint64_t> light;
  // Below: when every pass was checked.
  std::string buffer, field;  // field of the element: "power", "mean.x"; empty where it is one number
  std::optional<uint64_t> element;
  std::optional<glm::uvec2> texel;  // of the pass's half, where the buffer has an element for each
  std::optional<uint32_t> level;    // of the mip pyramid that it has one for each texel of
};

struct HealthReport {  // counts of pixels or lights, or of elements of FirstBad::buffer
  uint64_t nan = 0, inf = 0, negative = 0;
  std::optional<FirstBad> first_bad;
};

struct Stopping {
  StopReason reason = StopReason::converged;
  uint64_t frames = 0, warmup_frames = 0;
};

enum class Status { ok, failed, skipped };
std::string_view name(Status status);

struct CaseError {
  ErrorKind kind = ErrorKind::case_failed;
  std::string message;
};

// What of a frame is rendered and timed: all of it, or only the two generate passes, on halves and PDFs made
// beforehand; then there is no image and no accuracy.
enum class Measure { frame, generation };
std::string_view name(Measure measure);

// One case. status ok needs everything but error and temporal, or, where only generation is
// measured, passes, frame, generate, stopping and health alone; failed and skipped need `error`, and keep
// whatever was measured before.
struct CaseResult {
  std::string id, scene, method;
  Measure measure = Measure::frame;
  Json parameters = Json::object();
  Status status = Status::ok;
  std::optional<CaseError> error;
  std::vector<PassTiming> passes;
  std::optional<FrameTiming> frame;
  std::optional<GenerateResult> generate;
  std::optional<ShadingResult> shading;
  std::optional<Accuracy> accuracy;
  std::vector<SeedResult> seeds;
  std::optional<Temporal> temporal;
  std::optional<HealthReport> health;
  std::optional<Stopping> stopping;
  std::map<std::string, std::string> images;  // indirect, reference, error, …: paths relative to the report
};

// Where a run's time went, in seconds, added up over its interruptions.
struct WallTime {
  double total_s = 0;
  double device_s = 0;      // frames, from first to last timestamp, warm-up and A/A twin included
  double references_s = 0;  // computing or reading ground truth, and building the ray tracer
  double visibility_s = 0;  // shadow rays of exact visibility
  double compilation_s =
      0;  // opening each case and its first frame, but for the time above: kernels, pipelines
  double overhead_ratio = 0;  // (total − references − visibility − compilation) / device; 0 without frames
};

struct Report {
  std::string created;  // UTC, "2024-05-01T12:00:00Z"
  std::vector<std::string> argv;
  GitState git;
  std::string kernels;  // kernel_sources_hash(): kernels are read when the program runs, not when it is built
  DeviceReport device;
  HostInfo host;
  Json config = Json::object();
  bool complete = false;  // every planned case is in it
  WallTime wall;
  std::vector<SceneReport> scenes;
  std::vector<AaPair> aa;  // one a scene
  std::vector<CaseResult> cases;
  // What the cases show together: fronts, prices, budgets. Made by answer/analysis.h; null: not made, as in
  // reports of old.
  Json analysis;
};

HealthReport health_report(const Health& health, const std::string& first_bad_pass = "");

// Means and intervals over seeds; that of bias is widened in quadrature by the reference's own standard
// error, and is the reference's alone for a single seed; a metric that any seed lacks is undefined. Throws
// Error(case_failed) for no seeds.
Accuracy accuracy_over_seeds(const std::vector<SeedResult>& seeds, const ReferenceInfo& reference);

// Frame by frame, the sum of the passes that generate lights, on both halves or on one; nothing without such
// a pass. Throws std::invalid_argument when their sample counts differ.
std::optional<Summary> generate_time(const std::vector<PassTiming>& passes,
                                     std::optional<Half> half = std::nullopt);

// Frame by frame, the sum of all passes but `gbuffer` and `rsm`: rasterising G-buffer and RSM is the same
// for every method, and a GPU may raster on a few of its units only. Nothing without such a pass; throws as
// above.
std::optional<Summary> method_time(const std::vector<PassTiming>& passes);

// Frame by frame, the sum of a stage's passes. Nothing without such a pass; throws as above.
std::optional<Summary> stage_time(const std::vector<PassTiming>& passes, PassStage stage);

// The same of any passes.
std::optional<Summary> pass_time(const std::vector<PassTiming>& passes,
                                 const std::function<bool(const PassId&)>& wanted);

// Span, Σ passes, the unattributed rest and the method's time from the raw per-frame spans.
FrameTiming frame_timing(std::vector<double> span_ms, const std::vector<PassTiming>& passes);

// "2024-05-01T12:00:00Z".
std::string utc_now();

const Json& report_schema();
Json to_json(const Report& report);
Report report_from_json(const Json& json);  // `json` obeys the schema

// A part of a report as JSON and back, for a process to tell another. T: AaPair, CaseResult, Coverage,
// DeviceReport, KernelStats, SceneReport, TimeNoise or WallTime.
template <class T>
Json part_to_json(const T& part);
template <class T>
T part_from_json(const Json& json);

// Throws Error(output) that names the field when a number is not finite or the report disobeys the schema;
// the file at `path` then keeps its old content. Written atomically.
void write_report(const std::filesystem::path& path, const Report& report);

// For resuming and comparing. Throws Error(config) with file and line when it is damaged or disobeys the
// schema.
Report read_report(const std::filesystem::path& path);
// The same of a report's folder, or of its file.
Report read_report_at(const std::filesystem::path& file_or_folder);
std::filesystem::path report_file(const std::filesystem::path& file_or_folder);  // which of both

}  // namespace vsglbench
