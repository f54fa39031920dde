#include "gpu/shader_compiler.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "base/error.h"
#include "base/file.h"

namespace fs = std::filesystem;
using namespace vsglbench;

namespace {

class ShaderCompiler : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / fmt::format("vsglbench_shader_{}", ::getpid());
    ::setenv("VSGLBENCH_CACHE", (dir_ / "cache").c_str(), 1);
    write_text(dir_ / "k.comp",
               "#version 460\nlayout(local_size_x = SIZE) in;\nlayout(binding = 0) buffer B { uint b[]; };\n"
               "#include \"value.glsl\"\nvoid main() { b[0] = VALUE; }\n");
    write_text(dir_ / "value.glsl", "#define VALUE 7u\n");
  }
  void TearDown() override {
    ::unsetenv("VSGLBENCH_CACHE");
    fs::remove_all(dir_);
  }
  std::vector<uint32_t> compile(const char* size = "1") {
    return compile_shader(dir_ / "k.comp", {{"SIZE", size}}, {});
  }
  fs::path dir_;
};

}  // namespace

TEST_F(ShaderCompiler, KeepsWhatItCompiledUntilSourceIncludeOrDefineChanges) {
  const unsigned before = shader_statistics().compiled;
  const auto first = compile();
  EXPECT_EQ(compile(), first);
  EXPECT_EQ(shader_statistics().compiled, before + 1);
  compile("2");
  EXPECT_EQ(shader_statistics().compiled, before + 2);
  write_text(dir_ / "value.glsl", "#define VALUE 8u\n");
  EXPECT_NE(compile(), first);
  EXPECT_EQ(shader_statistics().compiled, before + 3);
}

TEST_F(ShaderCompiler, CompilesAnewWhatTheCacheHoldsDamaged) {
  const auto good = compile();
  const fs::path file = fs::directory_iterator(dir_ / "cache" / "spirv")->path();
  const std::string whole = read_text(file);
  for (size_t size = 0; size < whole.size(); size += 37) {
    write_text(file, whole.substr(0, size));
    EXPECT_EQ(compile(), good) << "cut to " << size << " bytes";
  }
  std::string flipped = whole;
  flipped[flipped.size() / 2] ^= 1;
  write_text(file, flipped);
  EXPECT_EQ(compile(), good);
}

TEST_F(ShaderCompiler, ErrorsNameFileAndLineOnce) {
  write_text(dir_ / "value.glsl", "#define VALUE nothing\n");
  try {
    compile();
    FAIL() << "no error";
  } catch (const Error& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("k.comp:5"), std::string::npos) << what;
    EXPECT_EQ(what.find("k.comp"), what.rfind("k.comp")) << what;
  }
}
