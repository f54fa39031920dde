// Operating points: what a case costs and how far it is from the truth, each with its interval.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/metric_cell.h"
#include "report/report.h"

namespace vsglbench {

// Differences below this share are no result, whatever the noise.
inline constexpr double kSmallestEffect = 0.005;

struct Estimate {
  double value = 0;
  Interval ci95;
};

// What an analysis counts. `metric` is a formula's name (image/metrics.h; not bias, which has a sign). `time`
// is a name of report/noise.h; by default what a method answers for, all passes but the raster of the two
// halves.
struct AnswerOptions {
  std::string metric = "smape";
  std::string time = "method";
};

// Of fewer frames a median's interval, between order statistics, says nothing.
inline constexpr size_t kFewFrames = 3;

struct Point {
  const CaseResult* result = nullptr;
  Estimate error;  // in the metric's unit, mean over seeds; the median and range where seeds are heavy-tailed
  std::vector<double> seeds;  // the metric of each seed, in the report's order
  Estimate ms;                // median over frames
  bool heavy_tailed = false;  // of its seeds: `error` is the median and the range
  size_t frames = 0;          // that the time is of
};

// Cases that can be compared: one scene, one reference, hence one idea of what visibility counts.
struct PointGroup {
  std::string scene, reference;  // reference: its hash
  std::string visibility;        // "none" or "full", as the reference has it
  std::vector<Point> points;     // by time
  double noise = 0;              // of this time in this scene, relative: the A/A pair's floor
  bool noise_known = false;      // whether the scene has an A/A pair with this time
  double error_floor = 0;  // what an exact image would show beside the reference's own noise; 0: not known
};

// The groups of a report, in its order. Cases without the time or the metric are left out. Throws
// Error(usage) for a metric or time that is not there.
std::vector<PointGroup> point_groups(const Report& report, const AnswerOptions& options = {});

// The metric of a case over seeds; null where it has none.
const MetricResult* metric_of(const Accuracy& accuracy, const std::string& metric);

// A case's error as points have it: mean and interval over seeds, or median and range where they are
// heavy-tailed, whether or not the report says that they are. Nothing where it has none.
std::optional<Estimate> error_of(const CaseResult& c, const std::string& metric);

// Whether that is the median and the range.
bool is_heavy_tailed(const CaseResult& c, const std::string& metric);
// The metric of each seed, in the report's order.
std::vector<double> seeds_of(const CaseResult& c, const std::string& metric);

// Errors that have a place on an axis: "smape", "rmse", ….
std::vector<std::string> error_names();
// "SMAPE", "RMSE", …, and the unit after a number: " %" or "".
std::string metric_title(const std::string& metric);
std::string metric_unit(const std::string& metric);
// What a time of report/noise.h is, in words: "the whole frame".
std::string time_words(const std::string& time);

// What one point is to another on one axis. Ratios within `margin` of 1 are not worth a word.
enum class Relation { better, worse, same, ambiguous };

// `a` beside `b`: better where it is smaller beyond margin and intervals. Errors are compared seed by seed
// where both have the same seeds: Student's interval of the mean log ratio, which is far narrower than the
// two intervals.
Relation compare_errors(const Point& a, const Point& b, double margin = kSmallestEffect);
Relation compare_costs(const Point& a, const Point& b, double margin);

}  // namespace vsglbench
