// The tables and figures of the papers, and how each is made here. They are data: exhibits.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"

namespace vsglbench {

// A cell of a published table, as the paper prints it, and what is measured beside it.
struct PublishedRow {
  std::string name;       // "Cluster assignment"
  std::string published;  // "3.004"; empty: the paper has no number there
  // Globs over the names of passes, whose times are added up frame by frame; of code size, JSON pointers
  // into what `code-size --json` prints: "/dispatches/rsm".
  std::vector<std::string> passes;
  bool sum = false;  // published as the sum of the other rows of its column
};

struct PublishedColumn {
  std::string head;     // as the paper prints it
  std::string machine;  // that it was measured on
  std::string cases;    // glob over the ids of the run; of code size, a method's name
  std::string scene;    // the one that the paper measured, as a glob; "*": any
  std::vector<PublishedRow> rows;
};

// What an exhibit shows of a run: a row of pictures a kind, a column a case; a block a scene.
struct SheetPart {
  std::string run;                  // a name of Exhibit::runs, ::lights or the figure
  std::string cases = "*";          // glob over case ids
  std::vector<std::string> images;  // "reference", "indirect", "error", "cancellation"
  // Instead: files below the folder of the run, lights or figure, by globs; each is a picture.
  std::vector<std::string> files;
};

struct Exhibit {
  std::string name;                            // "mfis16-tab1"
  std::string source;                          // "[MFIS16 Tab. 1]"
  std::string title;                           // what it shows, in a sentence
  std::string differs;                         // in what this reproduction is not as published; may be empty
  std::vector<std::string> runs;               // configs for `run`
  std::vector<std::string> lights;             // configs for `lights`
  std::vector<std::string> light_cases;        // globs over their case ids; empty: all
  std::string figure;                          // config for `figure`; empty: none
  uint32_t quick_width = 0, quick_height = 0;  // of it at scale "quick"; 0: its own
  // Lights are drawn of the seed in which `fis` has its largest kernel in the first run; else of seed 0.
  bool largest_kernel = false;
  bool edges = false;  // whether lights are larger and darker on discontinuous geometry [VSGL14 Fig. 2]
  bool code_size = false;
  std::vector<PublishedColumn> table;
  std::vector<std::string> columns;  // of the report's own table, as `table --columns`; empty: none is shown
  std::vector<std::string> claims;   // names of answer/claims.json, tried on each of the runs
  std::vector<SheetPart> sheet;
};

// Where what is made of a config lies, below the folder of all: its name without ".json", for it may be a
// path, and what is made: "", or "-lights".
std::string folder_of(const std::string& config, const std::string& of);

// Throws Error(config) "FILE:LINE: ..."; also for a sheet of what the exhibit does not make, and two configs
// that would share a folder. Without a path: the list that comes with the programme.
std::vector<Exhibit> load_exhibits(const std::filesystem::path& file = {});

// Those of these names, or all for none or "all". Throws Error(usage) that names the nearest.
std::vector<Exhibit> select_exhibits(const std::vector<Exhibit>& all, const std::vector<std::string>& names);

}  // namespace vsglbench
