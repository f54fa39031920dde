#include "method/plugin.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <map>

#include "base/error.h"
#include "base/file.h"
#include "method/registry.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// Sizes behind ABI 9. Where one fails: raise plugin_abi, then put the new size here.
TEST(PluginAbi, TheLayoutsOfSharedTypesAreThoseOfItsNumber) {
  ASSERT_EQ(plugin_abi, 9u);
  EXPECT_EQ(sizeof(gpu::Vsgl), 80u);
  EXPECT_EQ(sizeof(gpu::Vpl), 112u);
  EXPECT_EQ(sizeof(gpu::Emitter), 88u);
  EXPECT_EQ(sizeof(Field), 144u);
  EXPECT_EQ(sizeof(LightTarget), 40u);
  EXPECT_EQ(sizeof(Steps), 16u);
  EXPECT_EQ(sizeof(ParameterInfo), 120u);
  EXPECT_EQ(sizeof(MethodInfo), 352u);
  EXPECT_EQ(sizeof(MethodContext), 256u);
  EXPECT_EQ(sizeof(Buffer), 56u);
  EXPECT_EQ(sizeof(Recorder), 104u);
  EXPECT_EQ(sizeof(DeviceInfo), 320u);
}

class RegistryTest : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  const fs::path folder_ = fs::temp_directory_path() / fmt::format("vsglbench_registry_{}", ::getpid());
};

TEST_F(RegistryTest, FindsTheMethodsThatCameWithIt) {
  for (const char* name : {"all-texels", "fis", "mfis", "vpl"}) {
    const MethodInfo& info = find_method(name);
    EXPECT_EQ(info.refused, "");
    EXPECT_EQ(info.create, nullptr);
    EXPECT_TRUE(fs::is_directory(info.folder));
  }
  try {
    find_method("mfsi");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::config);
    EXPECT_EQ(std::string(e.what()), "no method 'mfsi'; did you mean 'mfis'?");
  }
}

TEST_F(RegistryTest, APluginIsNamedByItsFileAndHashedWithItsKernels) {
  const MethodInfo& mfis = find_method("mfis");
  fs::copy_file(mfis.library, folder_ / "mfis-before.so");
  fs::create_directories(folder_ / "mfis-before");
  write_text(folder_ / "mfis-before" / "mfis.comp", "one");
  const MethodInfo copy = inspect_plugin(folder_ / "mfis-before.so");
  EXPECT_EQ(copy.name, "mfis-before");
  EXPECT_EQ(copy.summary, mfis.summary);
  EXPECT_EQ(copy.refused, "");
  const std::string hash = plugin_hash(copy);
  EXPECT_EQ(plugin_hash(copy), hash);
  write_text(folder_ / "mfis-before" / "mfis.comp", "two");
  EXPECT_NE(plugin_hash(copy), hash);
}

// As it was built: whatever becomes of the kernels in the source tree and of what they include.
TEST_F(RegistryTest, ACopyByItselfHasTheKernelsThatItWasBuiltWith) {
  ::setenv("VSGLBENCH_CACHE", (folder_ / "cache").c_str(), 1);
  fs::copy_file(find_method("mfis").library, folder_ / "mfis-old.so");
  EXPECT_EQ(inspect_plugin(folder_ / "mfis-old.so").refused, "");
  const MethodInfo old = load_plugin(folder_ / "mfis-old.so", DeviceInfo{});
  ::unsetenv("VSGLBENCH_CACHE");
  EXPECT_EQ(old.name, "mfis-old");
  EXPECT_EQ(old.folder.parent_path().parent_path(), folder_ / "cache" / "kernels");
  for (const auto& [kept, file] : std::map<std::string, std::string>{
           {"kernels/mfis.comp", "methods/mfis/mfis.comp"},
           {"included/warp.glsl", "harness/shaders/warp.glsl"},
           {"included/types.h", "harness/shaders/types.h"},
           {"included/moments_mip.comp", "harness/method/shaders/moments_mip.comp"}}) {
    EXPECT_EQ(read_text(old.folder.parent_path() / kept), read_text(data_root() / file)) << kept;
  }
}

TEST_F(RegistryTest, WhatIsNoPluginIsRefusedInOneLine) {
  write_text(folder_ / "junk.so", "not a library");
  EXPECT_NE(inspect_plugin(folder_ / "junk.so").refused.find("can't be loaded"), std::string::npos);
  EXPECT_NE(inspect_plugin(folder_ / "absent.so").refused.find("no such file"), std::string::npos);
  const fs::path library = library_directory() / "libvsglbench_base.so";
  const std::string refused = inspect_plugin(library).refused;
  EXPECT_NE(refused.find("is no vsglbench method"), std::string::npos) << refused;
  EXPECT_EQ(refused.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace vsglbench
