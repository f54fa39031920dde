// `vsglbench reproduce`: an exhibit measured, its claims tried, its pictures put on a sheet.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "answer/claims.h"
#include "papers/exhibit.h"
#include "papers/trial.h"
#include "papers/work.h"

namespace vsglbench {

inline constexpr const char* kPapersSchema = "vsglbench.papers/1";
inline constexpr const char* kQuickScale = "quick";
inline constexpr const char* kPaperScale = "paper";  // the configs as they are

// What an exhibit gave, as papers.json holds it:
//   name, source, title, differs, scale, created, command, commit, dirty, wall_s
//   device {name, driver, driver_version, type}, host {cpu, cores}
//   tables[] {scene, unit, rows[] {column, name, published, machine, value, ci95, mean, sum, passes[]}}
//   reports[] {config, markdown}   problems[]   notes[]   sheet (file name; absent: none)   trials[]
//   (papers/trial.h)
// A run that fails costs its part and stands in `problems`. The sheet is drawn into `sheets`, NAME.png.
Json reproduce_exhibit(const Exhibit& exhibit, const std::vector<PaperClaim>& claims, PapersWork* work,
                       const std::string& scale, const std::filesystem::path& sheets);

// The trials of all exhibits of a papers.json.
std::vector<ClaimTrial> trials_in(const Json& papers);

// Exhibits of `fresh` in place of those of the same name in `earlier`, in the order of `all`; those that it
// does not name come last.
Json merged(const Json& earlier, const Json& fresh, const std::vector<Exhibit>& all);

// --- the ledger, held against an earlier one ---

struct Flip {
  ClaimTrial before, after;
  bool lost =
      false;  // what held no longer does, or what did not hold does: a kernel has changed what is true
};

struct Flips {
  std::vector<Flip> changed;
  size_t compared = 0;  // trials that both have at one scale
  size_t vanished = 0;  // of `before`, that an exhibit of `after` of the same scale has no more
};

// Trials whose rulings differ. `lost`: both rulings are certain, that is neither undecided nor not run.
Flips flips(const Json& before, const Json& after);

// "[MFIS16 §5] no longer holds: ... (mfis16-fig5, conference, rmse; 0.98 [0.97, 0.99] was, 1.2 [1.1, 1.3]
// is)"
std::string flip_text(const Flip& flip);

// --- the page ---

// README.md of a folder with papers.json and the thumbnails that it names, wholly made from the JSON.
std::string papers_page(const Json& papers);

}  // namespace vsglbench
