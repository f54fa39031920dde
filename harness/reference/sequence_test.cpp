#include "reference/sequence.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/hash.h"
#include "reference/cache.h"
#include "reference/test_scenes.h"
#include "scene/scene_file.h"

#if defined(__SANITIZE_ADDRESS__)
extern "C" size_t __sanitizer_get_current_allocated_bytes();  // GCC comes without the header
#endif

namespace vsglbench {
namespace {

namespace fs = std::filesystem;

ReferenceParameters small() {
  ReferenceParameters p;
  p.width = 48;
  p.height = 32;
  p.samples = 16;
  p.batches = 4;
  p.threads = 2;
  return p;
}

bool same_bits(const Image& a, const Image& b) {
  return Hasher().array(a.pixels).hex() == Hasher().array(b.pixels).hex();
}

// An empty cache of its own.
class Sequence : public ::testing::Test {
 protected:
  Sequence()
      : folder_(fs::temp_directory_path() / ("vsglbench_sequence_test_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    setenv("VSGLBENCH_CACHE", folder_.c_str(), 1);
  }
  ~Sequence() override {
    unsetenv("VSGLBENCH_CACHE");
    fs::remove_all(folder_);
  }
  fs::path folder_;
};

TEST_F(Sequence, EachFrameIsTheReferenceOfItsPose) {
  Scene scene = test::ring_box();
  const ReferenceParameters parameters = small();
  const Guidance guidance = learn_from_teachers(scene, parameters);
  std::vector<Image> images;
  reference_sequence(&scene, parameters, [&](const SequenceFrame& f) {
    EXPECT_EQ(f.frame, images.size());
    // Frames 6 and 7 are back where frame 0 was, and have its reference.
    EXPECT_EQ(f.from_cache, f.frame >= 6);
    EXPECT_EQ(f.reference.hash, reference_hash(scene, parameters, hash_of_teachers(scene)));
    images.push_back(f.reference.mean);
    // A new tracer's image of the same pose, to the bit.
    EXPECT_TRUE(
        same_bits(f.reference.mean, compute_reference(Tracer(scene), parameters, nullptr, &guidance).mean))
        << f.frame;
  });
  ASSERT_EQ(images.size(), 8u);
  EXPECT_FALSE(same_bits(images[0], images[1]));
  // All from the cache the next time, also in a longer animation.
  Scene again = test::ring_box();
  reference_sequence(&again, parameters, [&](const SequenceFrame& f) {
    EXPECT_TRUE(f.from_cache);
    EXPECT_TRUE(same_bits(f.reference.mean, images[f.frame]));
  });
}

// In any order, and from whichever frame on: what lies in the cache is the same.
TEST_F(Sequence, TheOrderOfFramesDoesNotMatter) {
  Scene scene = test::ring_box();
  std::vector<ReferenceResult> forwards(6);
  for (const bool backwards : {false, true}) {
    fs::remove_all(folder_);
    set_frame(&scene, backwards ? 5 : 0);
    ReferenceSequence sequence(scene, small());
    Tracer tracer(scene);
    for (uint32_t i = 0; i < 6; ++i) {
      const uint32_t frame = backwards ? 5 - i : i;
      tracer.update(set_frame(&scene, frame));
      bool cached = true;
      const ReferenceResult r = sequence.present([&]() -> const Tracer& { return tracer; }, &cached);
      EXPECT_FALSE(cached);
      if (!backwards) forwards[frame] = r;
      EXPECT_EQ(r.hash, forwards[frame].hash);
      EXPECT_EQ(r.hash, sequence.hash());
      EXPECT_TRUE(same_bits(r.mean, forwards[frame].mean)) << frame;
    }
  }
}

// What a camera or light that moves sees is a still scene's reference.
TEST_F(Sequence, WithoutAnythingToShareEachFrameTeachesItself) {
  Scene scene = test::ring_box();
  for (bool* moves : {&scene.animation.moves.camera, &scene.animation.moves.light}) {
    *moves = true;
    ReferenceSequence sequence(scene, small());
    EXPECT_EQ(sequence.hash(), reference_hash(scene, small()));
    const Tracer tracer(scene);
    const ReferenceResult r = sequence.present([&]() -> const Tracer& { return tracer; });
    EXPECT_TRUE(same_bits(r.mean, compute_reference(scene, small()).mean));
    *moves = false;
  }
  EXPECT_NE(ReferenceSequence(scene, small()).hash(), reference_hash(scene, small()));
}

// By the tracer and not the cache: what it went through in between changes nothing.
TEST(CommonRandomNumbers, FramesOfEqualPoseAreEqualToTheBit) {
  Scene scene = test::ring_box();
  Tracer tracer(scene);
  const Guidance guidance = learn_guidance(tracer, small());
  for (const Guidance* guide : {static_cast<const Guidance*>(nullptr), &guidance}) {
    std::vector<ReferenceResult> results;
    for (const uint32_t frame : {0u, 2u, 6u}) {
      tracer.update(set_frame(&scene, frame));
      results.push_back(compute_reference(tracer, small(), nullptr, guide));
    }
    EXPECT_TRUE(same_bits(results[0].mean, results[2].mean));
    EXPECT_TRUE(same_bits(results[0].variance, results[2].variance));
    EXPECT_EQ(results[0].hash, results[2].hash);
    EXPECT_FALSE(same_bits(results[0].mean, results[1].mean));
  }
}

constexpr int kSeeds = 16;

// Of one frame, by a seed each, taught by the teachers or by itself.
std::vector<Image> images_of(const Scene& scene, bool shared = true) {
  ReferenceParameters p = small();
  const Tracer tracer(scene);
  std::vector<Image> images;
  for (p.seed = 1; p.seed <= kSeeds; ++p.seed) {
    std::optional<Guidance> guidance;
    if (shared) guidance = learn_from_teachers(scene, p);
    images.push_back(compute_reference(tracer, p, nullptr, guidance ? &*guidance : nullptr).mean);
  }
  return images;
}

// Variances over seeds, summed over the pixels.
struct Variances {
  double difference = 0, both = 0;
};

Variances variances(const std::vector<Image>& a, const std::vector<Image>& b) {
  Variances v;
  for (size_t i = 0; i < a[0].pixels.size(); ++i) {
    double sum[3] = {}, squares[3] = {};
    for (int seed = 0; seed < kSeeds; ++seed) {
      const double x = a[seed].pixels[i].y, y = b[seed].pixels[i].y;
      const double values[3] = {x, y, x - y};
      for (int k = 0; k < 3; ++k) sum[k] += values[k], squares[k] += values[k] * values[k];
    }
    const auto variance = [&](int k) { return squares[k] / kSeeds - sum[k] / kSeeds * (sum[k] / kSeeds); };
    v.both += variance(0) + variance(1);
    v.difference += variance(2);
  }
  return v;
}

// Were the frames' noise independent, the variance of their difference would be the sum of theirs. The slower
// the ring moves, the less is left.
TEST(CommonRandomNumbers, NoiseIsCommonToFrames) {
  for (const auto& [frames, most] : {std::pair(602u, 0.01), std::pair(62u, 0.2)}) {
    Scene scene = test::ring_box(frames);
    set_frame(&scene, 30);
    const std::vector<Image> before = images_of(scene);
    EXPECT_TRUE(set_frame(&scene, 31).any());
    const Variances v = variances(before, images_of(scene));
    EXPECT_GT(v.both, 0);
    EXPECT_LT(v.difference / v.both, most) << frames;
  }
}

// In any frame, what several teach is about as good as what it would teach itself.
TEST(CommonRandomNumbers, AFrameIsHardlyNoisierForWhatItShares) {
  Scene scene = test::ring_box(16);
  for (const uint32_t frame : {0u, 3u, 8u}) {
    set_frame(&scene, frame);
    const std::vector<Image> shared = images_of(scene), own = images_of(scene, false);
    EXPECT_LT(variances(shared, shared).both, 1.15 * variances(own, own).both) << frame;
  }
}

TEST(Teachers, AreSpreadOverTheFrames) {
  EXPECT_EQ(teachers(1), (std::vector<uint32_t>{0}));
  EXPECT_EQ(teachers(2), (std::vector<uint32_t>{0, 1}));
  EXPECT_EQ(teachers(16), (std::vector<uint32_t>{0, 5, 10, 15}));
}

// Bytes that this process holds.
double bytes_held() {
#if defined(__SANITIZE_ADDRESS__)
  return static_cast<double>(
      __sanitizer_get_current_allocated_bytes());  // not what its quarantine holds back
#else
  double pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
#endif
}

TEST_F(Sequence, MemoryDoesNotGrowWithFrames) {
  Scene scene = test::ring_box(98);
  double early = 0, late = 0;
  reference_sequence(&scene, small(), [&](const SequenceFrame& f) {
    if (f.frame == 15) early = bytes_held();
    if (f.frame == 95) late = bytes_held();
  });
  EXPECT_LT(late - early, 2e6);
}

// The ring of colonnade-dynamic flies through free air: no edge of its triangles meets what stands still.
TEST(MovingScenes, TheRingTouchesNothing) {
  Scene scene = load_scene("colonnade-dynamic", {fs::path(VSGLBENCH_SOURCE_DIR) / "scenes", ""});
  Scene still = scene;
  still.animation = {};
  still.triangles.resize(still_triangles(scene));
  const Tracer tracer(still);
  for (uint32_t frame = 0; frame < frame_count(scene); ++frame) {
    set_frame(&scene, frame);
    for (size_t i = still_triangles(scene); i < scene.triangles.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const glm::uvec3& t = scene.triangles[i];
        ASSERT_FALSE(tracer.occluded(scene.positions[t[k]], scene.positions[t[(k + 1) % 3]])) << frame;
      }
    }
  }
}

}  // namespace
}  // namespace vsglbench
