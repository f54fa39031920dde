// `vsglbench reproduce`: an exhibit measured, its claims tried, its pictures put on a sheet.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "answer/claims.h"
#include "papers/exhibit.h"
#include "papers/work.h"

namespace vsglbench {

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

}  // namespace vsglbench
