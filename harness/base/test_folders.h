// Tests only: what they find beside themselves, in a build folder or an installed one; so no test holds a
// path of the machine that it was built on.
#pragma once

#include <filesystem>

#include "base/file.h"

namespace vsglbench {

// The build folder, or the one that `cmake --install` made.
inline std::filesystem::path test_build() { return library_directory().parent_path(); }
inline bool tests_are_installed() { return std::filesystem::is_directory(test_build() / "tests"); }
inline std::filesystem::path test_programme() { return test_build() / "bin" / "vsglbench"; }
// Methods that go wrong.
inline std::filesystem::path bad_plugins() {
  return (tests_are_installed() ? test_build() / "tests" : test_build()) / "bad-plugins";
}
// References and kernels that tests share; an installed folder may be read-only.
inline std::filesystem::path test_cache() {
  return tests_are_installed() ? std::filesystem::temp_directory_path() / "vsglbench-test-cache"
                               : test_build() / "test-cache";
}

}  // namespace vsglbench
