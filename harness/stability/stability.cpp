#include "stability/stability.h"

#include <algorithm>

#include "base/log.h"
#include "base/nearest.h"
#include "base/supervise.h"
#include "method/registry.h"
#include "shaders/sg_exact.h"
#include "stability/trial.h"

namespace vsglbench {
namespace {

// One case with one method.
struct Job {
  const HardCase* hard_case;
  const StabilityRow* row;
};

void add_choices(const MethodInfo& method, std::vector<StabilityRow>* rows) {
  rows->push_back({method.name, method.name, resolve_parameters(method, Json::object())});
  for (const ParameterInfo& p : method.parameters) {
    for (const std::string& choice : p.choices) {
      if (choice == p.default_value) continue;
      rows->push_back({fmt::format("{} {}={}", method.name, p.name, choice), method.name,
                       resolve_parameters(method, {{p.name, choice}})});
    }
  }
}

std::vector<Job> jobs_of(const std::vector<StabilityRow>& rows, const std::vector<std::string>& cases) {
  const auto known = stability_cases();
  for (const std::string& name : cases) {
    if (std::ranges::count(known, name) == 0)
      throw fail(ErrorKind::usage, "no case '{}'{}", name, suggestion(name, known));
  }
  std::vector<Job> jobs;
  for (const HardCase& c : hard_cases()) {
    if (!cases.empty() && std::ranges::count(cases, c.name) == 0) continue;
    for (const StabilityRow& row : rows) jobs.push_back({&c, &row});
  }
  return jobs;
}

std::vector<std::string> models_of(const std::vector<std::string>& diffuse) {
  const auto& known = exact::diffuse_model_names();
  for (const std::string& name : diffuse) {
    if (std::ranges::count(known, name) == 0)
      throw fail(ErrorKind::usage, "no diffuse model '{}'{}", name, suggestion(name, known));
  }
  return diffuse.empty() ? known : diffuse;
}

// The cells of one job.
struct Tried {
  std::vector<StabilityCell> cells;
};

Json to_json(const Tried& tried) {
  Json json = Json::array();
  for (const StabilityCell& cell : tried.cells) json.push_back(to_json(cell));
  return json;
}

void from_json(const Json& json, Tried* tried) {
  for (const Json& cell : json) tried->cells.push_back(cell_from_json(cell));
}

// In the worker.
void try_jobs(const std::vector<Job>& jobs, const std::vector<size_t>& left, const StabilityOptions& options,
              const std::vector<std::string>& diffuse, const Worker<Tried>& worker) {
  worker.now({{}, "opening the device", options.silence_s});
  Device device({.select = options.device});
  KernelLibrary kernels(device);
  Trial trial(kernels, diffuse);
  for (const size_t i : left) {
    worker.now({i, jobs[i].hard_case->name, options.silence_s});
    worker.done(i, {trial.run(*jobs[i].hard_case, *jobs[i].row)});
  }
}

StabilityCell bad_cell(const Job& job, const std::string& why) {
  Judgement verdict;
  verdict.bad(why);
  return verdict.cell(job.hard_case->name, job.row->name, "-");
}

}  // namespace

std::vector<StabilityRow> stability_rows(const std::vector<std::string>& methods) {
  std::vector<StabilityRow> rows;
  for (const std::string& name : methods) {
    const MethodInfo& method = find_method(name);
    if (!method.refused.empty()) throw Error(ErrorKind::plugin, method.refused);
    add_choices(method, &rows);
  }
  if (!methods.empty()) return rows;
  for (const MethodInfo* method : all_methods()) {
    if (method->refused.empty()) {
      add_choices(*method, &rows);
    } else {
      log_warning("{}: left out: {}", method->name, method->refused);
    }
  }
  return rows;
}

std::vector<std::string> stability_cases() {
  std::vector<std::string> names;
  for (const HardCase& c : hard_cases()) names.push_back(c.name);
  return names;
}

std::vector<StabilityCell> run_stability(const StabilityOptions& options,
                                         const std::function<void(const StabilityCell&)>& on_cell) {
  const std::vector<StabilityRow> rows = stability_rows(options.methods);
  const std::vector<Job> jobs = jobs_of(rows, options.cases);
  const std::vector<std::string> diffuse = models_of(options.diffuse);
  std::vector<StabilityCell> cells;
  const auto tell = [&](const StabilityCell& cell) {
    cells.push_back(cell);
    on_cell(cell);
  };
  supervise<Tried>(
      {.name = "stability",
       .jobs = jobs.size(),
       .work = [&](const Worker<Tried>& worker,
                   const std::vector<size_t>& left) { try_jobs(jobs, left, options, diffuse, worker); },
       .told = [&](const Tried& tried) { std::ranges::for_each(tried.cells, tell); },
       .lost =
           [&](size_t job, const End& end) {
             if (!end.task.job) {
               throw Error(ErrorKind::device, end.kind == ErrorKind::device ? end.how : end.message());
             }
             tell(bad_cell(jobs[job], end.how));
           }});
  return cells;
}

}  // namespace vsglbench
