// Figures of papers, reproduced from a config of configs/: tables, plots and pictures, and what the paper
// claims of them. configs/README.md describes the configs.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/json.h"
#include "figure/plot.h"
#include "gpu/device.h"
#include "image/png.h"

namespace vsglbench {

// Rows of text cells. In a column `origin` stands where a row is from: "measured", "formula" or "published".
struct FigureTable {
  std::string name;  // of the file, without ".csv"
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  template <class... Cells>
  void add(const Cells&... cells) {
    rows.push_back({cell(cells)...});
  }
  std::string csv() const;

 private:
  static std::string cell(const std::string& text) { return text; }
  static std::string cell(double value);
};

// Undecided: the noise of what was measured is larger than the difference.
enum class Finding { holds, does_not_hold, undecided };
inline Finding finding(bool holds) { return holds ? Finding::holds : Finding::does_not_hold; }
const char* finding_name(Finding finding);

// What a paper says of its figure, and whether it is so here.
struct Claim {
  std::string text, source;  // source: paper and place
  Finding finding = Finding::undecided;
  std::string figures;  // that show it
};

struct FigureOutput {
  std::vector<FigureTable> tables;
  std::vector<std::pair<std::string, Plot>> plots;     // NAME.svg and NAME-plot.png
  std::vector<std::pair<std::string, Bitmap>> images;  // NAME.png
  std::vector<Claim> claims;
};

struct FigureInputs {
  Device& device;
  Json config;                   // checked
  std::filesystem::path assets;  // where downloaded scenes lie
  // Told what is about to be done, before each step that may take long: "a frame of 480×270, cosine".
  std::function<void(const std::string& step)> begin = [](const std::string&) {};
};

const std::vector<std::string>& figure_names();

// Reads and checks the config of a figure, with its scene's name, method, parameters and N; a width or height
// that is not 0 replaces its own. Throws Error(config) "FILE:LINE: ...", Error(usage) for a size beyond the
// config's limits.
Json load_figure_config(const std::filesystem::path& path, uint32_t width, uint32_t height);

// Throws Error(scene), Error(plugin) or Error(case_failed), by what fails.
FigureOutput make_figure(const FigureInputs& inputs);

// Writes every table, plot and image into `folder`; throws Error(output). Returns their paths.
std::vector<std::filesystem::path> write_figure(const FigureOutput& figure,
                                                const std::filesystem::path& folder);

}  // namespace vsglbench
