#include "sweep/submit.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>

#include "base/error.h"
#include "base/file.h"
#include "method/registry.h"
#include "sweep/shard_folder.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// A Slurm array counts up to 1000 where nobody has set MaxArraySize.
constexpr size_t kArray = 1000;

std::string words(const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& a : arguments) text += " " + shell_word(a);
  return text;
}

fs::path this_programme() {
  std::error_code ec;
  return fs::read_symlink("/proc/self/exe", ec);
}

// One task: its first argument plus the second, or the index in Slurm's array, is the number.
std::string task_script(const fs::path& sweep, const std::string& command, const std::string& about,
                        const std::string& more) {
  std::string plugins;
  for (const fs::path& folder : plugin_folders())
    plugins += (plugins.empty() ? "" : ":") + fs::absolute(folder).string();
  return fmt::format(
      "#!/usr/bin/env bash\n"
      "# {}: FIRST [INDEX]; without INDEX that of Slurm's array. Written by `vsglbench sweep submit`.\n"
      "set -euo pipefail\n"
      "export VSGLBENCH_CACHE={}\n"
      "export VSGLBENCH_PLUGINS={}\n"
      "export VSGLBENCH_ROOT={}\n"
      "cd {}\n"
      "exec {} -q sweep {} {} \"$(($1 + ${{2:-${{SLURM_ARRAY_TASK_ID:-0}}}}))\"{}\n",
      about, shell_word(fs::absolute(cache_directory()).string()), shell_word(plugins),
      shell_word(fs::absolute(data_root()).string()), shell_word(fs::current_path().string()),
      shell_word(this_programme().string()), command, shell_word(sweep.string()), more);
}

// Arrays of at most kArray tasks: the first number, and the indices from there.
std::map<size_t, std::vector<size_t>> arrays_of(const std::vector<size_t>& numbers) {
  std::map<size_t, std::vector<size_t>> arrays;
  for (const size_t n : numbers) arrays[n / kArray * kArray].push_back(n % kArray);
  return arrays;
}

std::string sbatch_line(const fs::path& jobs, const std::string& name, const std::string& options,
                        size_t first, const std::vector<size_t>& indices, const SubmitOptions& o,
                        const fs::path& script) {
  return fmt::format("sbatch --parsable --requeue --job-name={} --output={}{} --array={}{} {} {}",
                     shell_word(name), shell_word((jobs / "slurm-%A_%a.out").string()), options,
                     index_list(indices), words(o.arguments), shell_word(script.string()), first);
}

std::string slurm_script(const fs::path& jobs, const std::string& name, const SubmitScripts& s,
                         const std::vector<size_t>& scenes, const std::vector<size_t>& shards,
                         const SubmitOptions& o) {
  std::string text =
      "#!/usr/bin/env bash\n"
      "# Submits the sweep: the references of each scene, and then the shards. Written by `vsglbench sweep "
      "submit`.\n"
      "set -euo pipefail\nreferences=\n";
  for (const auto& [first, indices] : arrays_of(scenes)) {
    text += fmt::format("job=$({})\nreferences+=:${{job%%;*}}\n",
                        sbatch_line(jobs, name + "-references", "", first, indices, o, s.references));
  }
  const std::string gres = o.gres.empty() ? "" : " --gres=" + shell_word(o.gres);
  for (const auto& [first, indices] : arrays_of(shards)) {
    text += fmt::format(
        "job=$({})\necho \"shards: job ${{job%%;*}}, after references$references\"\n",
        sbatch_line(jobs, name,
                    " --dependency=\"afterok$references\" --kill-on-invalid-dep=yes --exclusive" + gres,
                    first, indices, o, s.shard));
  }
  return text;
}

std::string parallel_line(const fs::path& jobs, const std::string& log, const std::vector<size_t>& numbers,
                          const SubmitOptions& o, const fs::path& script) {
  return fmt::format("parallel --will-cite --jobs 1 --joblog {}{} {} 0 {{}} ::: {}",
                     shell_word((jobs / log).string()), words(o.arguments), shell_word(script.string()),
                     fmt::join(numbers, " "));
}

std::string parallel_script(const fs::path& jobs, const SubmitScripts& s, const std::vector<size_t>& scenes,
                            const std::vector<size_t>& shards, const SubmitOptions& o) {
  return fmt::format(
      "#!/usr/bin/env bash\n"
      "# Runs the sweep: the references of each scene, and then the shards. Written by `vsglbench sweep "
      "submit`.\n"
      "set -euo pipefail\n{}\n{}\n",
      parallel_line(jobs, "references.log", scenes, o, s.references),
      parallel_line(jobs, "shards.log", shards, o, s.shard));
}

void write_executable(const fs::path& path, const std::string& text) {
  write_text(path, text);
  fs::permissions(path, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                            fs::perms::others_read | fs::perms::others_exec);
}

bool is_installed(const std::string& programme) {
  const char* given = std::getenv("PATH");
  std::istringstream folders(given ? given : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((fs::path(folder) / programme).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace

Engine engine_named(const std::string& name) {
  if (name == "slurm") return Engine::slurm;
  if (name == "parallel") return Engine::parallel;
  if (name == "print") return Engine::print;
  throw fail(ErrorKind::usage, "no engine '{}'; known: slurm, parallel, print", name);
}

std::string index_list(const std::vector<size_t>& indices) {
  std::string text;
  for (size_t i = 0; i < indices.size();) {
    size_t k = i;
    while (k + 1 < indices.size() && indices[k + 1] == indices[k] + 1) ++k;
    text += fmt::format("{}{}", text.empty() ? "" : ",", indices[i]);
    if (k > i) text += fmt::format("-{}", indices[k]);
    i = k + 1;
  }
  return text;
}

std::string shell_word(const std::string& text) {
  const bool plain = !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./:=,+@%").find(c) != std::string::npos;
  });
  if (plain) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

SubmitScripts write_scripts(const fs::path& sweep, const SweepPlan& plan, const std::vector<size_t>& shards,
                            const SubmitOptions& options) {
  const fs::path root = fs::absolute(sweep).lexically_normal(), jobs = root / "jobs";
  const bool parallel = options.engine == Engine::parallel;
  SubmitScripts s{jobs / "references.sh", jobs / "shard.sh", jobs / (parallel ? "parallel.sh" : "submit.sh")};
  const std::vector<std::string> names = plan.scenes();
  std::vector<size_t> scenes;
  for (size_t i = 0; i < names.size(); ++i)
    if (std::ranges::any_of(shards, [&](size_t k) { return plan.shards[k].scene == names[i]; }))
      scenes.push_back(i);
  const std::string require =
      options.require.empty() ? "" : " --require-device " + shell_word(options.require);
  write_executable(s.references, task_script(root, "references", "The references of one scene", ""));
  write_executable(s.shard, task_script(root, "run", "One shard", require));
  const std::string name = plan.config.value("name", "sweep");
  write_executable(s.all, parallel ? parallel_script(jobs, s, scenes, shards, options)
                                   : slurm_script(jobs, name, s, scenes, shards, options));
  return s;
}

int run_scripts(const SubmitScripts& scripts, Engine engine) {
  const std::string needed = engine == Engine::parallel ? "parallel" : "sbatch";
  if (!is_installed(needed))
    throw fail(ErrorKind::usage, "{} is not installed; install the package {}, or run {} where it is", needed,
               engine == Engine::parallel ? "parallel" : "slurm-client", scripts.all.string());
  std::fflush(nullptr);
  const int status = std::system(shell_word(scripts.all.string()).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace vsglbench
