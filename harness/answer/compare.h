// Two reports of the same cases: what became faster, slower, better, worse.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "answer/point.h"

namespace vsglbench {

//   faster, better / slower, worse   beyond interval, noise and the least effect
//   same                             the interval lies within noise and least effect
//   ambiguous                        neither can be said
enum class Change { faster, slower, better, worse, same, ambiguous };
std::string_view name(Change change);
bool is_regression(Change change);

struct CompareOptions {
  // Times of other devices are of other things; with this their ratios are compared instead: the new report's
  // times are divided by what all of a scene takes longer in it, the median ratio over the stages of all
  // cases.
  bool ratios = false;
  bool other_device = false;  // compare absolute times of two devices all the same
  bool cases_alone =
      false;  // no passes: `passes` and `method_passes` stay empty, and most of the work is saved
  bool other_settings = false;  // compare cases of one name whose parameters differ all the same
};

// One time of one case, or of many: ratio new / base.
struct TimeChange {
  std::string scene, case_id;   // both empty: over all cases that have it
  std::string method;           // over this method's cases alone; empty: over those of all
  std::string time;             // a pass, or a name of report/noise.h
  Ratio ratio;                  // of medians, bootstrap; over cases, of the mean of log ratios, a pair a case
  std::optional<double> noise;  // the larger A/A floor of the two reports; absent: not known
  double superiority =
      0.5;  // P(a time of one > one of the other), of the slower; over cases: the share of pairs
  Change change = Change::same;
};
// Whether it is ambiguous, and slower is among what it may be.
bool may_be_slower(const TimeChange& time);

// One metric of one case: seeds are pairs.
struct ErrorChange {
  std::string case_id, metric;  // "bias": of the energy, 1 + bias
  double base = 0, now = 0;
  Ratio ratio;
  Change change = Change::same;
};

struct Comparison {
  std::string refusal;  // why nothing was compared; empty: it was
  // Kernels and plugins are byte for byte those of the base, and the driver too: whatever differs in time is
  // noise.
  bool byte_equal = false;
  size_t cases = 0;                         // in both, ok in both
  std::vector<std::string> missing, added;  // ids of the base alone, of the new alone
  std::vector<std::string> broken, mended;  // ok before and not now, and the reverse
  std::vector<TimeChange> passes;           // over all cases, one a pass; by name
  std::vector<TimeChange> method_passes;    // one a pass and method
  std::vector<TimeChange> times;            // method time of every case
  std::vector<ErrorChange> errors;          // every metric of every case
  // 0: no regression; 4: one; 5: refused, or no regression but a pass is ambiguous and may be slower,
  // also in some method by itself.
  int exit_code() const;
};

// Refuses other formula ids and reference hashes, and, unless told to, other devices and other parameters.
Comparison compare_reports(const Report& base, const Report& now, const CompareOptions& options = {});

// What changed, one line each, worst first, and a summary. `markdown`: for a pull request.
std::string comparison_text(const Comparison& comparison, bool markdown);

}  // namespace vsglbench
