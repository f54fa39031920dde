#include "stability/stability.h"

#include <algorithm>

#include "base/child.h"
#include "base/log.h"
#include "base/nearest.h"
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

// The child's part, from job `first` on.
void try_jobs(const std::vector<Job>& jobs, size_t first, const StabilityOptions& options,
              const std::vector<std::string>& diffuse, const ToParent& parent) {
  std::unique_ptr<Device> device;
  try {
    device = std::make_unique<Device>(DeviceOptions{.select = options.device});
  } catch (const Error& e) {
    parent.send({{"unusable", e.what()}, {"kind", e.exit_code()}});
    return;
  }
  KernelLibrary kernels(*device);
  Trial trial(kernels, diffuse);
  for (size_t i = first; i < jobs.size(); ++i) {
    parent.send({{"job", i}});
    Json cells = Json::array();
    for (const StabilityCell& cell : trial.run(*jobs[i].hard_case, *jobs[i].row)) {
      cells.push_back(to_json(cell));
    }
    parent.send({{"cells", cells}});
  }
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
  // A child goes through the jobs; where it ends in the midst of one, that one is bad, and another goes on
  // behind it.
  for (size_t next = 0; next < jobs.size();) {
    const size_t first = next;
    bool open = false;  // a job that has begun and not ended
    Child child([&](const ToParent& parent) { try_jobs(jobs, first, options, diffuse, parent); });
    while (const auto message = child.receive(options.silence_s)) {
      if (message->contains("unusable"))
        throw Error(message->at("kind").get<ErrorKind>(), message->at("unusable").get<std::string>());
      if (message->contains("job")) {
        next = message->at("job").get<size_t>();
        open = true;
        continue;
      }
      for (const Json& cell : message->at("cells")) tell(cell_from_json(cell));
      open = false;
      ++next;
    }
    if (next == jobs.size()) break;
    if (!open && next == first)
      throw fail(ErrorKind::device, "the device's process {}", child.how_it_ended());
    Judgement verdict;
    verdict.bad(child.how_it_ended().empty() ? "ended the process" : child.how_it_ended());
    tell(verdict.cell(jobs[next].hard_case->name, jobs[next].row->name, "-"));
    ++next;
  }
  return cells;
}

}  // namespace vsglbench
