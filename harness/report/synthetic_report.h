// A small report with every field filled, for the tests of this room.
#pragma once

#include "report/report.h"

namespace vsglbench {

inline PassTiming synthetic_pass(const std::string& name, double ms) {
  return {parse_pass_name(name), summarize({ms, 1.25 * ms, 0.75 * ms, ms})};
}

inline CaseResult synthetic_case(const std::string& id) {
  CaseResult c;
  c.id = id;
  c.scene = "cornell";
  c.method = "mfis";
  c.parameters = {{"lights", 256}, {"k", 1.0}, {"visibility", "exact"}};
  c.passes = {synthetic_pass("gbuffer", 2), synthetic_pass("generate.gbuffer.mipmap", 0.5),
              synthetic_pass("generate.rsm.mipmap", 1), synthetic_pass("generate.rsm.filter", 3),
              synthetic_pass("shade", 20)};
  c.frame = frame_timing({27, 33.5, 20.5, 27}, c.passes);
  c.frame->host_visibility = summarize({90, 110, 100, 100});
  GenerateResult g;
  g.gbuffer_ms = 0.5;
  g.rsm_ms = 4;
  g.total = *generate_time(c.passes);
  g.lights = 256;
  g.empty = 2;
  g.overlap = 0.25;
  g.gap = 0.125;
  g.shaders = 5;
  g.dispatches = 7;
  g.memory_bytes = 1 << 20;
  g.flux = FluxResult{0.9, Interval{0.85, 0.95}, 0.8, 1.0};
  c.generate = g;
  for (uint64_t seed = 0; seed < 8; ++seed) {
    const double d = static_cast<double>(seed) - 3.5;
    c.seeds.push_back({seed,
                       {12 + 0.1 * d, 0.02, 0.1, 0.3, -0.01 + 0.001 * d, 1000, 11 + 0.1 * d, 0.75,
                        0.2 + 0.01 * d, 0.5, 2.5},
                       0.9,
                       Coverage{0.25 + 0.01 * d, 0.125, 0.5, 0.25 + 0.01 * d},
                       KernelStats{6 + d, 1.25, 0.0625, 0.5},
                       0.8 + 0.01 * d,
                       0.001,
                       0.25 + 0.01 * d,
                       RegionErrors{14, 0.03, -0.02, 0.7 + 0.01 * d}});
  }
  ReferenceInfo reference{"0123abcd", 1024, 0.5,   0.001, 0.4,   0.01,   0.002,
                          0.03,       0.25, 0.125, 16,    0.002, "floor"};
  c.accuracy = accuracy_over_seeds(c.seeds, reference);
  c.accuracy->quantiles = ErrorQuantiles{5, 80, 150};
  c.temporal = Temporal{{0.1, 0.2, 3, {0.1, 0.1, 0.2}, Interval{0.09, 0.11}, "a-formula", {0.09, 0.11}},
                        FlickerSeries{0.05, 0.1, 1, {0.05, 0.1}, std::nullopt, "b-formula", {}},
                        DetailResult{0.9, 0.95, Interval{0.8, 1}, "c-formula", {0.8, 1}},
                        0.01,
                        0.3,
                        4,
                        2,
                        {"r0", "r1", "r2", "r3"}};
  c.health = HealthReport{0, 0, 3, std::nullopt};
  c.stopping = Stopping{StopReason::converged, 4, 2};
  c.images = {{"indirect", "images/a.exr"}, {"reference", "images/r.exr"}, {"error", "images/e.exr"}};
  return c;
}

// A case of which only the generation was measured.
inline CaseResult synthetic_generation(const std::string& id, double ms) {
  CaseResult c = synthetic_case(id);
  c.measure = Measure::generation;
  c.passes = {synthetic_pass("generate.gbuffer.sample", 0.25 * ms),
              synthetic_pass("generate.rsm.sample", 0.75 * ms)};
  c.frame = frame_timing({ms, 1.25 * ms, 0.75 * ms, ms}, c.passes);
  c.generate->total = *generate_time(c.passes);
  c.generate->gbuffer_ms = 0.25 * ms;
  c.generate->rsm_ms = 0.75 * ms;
  c.accuracy.reset();
  c.temporal.reset();
  c.seeds.clear();
  c.images.clear();
  return c;
}

inline CaseResult synthetic_failure(const std::string& id, Status status, const std::string& message) {
  CaseResult c;
  c.id = id;
  c.scene = "cornell";
  c.method = "vpl";
  c.status = status;
  c.error = CaseError{ErrorKind::case_failed, message};
  return c;
}

inline TimeNoise synthetic_noise(const std::string& column, double floor) {
  const Ratio ratio{1.002, {0.99, 1 + floor}};
  return {column, ratio, noise_floor(ratio)};
}

inline Report synthetic_report() {
  Report r;
  r.created = "2024-05-01T12:00:00Z";
  r.argv = {"vsglbench", "run", "configs/quick.json"};
  r.git = {std::string(40, 'a'), true};
  r.device = {"llvmpipe", "cpu", "Mesa", "22.3.6", "1.3.230", 8, 1.0, {{"LP_NATIVE_VECTOR_WIDTH", "512"}}};
  r.host = {"A CPU", "An OS", 2, 1ull << 33, 0.25, 2.5};
  r.config = {{"name", "quick"}, {"seeds", 8}};
  r.complete = true;
  r.wall = {60, 40, 5, 6, 4, 1.125};
  r.scenes = {
      {"cornell", "ffee", 36, {"one thing was ignored"}, {1, 2, 3}, 0.5, "cornell/contact.png", {"a note"}}};
  r.scenes[0].effects = {{"normal_maps",
                          "no lit or seen surface has one",
                          false,
                          {"gbuffer", "rsm"},
                          Interval{0.1, 0.3},
                          0.2,
                          4096}};
  r.scenes[0].effects_priced =
      EffectPricing{"cornell/mfis", 4, 10, 21, {2.1, {2.0, 2.2}}, 1 << 20, 3 << 20, 1.5};
  r.scenes[0].region = Crop{1, 4, 30, 13};
  r.scenes[0].clocks = ClockReport{3, 1800, 1980, 3201, 3201, 62, 512.5, {"P0"}, {}};
  r.aa = {
      {"cornell",
       "cornell/mfis",
       "cornell/mfis#twin",
       {synthetic_noise("generate", 0.16), synthetic_noise("method", 0.04), synthetic_noise("frame", 0.02)}}};
  r.cases = {synthetic_case("cornell/mfis"),
             synthetic_failure("cornell/vpl", Status::failed, "a NaN in pass shade"),
             synthetic_failure("sponza/vpl", Status::skipped, "sponza.gltf is absent")};
  r.cases[2].scene = "sponza";
  r.cases[1].health = HealthReport{2, 1, 0, FirstBad{"shade", glm::uvec2(7, 9), std::nullopt}};
  return r;
}

}  // namespace vsglbench
