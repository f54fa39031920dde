#include "reference/cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "image/exr.h"
#include "reference/test_scenes.h"

namespace vsglbench {
namespace {

namespace fs = std::filesystem;

// Points the cache at an empty folder of its own while it lives.
class ReferenceCache : public ::testing::Test {
 protected:
  ReferenceCache()
      : folder_(fs::temp_directory_path() / ("vsglbench_cache_test_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    setenv("VSGLBENCH_CACHE", folder_.c_str(), 1);
    parameters_.width = 24;
    parameters_.height = 16;
    parameters_.samples = 16;
    parameters_.batches = 4;
  }
  ~ReferenceCache() override {
    unsetenv("VSGLBENCH_CACHE");
    fs::remove_all(folder_);
  }

  ReferenceResult get(bool expect_cached) {
    bool cached = !expect_cached;
    ReferenceResult r = load_or_compute(scene_, parameters_, &cached);
    EXPECT_EQ(cached, expect_cached);
    return r;
  }
  fs::path file(const char* extension) {
    return folder_ / "references" / (reference_hash(scene_, parameters_) + extension);
  }

  fs::path folder_;
  Scene scene_ = test::slab_box();
  ReferenceParameters parameters_;
};

void expect_same(const ReferenceResult& a, const ReferenceResult& b) {
  EXPECT_EQ(a.mean.pixels, b.mean.pixels);
  EXPECT_EQ(a.variance.pixels, b.variance.pixels);
  EXPECT_EQ(a.half[0].pixels, b.half[0].pixels);
  EXPECT_EQ(a.half[1].pixels, b.half[1].pixels);
  EXPECT_EQ(a.mask, b.mask);
  EXPECT_EQ(a.noise_floor_smape, b.noise_floor_smape);
  EXPECT_EQ(a.standard_error, b.standard_error);
  EXPECT_EQ(a.ended_by, b.ended_by);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.batches, b.batches);
  EXPECT_EQ(a.photons, b.photons);
  EXPECT_EQ(a.rays, b.rays);
  EXPECT_EQ(a.hash, b.hash);
}

TEST_F(ReferenceCache, ASecondCallReadsWhatTheFirstWrote) {
  const ReferenceResult first = get(false);
  expect_same(get(true), first);
}

TEST_F(ReferenceCache, AFileSaysWhatItHolds) {
  const ReferenceResult r = get(false);
  const auto said = read_exr_layers(file(".exr")).attributes;
  EXPECT_EQ(said.at("reference_hash"), r.hash);
  EXPECT_EQ(said.at("scene"), scene_.name);
  EXPECT_EQ(said.at("sceneHash"), scene_.hash);
  EXPECT_EQ(said.at("samples"), std::to_string(r.samples));
  EXPECT_NE(said.at("units").find("W/(sr m^2)"), std::string::npos);
  EXPECT_NE(said.at("content").find("half0"), std::string::npos);
}

TEST_F(ReferenceCache, TruncatedOrAlteredFilesAreComputedAnew) {
  const ReferenceResult first = get(false);
  for (const char* extension : {".exr", ".json"}) {
    // Each is of the file as it is now: the next one says another time, and may be longer or shorter.
    for (const uintmax_t most : {uintmax_t(0), uintmax_t(10), ~uintmax_t(0)}) {
      fs::resize_file(file(extension), std::min(most, fs::file_size(file(extension)) - 3));
      expect_same(get(false), first);
      expect_same(get(true), first);
    }
  }
  // A flipped byte that leaves both files readable.
  std::fstream json(file(".json"), std::ios::in | std::ios::out);
  const std::string text{std::istreambuf_iterator<char>(json), {}};
  json.seekp(static_cast<std::streamoff>(text.find("\"images\"") + 12));
  json.put('x');
  json.close();
  expect_same(get(false), first);
  // Images of another reference under this one's name.
  fs::copy_file(file(".exr"), folder_ / "other.exr");
  parameters_.seed = 2;
  get(false);
  fs::copy_file(folder_ / "other.exr", file(".exr"), fs::copy_options::overwrite_existing);
  get(false);
}

TEST_F(ReferenceCache, EveryParameterButThreadsIsPartOfTheKey) {
  const std::string hash = reference_hash(scene_, parameters_);
  const auto changed = [&](auto change) {
    ReferenceParameters p = parameters_;
    change(p);
    return reference_hash(scene_, p) != hash;
  };
  EXPECT_TRUE(changed([](auto& p) { p.width = 25; }));
  EXPECT_TRUE(changed([](auto& p) { p.height = 25; }));
  EXPECT_TRUE(changed([](auto& p) { p.samples = 25; }));
  EXPECT_TRUE(changed([](auto& p) { p.batches = 6; }));
  EXPECT_TRUE(changed([](auto& p) { p.floor = 3; }));
  EXPECT_TRUE(changed([](auto& p) { p.shading_normals = ShadingNormals::camera; }));
  EXPECT_TRUE(changed([](auto& p) { p.photons_a_sample = 3; }));
  EXPECT_TRUE(changed([](auto& p) { p.seed = 3; }));
  EXPECT_TRUE(changed([](auto& p) { p.occlusion = false; }));
  EXPECT_TRUE(changed([](auto& p) { p.strategies = 3; }));
  EXPECT_TRUE(changed([](auto& p) { p.time_limit = 3; }));
  EXPECT_FALSE(changed([](auto& p) { p.threads = 7; }));
  Scene other = scene_;
  other.hash += "x";
  EXPECT_NE(reference_hash(other, parameters_), hash);
}

// The folder's name is taken by a file: nothing can be written, even by root.
TEST_F(ReferenceCache, ACacheThatTakesNothingIsNoError) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "references") << "in the way";
  const ReferenceResult first = get(false);
  expect_same(get(false), first);
}

}  // namespace
}  // namespace vsglbench
