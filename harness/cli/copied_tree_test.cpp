// A build folder that was copied reads what belongs to it, or says that nothing does.
#include <cstdlib>

#include "cli/cli_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr auto kDeep = fs::copy_options::recursive | fs::copy_options::copy_symlinks;

class CopiedTreeTest : public CliTest {
 protected:
  // Programme and libraries, to `build`.
  static void copy_build(const fs::path& build) {
    fs::create_directories(build / "bin");
    fs::copy_file(test_programme(), build / "bin" / "vsglbench");
    fs::copy(fs::path(VSGLBENCH_BINARY_DIR) / "lib", build / "lib", kDeep);
  }
  // Exit code of the copy, and what it said.
  std::pair<int, std::string> run_copy(const fs::path& build, const std::string& arguments) const {
    const fs::path said = folder_ / "said";
    const std::string command =
        (build / "bin" / "vsglbench").string() + " " + arguments + " > " + said.string() + " 2>&1";
    const int code = std::system(command.c_str());
    return {WEXITSTATUS(code), read_text(said)};
  }
};

TEST_F(CopiedTreeTest, ABuildFolderAloneIsRefused) {
  copy_build(folder_ / "copy");
  const auto [code, said] = run_copy(folder_ / "copy", "list scenes");
  EXPECT_EQ(code, 2);
  EXPECT_TRUE(contains(said, "is a copy of the build folder of"));
}

TEST_F(CopiedTreeTest, ATreeWithItsBuildFolderReadsItsOwnKernels) {
  const fs::path source = VSGLBENCH_SOURCE_DIR, copy = folder_ / "tree";
  const fs::path build = copy / fs::path(VSGLBENCH_BINARY_DIR).lexically_relative(source);
  for (const char* folder : {"harness", "methods", "scenes", "configs"}) {
    fs::create_directories(copy);
    fs::copy(source / folder, copy / folder, kDeep);
  }
  copy_build(build);
  write_text(copy / "methods" / "vpl" / "vpl.comp", "#version 460\n#error of the copy\n");
  const auto [code, said] = run_copy(build, "-q run " + write_config().string() + " --out " + out_.string());
  EXPECT_EQ(code, 1) << said;
  const Report r = report();
  EXPECT_TRUE(contains(r.cases.at(0).error->message, "of the copy"));
  EXPECT_TRUE(contains(r.cases.at(0).error->message, copy.string()));
}

}  // namespace
}  // namespace vsglbench
