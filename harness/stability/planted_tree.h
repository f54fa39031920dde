// Tests only: the programme's data with some shaders changed, in a folder of its own that $VSGLBENCH_ROOT
// names, so that nothing which is installed knows of faults.
#pragma once

#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <string>

#include "base/file.h"

namespace vsglbench {

class PlantedTree {
 public:
  // Holds links to all files of the source tree.
  PlantedTree() : source_(data_root()) {
    namespace fs = std::filesystem;
    root_ = fs::temp_directory_path() / ("vsglbench-planted-" + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_);
    for (const char* folder : {"scenes", "configs", "methods"}) {
      fs::create_directory_symlink(source_ / folder, root_ / folder);
    }
    for (const auto& entry : fs::recursive_directory_iterator(source_ / "harness")) {
      const fs::path to = root_ / fs::relative(entry.path(), source_);
      if (entry.is_directory()) {
        fs::create_directories(to);
      } else if (is_read_at_run_time(entry.path())) {
        fs::create_symlink(entry.path(), to);
      }
    }
    ::setenv("VSGLBENCH_ROOT", root_.c_str(), 1);
  }
  ~PlantedTree() {
    ::unsetenv("VSGLBENCH_ROOT");
    std::filesystem::remove_all(root_);
  }
  PlantedTree(const PlantedTree&) = delete;
  PlantedTree& operator=(const PlantedTree&) = delete;

  // harness/stability/naive/NAME in place of harness/FOLDER/NAME, which becomes sound_NAME.
  void plant(const std::string& folder, const std::string& name) const {
    const auto at = root_ / "harness" / folder;
    std::filesystem::rename(at / name, at / ("sound_" + name));
    std::filesystem::create_symlink(source_ / "harness" / "stability" / "naive" / name, at / name);
  }
  // Every shader as `edit` returns its text.
  void edit_shaders(const std::function<std::string(std::string)>& edit) const {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root_ / "harness")) {
      if (!is_read_at_run_time(entry.path())) continue;
      const std::string text = read_text(entry.path());
      std::filesystem::remove(entry.path());
      write_text(entry.path(), edit(text));
    }
  }

 private:
  static bool is_read_at_run_time(const std::filesystem::path& file) {
    const std::string suffix = file.extension();
    return suffix == ".glsl" || suffix == ".comp" || suffix == ".vert" || suffix == ".frag" ||
           suffix == ".json" || suffix == ".csv" || file.filename() == "types.h";
  }
  std::filesystem::path source_, root_;
};

}  // namespace vsglbench
