// The check `image` of the conformance kit: whole frames of a small scene.
#include <algorithm>
#include <cmath>

#include "base/file.h"
#include "conformance/inspection.h"
#include "frame/frame.h"
#include "scene/scene_file.h"

namespace vsglbench {
namespace {

// A scene with the method's frames of it.
class SceneFrames {
 public:
  SceneFrames(Inspection& inspection, const Scene& scene)
      : info_(inspection.info()), stage_(inspection.device(), inspection.kernels(), scene) {}
  std::unique_ptr<Frame> make(const EffectSet& effects = EffectSet::all()) {
    const FrameParameters parameters{.width = 64,
                                     .height = 36,
                                     .rsm = 40,
                                     .lights = 64,
                                     .importance_lights = 96,
                                     .visibility = Visibility::none,
                                     .effects = effects};
    return std::make_unique<Frame>(stage_, info_, resolve_parameters(info_, Json::object()), parameters,
                                   nullptr);
  }

 private:
  const MethodInfo& info_;
  Stage stage_;
};

Image render(Frame& frame, uint32_t seed) {
  frame.render(seed);
  return frame.results().indirect();
}

std::string pixel_name(const Image& image, size_t i) {
  return fmt::format("pixel ({},{})", i % image.width, i / image.width);
}

std::string difference(const Image& a, const Image& b) {
  const auto [at, other] = std::ranges::mismatch(a.pixels, b.pixels);
  return at == a.pixels.end() ? "" : pixel_name(a, at - a.pixels.begin()) + " differs";
}

// The first pixel that is not a finite radiance ≥ 0, or where `black` not 0.
std::string bad_pixel(const Image& image, bool black) {
  const auto bad = [&](const glm::vec3& c) {
    for (const float v : {c.x, c.y, c.z}) {
      if (!std::isfinite(v) || v < 0 || (black && v > 0)) return true;
    }
    return false;
  };
  const auto at = std::ranges::find_if(image.pixels, bad);
  if (at == image.pixels.end()) return "";
  return fmt::format("{} is ({}, {}, {}); expected {}", pixel_name(image, at - image.pixels.begin()), at->x,
                     at->y, at->z, black ? "0" : "finite radiance ≥ 0");
}

// What is wrong with the image of a frame and the lights that made it; empty: nothing. A light that is not
// finite may leave no trace in the image.
std::string fault_of(Frame& frame, const Image& image, bool black) {
  if (const auto bad = bad_pixel(image, black); !bad.empty()) {
    const auto pass = frame.results().first_bad_pass();
    return bad + (pass ? fmt::format("; first bad pass: {}", *pass) : "");
  }
  const auto values = frame.results().bad_values();
  return values ? values->message() + "; expected finite numbers" : "";
}

void check_repeated(Inspection& inspection, const Scene& scene) {
  inspection.on("scene cornell, 64×36, RSM 40×40, N = 64", [&] {
    SceneFrames frames(inspection, scene);
    const auto frame = frames.make();
    const Image first = render(*frame, 3);
    if (const auto fault = fault_of(*frame, first, false); !fault.empty()) return inspection.found(fault);
    render(*frame, 4);
    const auto compare = [&](const char* what, const Image& again) {
      const auto differs = difference(first, again);
      if (!differs.empty()) inspection.found(fmt::format("{}: {}; expected the same bits", what, differs));
    };
    compare("a later frame of the same seed", render(*frame, 3));
    compare("a new frame of the same seed", render(*frames.make(), 3));
    SceneFrames fresh(inspection, scene);
    compare("the same seed with scratch memory of its own", render(*fresh.make(), 3));
  });
}

// Σ |a - b| / Σ b over pixels and channels.
double mean_difference(const Image& a, const Image& b) {
  double difference = 0, sum = 0;
  for (size_t i = 0; i < b.pixels.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      difference += std::abs(double(a.pixels[i][k]) - b.pixels[i][k]);
      sum += b.pixels[i][k];
    }
  }
  return sum > 0 ? difference / sum : difference;
}

// The scene is Lambertian: without its specular lobes the image is the same but for rounding, which may tip a
// decision of the method; and without its diffuse ones it is black.
void check_lobes(Inspection& inspection, const Scene& scene) {
  const EffectSet diffuse = EffectSet::none().add(Effect::diffuse_receivers).add(Effect::diffuse_emitters);
  const EffectSet specular = EffectSet::none().add(Effect::glossy_receivers).add(Effect::glossy_emitters);
  inspection.on("scene cornell, 64×36, RSM 40×40, N = 64, without specular lobes", [&] {
    SceneFrames frames(inspection, scene);
    const auto all = frames.make(), some = frames.make(diffuse);
    const double difference = mean_difference(render(*some, 3), render(*all, 3));
    if (difference < 1e-3) return;
    inspection.found(fmt::format(
        "the image differs by {:.3g} in the mean from the one with both lobes; expected less than 0.001",
        difference));
  });
  inspection.on("scene cornell, 64×36, RSM 40×40, N = 64, without diffuse lobes", [&] {
    SceneFrames frames(inspection, scene);
    const auto frame = frames.make(specular);
    const auto fault = fault_of(*frame, render(*frame, 3), true);
    if (!fault.empty()) inspection.found(fault);
  });
}

void check_black(Inspection& inspection, const Scene& scene, const char* what) {
  inspection.on(fmt::format("scene cornell, 64×36, RSM 40×40, N = 64, {}", what), [&] {
    SceneFrames frames(inspection, scene);
    const auto frame = frames.make();
    const auto fault = fault_of(*frame, render(*frame, 3), true);
    if (!fault.empty()) inspection.found(fault);
  });
}

}  // namespace

void check_image(Inspection& inspection) {
  const Scene scene = load_scene("cornell", {data_root() / "scenes", {}});
  check_repeated(inspection, scene);
  check_lobes(inspection, scene);
  Scene dark = scene;
  dark.light.power = glm::vec3(0);
  check_black(inspection, dark, "a light of no flux");
  Scene empty = scene;
  empty.light.position = empty.bounds_max + glm::vec3(10);
  empty.light.direction = {0, 1, 0};
  empty.light.up = {1, 0, 0};
  check_black(inspection, empty, "a light that sees no surface");
}

}  // namespace vsglbench
