// Ground truth: the one-bounce indirect image with exact BRDFs and exact visibility.
// Sources: [light-transport §7]; Veach 1997 ch. 9 (balance heuristic); Jensen 1996 (density estimation,
// here over a pixel's own footprint).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"
#include "reference/light_guide.h"
#include "reference/ray_stream.h"
#include "reference/tracer.h"
#include "scene/scene.h"

namespace vsglbench {

// How a path light -> x1 -> x2 -> eye is found; any sum of them may be combined.
enum Strategy : uint32_t {
  strategy_light = 1,     // x1 seen from the light, connected to x2
  strategy_receiver = 2,  // x1 found by sampling the BRDF of x2
  strategy_emitter = 4,   // x2 found by sampling the BRDF of x1, and splatted
  strategy_all = 7,
};

// Which adjoint of the BRDF a shading normal n beside the face's n_g makes at x1, where cosines with the
// light and with x2 both stand (Veach 1997 §5.3). Where n = n_g they are one.
enum class ShadingNormals {
  light,   // (n_g.light)(n.x2): light traced from the light, as every virtual-light method has it
  camera,  // (n.light)(n_g.x2): paths traced from the eye
};

struct ReferenceParameters {
  uint32_t width = 480, height = 272;
  uint32_t samples = 256;  // a pixel, of `light` and, at sharp BRDFs, of `receiver`; up to whole batches
  // Independent estimates of the whole image; even, at least 2. More are made of an image and samples so many
  // that one batch's pool of x1 would be too small for it (33 M samples a batch).
  uint32_t batches = 16;
  // Percent; > 0: more batches of the same size follow until noise_floor_smape is no more.
  double floor = 0;
  // Photons of `emitter` per pixel and sample; 0: 1/32, and a quarter of the share of the light's flux
  // that sharp lobes reflect, which no other strategy follows.
  float photons_a_sample = 0;
  uint64_t seed = 1;
  bool occlusion = true;  // false: nothing lies between x1 and x2 (light -> x1 and x2 -> eye stay tested)
  uint32_t strategies = strategy_all;
  ShadingNormals shading_normals = ShadingNormals::light;
  // Seconds; > 0 may end the work after any even number of batches: the result depends on the machine then.
  // It is what ends the search for a `floor` that lies out of reach.
  double time_limit = 0;
  unsigned threads = 0;  // 0: all; changes no bit of the result
};

// What ended the work: the samples asked for were taken, `floor` was reached, or time was up.
enum class ReferenceEnd { samples, floor, time_limit };
std::string_view name(ReferenceEnd end);        // "samples", "floor", "time_limit"
std::string_view name(ShadingNormals normals);  // "light", "camera"
std::optional<ShadingNormals> shading_normals_named(std::string_view name);

struct ReferenceResult {
  Image mean;                    // W/sr/m^2, indirect radiance at the pixel centres towards the eye
  Image variance;                // of the mean, per pixel and channel, from the scatter of the batches
  Image half[2];                 // means of the even and of the odd batches
  std::vector<uint8_t> mask;     // 1 where the camera sees a surface
  double noise_floor_smape = 0;  // noise_floor_of() the halves over the mask, `smape-0-200`
  // The standard error of the mean over the mask's pixels and channels, relative to it, from the scatter of
  // the batches' means. The pixels share their x1, so that `variance` alone doesn't tell it.
  double standard_error = 0;
  ReferenceEnd ended_by = ReferenceEnd::samples;
  uint32_t samples = 0;  // a pixel, done
  uint32_t batches = 0;  // done
  uint64_t photons = 0, rays = 0;
  double seconds = 0;
  std::string hash;  // of the scene and of everything above that determines the image
};

// What a pose teaches of where its light comes from: where to sample, and how often, which any pose may go by
// without bias. A computation teaches itself; frames that differ little but are all taught by one of them
// also take the same samples, and have their noise in common.
struct Guidance {
  std::string taught_by;  // Scene::hash; of several poses, hash_of_teachers()
  LightGuide light, photons;
  double sharp = 0;  // the share of the light's flux that sharp lobes reflect
};

// By a third of the work of a reference with 16 batches, and random numbers that no reference uses.
Guidance learn_guidance(const Tracer& tracer, const ReferenceParameters& parameters);

// Content hash of scene, parameters, algorithm version and, unless it teaches itself, who taught it: the
// cache's key.
std::string reference_hash(const Scene& scene, const ReferenceParameters& parameters,
                           const std::string& taught_by = "");

// Same seed, same bits, whatever the number of threads. A black image is a legal answer. Throws
// Error(case_failed) when the camera or the light sees no surface, Error(config) for bad parameters.
// `logs`, if given, receives every ray, in order, of each thread. `guidance` must be of the same parameters.
ReferenceResult compute_reference(const Tracer& tracer, const ReferenceParameters& parameters,
                                  std::vector<RayLog>* logs = nullptr, const Guidance* guidance = nullptr);
ReferenceResult compute_reference(const Scene& scene, const ReferenceParameters& parameters);

}  // namespace vsglbench
