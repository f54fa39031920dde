// The PDF on the RSM against the integral that it approximates: what each texel's light is worth to the eye
// with exact BRDFs at both ends, the mean over the pixels of Φ f f cos cos/d² [VSGL14 §3; Ritschel et al.
// 2011], or the root of the mean of its square.
#include <gtest/gtest.h>

#include "frame/light_ranges.h"
#include "run/laboratory.h"
#include "shaders/shading_exact.h"
#include "stability/planted_tree.h"

using namespace vsglbench;
using glm::dvec3;

namespace {

constexpr uint32_t kRsm = 16;
constexpr double kTolerance = 0.01;  // of each figure of the table

// What the emitter of a half sees at texel i, as a light of the flux that the emitter gives it.
std::vector<gpu::Vpl> texels_of(const DeferredTargets& targets, const gpu::Emitter& emitter) {
  std::array<std::vector<glm::vec4>, 5> maps;
  for (size_t m = 0; m < maps.size(); ++m) maps[m] = download_map(targets.maps[m]);
  const double area = 4.0 * emitter.extent.x * emitter.extent.y / (double(emitter.width) * emitter.height);
  std::vector<gpu::Vpl> texels(maps[0].size());
  for (uint32_t i = 0; i < texels.size(); ++i) {
    if (!(maps[0][i].w > 0)) continue;
    gpu::Vpl& t = texels[i];
    t.position = glm::vec3(maps[0][i]);
    t.normal = glm::vec3(maps[1][i]);
    t.ndf = maps[1][i].w;
    t.geometric_normal = glm::vec3(maps[2][i]);
    t.diffuse = glm::vec3(maps[3][i]);
    t.f0 = glm::vec3(maps[4][i]);
    t.incident = glm::normalize(emitter.position - t.position);
    const double x = (2 * (i % emitter.width + 0.5) / emitter.width - 1) * emitter.extent.x;
    const double y = (1 - 2 * (i / emitter.width + 0.5) / emitter.height) * emitter.extent.y;
    const double cosine3 = std::pow(1 + x * x + y * y, -1.5);
    t.flux = emitter.importance != 0 ? glm::vec3(1 / (float(emitter.width) * float(emitter.height)))
                                     : emitter.power * static_cast<float>(area * cosine3);
    t.power = 1;
  }
  return texels;
}

// Either mean for each texel of the RSM, of the laboratory's frame; computed once, since nothing that is
// planted here changes what is seen.
const std::vector<double>& integrals(Laboratory& lab, ImportanceNorm norm) {
  static std::map<std::pair<uint32_t, ImportanceNorm>, std::vector<double>> all;
  std::vector<double>& out = all[{lab.width, norm}];
  if (!out.empty()) return out;
  const auto pixels = texels_of(lab.stage.targets(Half::gbuffer, lab.width, lab.height), lab.camera);
  const auto count = static_cast<double>(pixels.size());
  for (const gpu::Vpl& texel : texels_of(lab.stage.targets(Half::rsm, kRsm, kRsm), lab.light)) {
    double sum = 0;  // of what the texel adds to a pixel, or of its square
    for (const gpu::Vpl& pixel : pixels) {
      if (!(texel.power > 0)) continue;
      // A pixel's flux is its share of the view.
      const dvec3 added = dvec3(texel.flux) * count * exact::shade_vpl(exact::surface_of(texel), pixel);
      const double p = glm::dot(added, dvec3(0.2126, 0.7152, 0.0722));
      sum += norm == ImportanceNorm::l1 ? p : p * p;
    }
    out.push_back(norm == ImportanceNorm::l1 ? sum / count : std::sqrt(sum / count));
  }
  return out;
}

// Bias and root mean square over the mean of the integral; the mean of |x-r|/((x+r)/2).
struct Difference {
  double bias = 0, rrmse = 0, smape = 0;
  double largest_change(const Difference& o) const {
    return std::max({std::abs(bias - o.bias), std::abs(rrmse - o.rrmse), std::abs(smape - o.smape)});
  }
};

constexpr uint32_t kLarge = 130;  // pixels, across and down; all as lights are more than one dispatch takes
static_assert(kLarge * kLarge > most_lights_of_a_dispatch);

// The PDF by `importance` with this many lights on the G-buffer, against the integral; where they are those
// of the large frame, in that.
Difference difference(const char* importance, uint32_t lights, ImportanceNorm norm = ImportanceNorm::l1) {
  Laboratory lab("cornell-glossy");
  if (lights == kLarge * kLarge) lab.width = lab.height = kLarge;
  lab.importance_lights = lights;
  lab.render("mfis", Json::object(),
             {.rsm = kRsm,
              .lights = 16,
              .visibility = Visibility::none,
              .importance = parse_importance(importance),
              .importance_norm = norm});
  const std::vector<double>& exact = integrals(lab, norm);
  const auto count = static_cast<double>(exact.size());
  double sum = 0, integral = 0, square = 0, symmetric = 0;
  for (size_t i = 0; i < exact.size(); ++i) {
    const double p = lab.importance[i], r = exact[i];
    sum += p;
    integral += r;
    square += (p - r) * (p - r);
    symmetric += p + r > 0 ? 2 * std::abs(p - r) / (p + r) : 0;
  }
  const Difference d{sum / integral - 1, std::sqrt(square / count) / (integral / count), symmetric / count};
  std::printf("importance %s, %u lights, %s: bias %+.4f, rRMSE %.4f, SMAPE %.4f\n", importance, lights,
              importance_norm_names()[static_cast<size_t>(norm)].c_str(), d.bias, d.rrmse, d.smape);
  return d;
}

}  // namespace

// Tabled as measured; VPLs sample the integral, VSGLs have their lobes' errors besides, and at
// l2 the reflectance in their power.
TEST(ImportanceOracle, ThePdfIsTheIntegral) {
  struct Row {
    const char* importance;
    uint32_t lights;
    Difference tabled;
    ImportanceNorm norm = ImportanceNorm::l1;
  };
  for (const Row& row : {Row{"vpl", 256, {-0.1063, 0.7024, 0.1761}},
                         {"vpl", 4096, {-0.0129, 0.2011, 0.0192}},
                         {"vsgl", 256, {-0.2638, 1.1159, 0.2436}},
                         {"vsgl", 4096, {-0.1280, 0.5382, 0.1483}},
                         {"vpl", 4096, {-0.0416, 0.6414, 0.0327}, ImportanceNorm::l2},
                         {"vsgl", 4096, {-0.2212, 2.3503, 0.2053}, ImportanceNorm::l2},
                         {"vpl", kLarge * kLarge, {-0.0008, 0.1828, 0.0180}, ImportanceNorm::l2}}) {
    EXPECT_LT(difference(row.importance, row.lights, row.norm).largest_change(row.tabled), kTolerance)
        << row.importance << " " << row.lights << " " << static_cast<int>(row.norm);
  }
}

TEST(ImportanceOracle, SeesPlantedFaults) {
  struct Fault {
    const char *importance, *file, *text, *in_its_place;
    uint32_t lights = 256;
    ImportanceNorm norm = ImportanceNorm::l1;
  };
  for (const Fault& f :
       {Fault{"vsgl", "VSGLBENCH_RECEIVER_GLSL", "r.peak = ndf_peak(s.ndf);",
              "r.peak = ndf_peak(s.ndf); float eta = r.eta_x; r.eta_x = r.eta_y; r.eta_y = eta;", 4096},
        Fault{"vpl", "VSGLBENCH_BRDF_GLSL", "fresnel(s.f0, dot(l, h))) * nl;", "fresnel(s.f0, dot(l, h)));"},
        Fault{"vsgl", "VSGLBENCH_RECEIVER_GLSL", "r.alpha) * cosine * lobe", "r.alpha) * lobe", 4096},
        Fault{"vpl", "// BRSM:", "float p = flux[j] *", "float p = 2.0 * flux[j] *"},
        Fault{"vpl", "// BRSM:", "p * (p / max(power, 1e-30))", "p * p", 256, ImportanceNorm::l2},
        Fault{"vpl", "// BRSM:", "? sqrt(sums[j]) :", "? sums[j] :", 256, ImportanceNorm::l2},
        Fault{"vpl", "// BRSM:", "sum * length(vec2(before, p) / max(sum, 1e-37))", "sum", kLarge * kLarge,
              ImportanceNorm::l2}}) {
    const Difference sound = difference(f.importance, f.lights, f.norm);
    const PlantedTree tree;
    size_t planted = 0;
    tree.edit_shaders([&](std::string text) {
      const size_t at = text.find(f.text);
      if (at == std::string::npos || text.find(f.file) == std::string::npos) return text;
      ++planted;
      return text.replace(at, std::string(f.text).size(), f.in_its_place);
    });
    ASSERT_EQ(planted, 1u) << f.text;
    EXPECT_GT(difference(f.importance, f.lights, f.norm).largest_change(sound), 2 * kTolerance)
        << f.in_its_place;
  }
}
