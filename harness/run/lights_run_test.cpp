// Lights of whole frames, without a process of their own.
#include "run/lights_run.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>

#include "base/file.h"
#include "image/exr.h"
#include "lights/moment_pictures.h"
#include "method/oracle.h"
#include "method/registry.h"
#include "run/scene_pdfs.h"
#include "scene/scene_file.h"

namespace vsglbench {
namespace {

Device& device() {
  static Device d;
  return d;
}

FrameParameters small() {
  return {.width = 96,
          .height = 54,
          .rsm = 128,
          .lights = 128,
          .importance_lights = 256,
          .visibility = Visibility::none};
}

class LightsRunTest : public ::testing::TestWithParam<const char*> {
 protected:
  LightsRunTest()
      : scene_(load_scene(GetParam(), {data_root() / "scenes", {}})),
        kernels_(device()),
        stage_(device(), kernels_, scene_) {}
  Frame frame(const std::string& method) {
    const MethodInfo& info = load_method(method, device().info());
    return Frame(stage_, info, resolve_parameters(info, Json::object()), small(), nullptr);
  }
  // A case of generation alone, on the PDFs that `pdf` names.
  static Case on_pdf(const std::string& method, const std::string& pdf) {
    Case c{.method = method, .frame = small()};
    c.method_parameters = resolve_parameters(find_method(method), Json::object());
    c.frame.pdf = pdf;
    return c;
  }
  static Coverage coverage(Frame& f, uint32_t seed, const KeptPdfs* shared) {
    const LightSet set = make_lights(f, seed, shared, small().rsm);
    EXPECT_GT(set.count(), set.empty()) << "no light";
    return coverage_of(set.shapes, set.count(), set.rsm, set.rsm, set.pdf).value();
  }

  Scene scene_;
  KernelLibrary kernels_;
  Stage stage_;
};

// [MFIS16 Fig. 1], where there is anything to be lit: weighted by the PDF, which both methods share here. In
// the mean over lattices: with so few lights some single ones on ring514 go the other way.
TEST_P(LightsRunTest, MfisOverlapsAndLeavesLessThanFis) {
  constexpr uint32_t kSeeds = 8;
  ScenePdfs pdfs(stage_);
  const auto mean_misses = [&](const std::string& method) {
    Frame f = frame(method);
    double sum = 0;
    const KeptPdfs& shared = pdfs.get(on_pdf(method, "mfis"));
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
      const Coverage c = coverage(f, seed, &shared);
      sum += *c.pdf_overlap + *c.pdf_gap;
    }
    return sum / kSeeds;
  };
  const double fis = mean_misses("fis"), mfis = mean_misses("mfis");
  EXPECT_LT(mfis, fis);
  EXPECT_GT(mfis, 0.1) << "squares can't tile this well";
  RecordProperty("fis", fmt::format("{:.4f}", fis));
  RecordProperty("mfis", fmt::format("{:.4f}", mfis));
}

// [MFIS16 §3.2]: `mfis` at K = 1 solves Eq. 2 for its kernels, so that each holds 1/N of the PDF, where a
// kernel of one texel is not too large already; those of `fis` are by the PDF at their centres alone, and
// some hold many times what they should [MFIS16 Fig. 5].
TEST_P(LightsRunTest, KernelsOfMfisHoldWhatTheyShould) {
  ScenePdfs pdfs(stage_);
  std::map<std::string, KernelStats> stats;
  for (const char* method : {"fis", "mfis"}) {
    Frame f = frame(method);
    const LightSet set = make_lights(f, 0, &pdfs.get(on_pdf(method, "mfis")), small().rsm);
    stats[method] = kernels_of(set.shapes, set.rsm, set.rsm, set.pdf).value();
    if (method != std::string("mfis")) continue;
    const auto masses = kernel_masses(set.shapes.squares, set.rsm, set.rsm, set.pdf);
    size_t wide = 0;
    for (size_t i = 0; i < masses.size(); ++i) {
      if (!(set.shapes.squares[i].z > 1.001f)) continue;
      ++wide;
      EXPECT_NEAR(masses[i], 1, 0.02) << i << ", side " << set.shapes.squares[i].z;
    }
    EXPECT_GT(wide, set.count() / 4);
  }
  EXPECT_GT(stats["fis"].largest, 1.5 * stats["mfis"].largest);
  EXPECT_GT(stats["fis"].spread, stats["mfis"].spread);
}

// An image of which one quarter is bright: the whole of the lights is drawn from there.
TEST_P(LightsRunTest, LightsAreDrawnByAnImage) {
  const auto path =
      std::filesystem::temp_directory_path() / fmt::format("vsglbench_quarter_{}.exr", ::getpid());
  Image quarter(6, 6);
  for (uint32_t i = 0; i < 9; ++i) quarter.at(3 + i % 3, i / 3) = glm::vec3(0.5f);
  write_exr(path, quarter);
  ScenePdfs pdfs(stage_);
  const auto half = static_cast<float>(small().rsm) / 2;
  for (const char* method : {"mfis", "fis"}) {
    Frame f = frame(method);
    const LightSet set = make_lights(f, 1, &pdfs.get(on_pdf(method, path.string())), small().rsm);
    ASSERT_EQ(set.shapes.squares.size(), small().lights);
    for (const glm::vec4& s : set.shapes.squares) {
      EXPECT_GE(s.z, 1) << "no light";
      EXPECT_TRUE(s.x >= half && s.y <= half) << method << ": " << s.x << " " << s.y;
    }
    for (size_t i = 0; i < set.pdf.size(); ++i) {
      const bool bright = i % set.rsm >= set.rsm / 2 && i / set.rsm < set.rsm / 2;
      EXPECT_EQ(set.pdf[i], bright ? 1 : 0) << i;
    }
  }
  std::filesystem::remove(path);
}

// By its definition: the power that each texel reflects.
TEST_P(LightsRunTest, LightsAreDrawnByFlux) {
  ScenePdfs pdfs(stage_);
  Frame f = frame("mfis");
  FrameParameters by_flux = small();
  by_flux.importance = Importance::flux;
  const MethodInfo& info = load_method("mfis", device().info());
  Frame whole(stage_, info, resolve_parameters(info, Json::object()), by_flux, nullptr);
  const LightSet set = make_lights(f, 2, &pdfs.get(on_pdf("mfis", "flux")), small().rsm);
  whole.render(2);
  EXPECT_EQ(set.pdf, whole.results().importance());
  EXPECT_TRUE(set.lights == whole.results().lights());
}

// Each method's own PDF is that of its whole frame, whoever asked before.
TEST_P(LightsRunTest, LightsAreDrawnByAMethodsOwn) {
  ScenePdfs pdfs(stage_);
  for (const char* method : {"vpl", "mfis", "vpl"}) {
    Frame f = frame(method);
    const LightSet set = make_lights(f, 0, &pdfs.get(on_pdf(method, "own")), small().rsm);
    f.render(0);
    EXPECT_EQ(set.pdf, f.results().importance()) << method;
    EXPECT_TRUE(f.results().lights() == set.lights) << method;
  }
}

// Every texel that reflects is in one cluster.
TEST_P(LightsRunTest, APartitionLeavesNothingThatThePdfWants) {
  Frame f = frame("kmeans2d");
  const Coverage c = coverage(f, 0, nullptr);
  EXPECT_EQ(c.overlap, 0);
  EXPECT_EQ(*c.pdf_gap, 0);
  EXPECT_LT(c.gap, 1);
}

// What is drawn is what a frame is shaded with.
TEST_P(LightsRunTest, LightsAreThoseOfTheFrame) {
  for (const char* method : {"mfis", "mfis-mh", "vpl", "two-vsgl"}) {
    Frame f = frame(method);
    const LightSet set = make_lights(f, 3, nullptr, small().rsm);
    f.render(3);
    EXPECT_TRUE(f.results().lights() == set.lights) << method;
    EXPECT_EQ(set.pdf, f.results().importance()) << method;
  }
}

// The RSM as rendered, for the oracle.
oracle::Half half_of(const Frame& frame) {
  oracle::Half half{.emitter = frame.light()};
  const auto map = [&](const DeviceImage& image) {
    return image ? download_map(image)
                 : std::vector<glm::vec4>(size_t(half.emitter.width) * half.emitter.height, glm::vec4(0));
  };
  const auto& maps = frame.rsm().maps;
  const auto positions = map(maps[0]), normals = map(maps[1]), faces = map(frame.rsm().geometric_normals()),
             diffuse = map(maps[3]), f0 = map(maps[4]);
  for (size_t i = 0; i < positions.size(); ++i) {
    const glm::vec3 position(positions[i]);
    const glm::vec3 view =
        half.emitter.perspective ? glm::normalize(half.emitter.position - position) : -half.emitter.forward;
    glm::vec3 normal(normals[i]);
    // Normals of faces are bent when they are read (shaders/shading_normal.glsl).
    const float cosine = glm::dot(normal, view);
    if (!maps[2] && cosine < 0.01f) normal = glm::normalize(normal + (0.01f - cosine) * view);
    half.texels.push_back({.position = position,
                           .normal = normal,
                           .geometric_normal = glm::vec3(faces[i]),
                           .diffuse = glm::vec3(diffuse[i]),
                           .f0 = glm::vec3(f0[i]),
                           .ndf = maps[4] ? normals[i].w : 1.0f,
                           .surface = positions[i].w > 0});
  }
  return half;
}

// [MFIS16 Fig. 4] shows what filtered sampling read of this scene, not what another frame or half left.
TEST_P(LightsRunTest, MomentsAreMeansOverTheRsmsTexels) {
  Frame f = frame("mfis");
  make_lights(f, 0, nullptr, small().rsm);
  const auto rsm = read_mipmapped_rsm(f.method_context(), small().rsm, small().rsm);
  ASSERT_TRUE(rsm);
  const oracle::Half half = half_of(f);
  std::vector<oracle::Sums> texels;
  for (uint32_t i = 0; i < small().rsm * small().rsm; ++i)
    texels.push_back(oracle::texel_sums(half, i % small().rsm, i / small().rsm));
  // Blocks that tile each level: 1, 8, 64 and all 128 texels a side.
  for (const uint32_t l : {0u, 3u, 6u, 7u}) {
    const MomentLevel& level = rsm->levels.at(l);
    std::vector<oracle::Sums> sums(level.texels.size());
    for (uint32_t i = 0; i < texels.size(); ++i)
      sums[((i / small().rsm) >> l) * level.width + ((i % small().rsm) >> l)].add(texels[i],
                                                                                  std::exp2(-2.0 * l));
    size_t lit = 0;
    for (size_t i = 0; i < sums.size(); ++i) {
      const double diffuse = oracle::luminance(sums[i].diffuse),
                   specular = oracle::luminance(sums[i].specular), all = diffuse + specular;
      SCOPED_TRACE(fmt::format("level {}, texel {}", l, i));
      const MomentTexel& t = level.texels[i];
      ASSERT_NEAR(luminance(t.diffuse + t.specular), all, 1e-5 * all);
      if (!(all > 0)) continue;
      ++lit;
      ASSERT_LT(glm::length(glm::dvec3(t.position) - sums[i].position / all), 1e-4);
      ASSERT_NEAR(t.square, sums[i].square / all, 1e-4 * std::max(1.0, sums[i].square / all));
      if (diffuse > 0) {
        ASSERT_LT(glm::length(glm::dvec3(t.diffuse_direction) - sums[i].diffuse_direction / diffuse), 1e-4);
      }
      if (specular > 0) {
        ASSERT_LT(glm::length(glm::dvec3(t.specular_direction) - sums[i].specular_direction / specular),
                  1e-4);
      }
    }
    EXPECT_GT(lit, 0u);
  }
  Frame clusters = frame("kmeans2d");
  make_lights(clusters, 0, nullptr, small().rsm);
  EXPECT_FALSE(read_mipmapped_rsm(clusters.method_context(), small().rsm, small().rsm));
}

// [VSGL14 Fig. 2]: what is larger on edges is so beside what its own square spans elsewhere.
TEST_P(LightsRunTest, LightsOnEdgesAreLarger) {
  Frame f = frame("mfis");
  const LightSet set = make_lights(f, 0, nullptr, small().rsm);
  ASSERT_EQ(set.edges.size(), set.count());
  for (const FootprintEdges& e : set.edges) EXPECT_TRUE(e.share >= 0 && e.share <= 1) << e.share;
  const EdgeEffect effect = edge_effect(set.lights, set.shapes.squares, set.edges);
  EXPECT_GT(effect.on + effect.off, 0u);
  if (!effect.sigma) GTEST_SKIP() << effect.on << " lights on edges, " << effect.off << " off them";
  RecordProperty("sigma_ratio", fmt::format("{:.3f}", effect.sigma->value));
  RecordProperty("density_ratio", fmt::format("{:.3f}", effect.density->value));
  EXPECT_GT(effect.sigma->value, 1);
}

// Over the process boundary nothing is lost.
TEST(LightsResultJson, IsReadAsWritten) {
  const LightsResult all{.id = "a/b/c",
                         .seed = 7,
                         .status = Status::ok,
                         .folder = "a/b/c",
                         .lights = 9,
                         .empty = 2,
                         .coverage = Coverage{0.5, 0.25, 0.125, 0.0625},
                         .edges = EdgeEffect{3, 4, Ratio{1.5, {1.25, 1.75}}, Ratio{0.5, {0.25, 0.75}}}};
  LightsResult read;
  from_json(Json::parse(to_json(all).dump()), &read);
  EXPECT_EQ(read.seed, 7u);
  EXPECT_EQ(read.edges->on, 3u);
  EXPECT_EQ(read.edges->off, 4u);
  EXPECT_EQ(read.edges->sigma->ci95.hi, 1.75);
  EXPECT_EQ(read.edges->density->value, 0.5);
  EXPECT_EQ(to_json(read), to_json(all));
  const LightsResult few{.id = "a", .edges = EdgeEffect{1, 2, std::nullopt, std::nullopt}};
  from_json(to_json(few), &(read = {}));
  EXPECT_EQ(read.edges->off, 2u);
  EXPECT_FALSE(read.edges->sigma || read.edges->density || read.coverage);
}

INSTANTIATE_TEST_SUITE_P(Scenes, LightsRunTest, ::testing::Values("cornell", "ring514", "colonnade"));

}  // namespace
}  // namespace vsglbench
