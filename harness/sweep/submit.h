// A sweep's tasks for an engine that a site has already. What an engine knows is never asked for: which
// shards are open is told by their files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sweep/plan.h"

namespace vsglbench {

//   slurm     two job arrays: references, one task a scene; then the shards, once those are there
//   parallel  GNU parallel, on this machine or over ssh; returns when all is done
//   print     writes the scripts for Slurm, and starts nothing
enum class Engine { slurm, parallel, print };
Engine engine_named(const std::string& name);  // throws Error(usage)

struct SubmitOptions {
  Engine engine = Engine::print;
  std::string require;                 // as TaskOptions::require
  std::string gres = "gpu:1";          // of a measuring task; empty: none
  std::vector<std::string> arguments;  // for sbatch or parallel, after those of ours
};

// "0-3,7".
std::string index_list(const std::vector<size_t>& indices);
// As the shell takes it for one word.
std::string shell_word(const std::string& text);

struct SubmitScripts {
  std::filesystem::path references, shard;  // of one task
  std::filesystem::path all;                // starts every task
};

// Writes DIR/jobs/{references.sh,shard.sh,submit.sh or parallel.sh} for these shards and their scenes. A task
// finds there the folder, the cache, the plugins and the data of this process.
SubmitScripts write_scripts(const std::filesystem::path& sweep, const SweepPlan& plan,
                            const std::vector<size_t>& shards, const SubmitOptions& options);

// Runs what write_scripts() wrote; its exit code. Throws Error(usage) where the engine is not installed.
int run_scripts(const SubmitScripts& scripts, Engine engine);

}  // namespace vsglbench
