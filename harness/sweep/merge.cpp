#include "sweep/merge.h"

#include <algorithm>
#include <unordered_map>

#include "answer/analysis.h"
#include "base/printable.h"
#include "report/accuracy_notes.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr size_t kMostLines = 20;  // of one kind in a text

// The cases' places in the experiment.
using Places = std::unordered_map<std::string, size_t>;

void add(const WallTime& more, WallTime* sum) {
  sum->total_s += more.total_s;
  sum->device_s += more.device_s;
  sum->references_s += more.references_s;
  sum->visibility_s += more.visibility_s;
  sum->compilation_s += more.compilation_s;
  const double rest = sum->total_s - sum->references_s - sum->visibility_s - sum->compilation_s;
  sum->overhead_ratio = sum->device_s > 0 ? std::max(0.0, rest) / sum->device_s : 0;
}

void raise(const std::optional<double>& load, std::optional<double>* most) {
  if (load) *most = std::max(most->value_or(0), *load);
}

// One class while its shards are taken, by number.
class ClassMerge {
 public:
  ClassMerge(const SweepPlan& plan, const Places& places)
      : plan_(plan), places_(places), results_(places.size()) {}

  bool has(size_t shard) const {
    return std::ranges::any_of(out_.shards, [&](const MergedShard& s) { return s.shard == shard; });
  }

  void take(MergedShard shard, Report report) {
    take_head(report);
    for (SceneReport& scene : report.scenes) take_scene(std::move(scene));
    for (AaPair& pair : report.aa)
      if (!pair_of(pair.scene)) out_.report.aa.push_back(std::move(pair));
    for (CaseResult& c : report.cases) {
      if (c.id == plan_.shards[shard.shard].anchor) note_anchor(shard, c);
      std::optional<CaseResult>& place = results_[places_.at(c.id)];
      if (!place) place = std::move(c);
    }
    out_.shards.push_back(std::move(shard));
  }

  void leave(MergedShard duplicate) { out_.duplicates.push_back(std::move(duplicate)); }

  MergedClass finish(const std::vector<std::string>& ids, const fs::path& merged) {
    Report& r = out_.report;
    for (size_t i = 0; i < ids.size(); ++i) {
      if (results_[i])
        r.cases.push_back(std::move(*results_[i]));
      else
        out_.missing.push_back(ids[i]);
    }
    results_.clear();
    r.complete = out_.missing.empty();
    if (!r.complete) r.config["missing"] = out_.missing;
    find_drift();
    for (SceneReport& scene : r.scenes) scene.notes = accuracy_notes(r.cases, scene.name);
    r.analysis = analysis_of(r);
    out_.folder = merged / class_folder(r.device);
    return std::move(out_);
  }

 private:
  // The first shard's machine, the last one's time, the highest load.
  void take_head(const Report& report) {
    Report& r = out_.report;
    if (out_.shards.empty()) {
      r.git = report.git;
      r.kernels = report.kernels;
      r.device = report.device;
      r.host = report.host;
      r.config = plan_.config;
      r.argv = {"vsglbench", "sweep", "merge"};
    }
    r.created = std::max(r.created, report.created);
    raise(report.host.load_at_start, &r.host.load_at_start);
    raise(report.host.load_at_end, &r.host.load_at_end);
    add(report.wall, &r.wall);
  }

  void take_scene(SceneReport scene) {
    const auto known = std::ranges::find(out_.report.scenes, scene.name, &SceneReport::name);
    if (known == out_.report.scenes.end()) return out_.report.scenes.push_back(std::move(scene));
    for (const std::string& warning : scene.warnings)
      if (std::ranges::count(known->warnings, warning) == 0) known->warnings.push_back(warning);
  }

  const AaPair* pair_of(const std::string& scene) const {
    const auto pair = std::ranges::find(out_.report.aa, scene, &AaPair::scene);
    return pair == out_.report.aa.end() ? nullptr : &*pair;
  }

  void note_anchor(const MergedShard& shard, const CaseResult& c) {
    AnchorRun run{shard.shard, shard.host.node.empty() ? shard.host.host : shard.host.node, {}};
    if (c.status == Status::ok && c.frame)
      run.times_ms = (c.frame->method ? *c.frame->method : c.frame->span).samples;
    anchors_[c.scene].first = c.id;
    anchors_[c.scene].second.push_back(std::move(run));
  }

  // A drift beyond the noise is a warning of its scene.
  void find_drift() {
    for (SceneReport& scene : out_.report.scenes) {
      const auto runs = anchors_.find(scene.name);
      if (runs == anchors_.end()) continue;
      std::optional<double> noise;
      if (const AaPair* pair = pair_of(scene.name)) {
        for (const TimeNoise& time : pair->times)
          if (time.column == "method") noise = time.noise_floor;
      }
      auto drift = drift_of(runs->second.second, noise);
      if (!drift) continue;
      drift->scene = scene.name;
      drift->anchor = runs->second.first;
      if (drift->beyond_noise()) scene.warnings.push_back(drift_text(*drift));
      out_.drift.push_back(std::move(*drift));
    }
  }

  const SweepPlan& plan_;
  const Places& places_;
  std::vector<std::optional<CaseResult>> results_;
  std::map<std::string, std::pair<std::string, std::vector<AnchorRun>>> anchors_;  // by scene: id, runs
  MergedClass out_;
};

// At most kMostLines, and how many more there are.
std::string some(const std::vector<std::string>& lines) {
  std::string text;
  for (size_t i = 0; i < std::min(lines.size(), kMostLines); ++i) text += lines[i] + "\n";
  if (lines.size() > kMostLines) text += fmt::format("  and {} more\n", lines.size() - kMostLines);
  return text;
}

std::string class_lines(const MergedClass& c, size_t planned) {
  std::string text = fmt::format("{}: {} of {} cases from {} shards, {} failed{}\n  {}\n",
                                 printable(class_text(c.report.device)), planned - c.missing.size(), planned,
                                 c.shards.size(), c.failed(),
                                 c.missing.empty() ? "" : fmt::format(", {} missing", c.missing.size()),
                                 printable((c.folder / "report.json").string()));
  std::vector<std::string> lines;
  for (const MergedShard& d : c.duplicates)
    lines.push_back(fmt::format("  shard {} was done before: {} is not taken", shard_name(d.shard),
                                d.folder.filename().string()));
  for (const NodeDrift& d : c.drift) lines.push_back("  " + excerpt(d.scene + ": " + drift_text(d), 600));
  return text + some(lines);
}

}  // namespace

size_t MergedClass::failed() const {
  return static_cast<size_t>(std::ranges::count(report.cases, Status::failed, &CaseResult::status));
}

int MergeOutcome::exit_code() const {
  if (!refused.empty() || classes.empty() || !classes.front().missing.empty()) return 5;
  return classes.front().failed() > 0 ? 1 : 0;
}

MergeOutcome merged(const fs::path& sweep) {
  MergeOutcome outcome{status_of(sweep), {}, {}};
  const SweepPlan& plan = outcome.status.plan;
  const std::vector<std::string> ids = plan.case_ids();
  Places places;
  for (size_t i = 0; i < ids.size(); ++i) places[ids[i]] = i;
  MergeChecks checks(plan);
  std::map<std::string, ClassMerge> classes;
  for (const ShardStatus& s : outcome.status.shards) {
    for (const FinishedShard& f : s.folders) {
      const std::string name = "shards/" + f.folder.filename().string();
      try {
        Report report = read_report(f.folder / "report.json");
        if (const std::string problem = checks.problem(s.shard, name, report); !problem.empty()) {
          outcome.refused.push_back(fmt::format("{}: {}", name, problem));
          continue;
        }
        MergedShard shard{s.shard, f.folder, f.record};
        ClassMerge& c = classes.try_emplace(device_class(report.device), plan, places).first->second;
        if (c.has(s.shard))
          c.leave(std::move(shard));
        else
          c.take(std::move(shard), std::move(report));
      } catch (const Error& e) {
        outcome.refused.push_back(e.what());
      }
    }
  }
  if (!outcome.refused.empty()) return outcome;
  for (auto& [name, c] : classes) outcome.classes.push_back(c.finish(ids, sweep / "merged"));
  std::ranges::stable_sort(outcome.classes, {}, [](const MergedClass& c) { return c.missing.size(); });
  return outcome;
}

MergeOutcome merge_sweep(const fs::path& sweep) {
  MergeOutcome outcome = merged(sweep);
  if (outcome.refused.empty()) write_merged(sweep, outcome);
  return outcome;
}

std::string merge_text(const MergeOutcome& outcome) {
  std::vector<std::string> lines;
  for (const std::string& line : outcome.refused) lines.push_back("refused: " + excerpt(line, 600));
  if (!lines.empty())
    return some(lines) +
           "nothing was merged; remove what does not belong here, and vsglbench sweep resubmit\n";
  std::string text;
  for (const MergedClass& c : outcome.classes) text += class_lines(c, outcome.status.plan.case_ids().size());
  if (outcome.classes.size() > 1) text += "devices of different classes are never in one report\n";
  for (const ShardStatus& s : outcome.status.shards)
    if (s.folders.empty())
      lines.push_back(fmt::format("missing: shard {}, {}{}{}", shard_name(s.shard), name(s.state),
                                  s.why.empty() ? "" : ": ", excerpt(s.why, 400)));
  return text + some(lines);
}

}  // namespace vsglbench
