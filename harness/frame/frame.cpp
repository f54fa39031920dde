#include "frame/frame.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"
#include "frame/checked_method.h"
#include "method/filtered_sampling.h"
#include "method/registry.h"

namespace vsglbench {
namespace {

std::filesystem::path kernel_path(const char* file) { return data_root() / "harness" / "frame" / file; }

// Of the kernels that evaluate lights. VPLs have exact BRDFs, whatever is chosen for VSGLs.
ShaderDefines light_defines(LightKind kind, const Shading& shading) {
  ShaderDefines defines = kind == LightKind::vsgl ? shading_defines(shading) : ShaderDefines{};
  defines["LIGHT_VPL"] = kind == LightKind::vsgl ? "0" : "1";
  return defines;
}

// SplitMix64: one well-mixed word a seed.
uint64_t mix(uint64_t x) {
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

// Lights that one dispatch goes through. lavapipe ends a shader's loops after 65535 rounds in all, without a
// word: lights beyond would be left out of the sum.
constexpr uint32_t kMostLights = 16384;

struct LightRange {
  uint32_t first, count;
};

std::vector<LightRange> light_ranges(uint32_t count, uint32_t most) {
  std::vector<LightRange> ranges;
  for (uint32_t first = 0; first < count; first += most)
    ranges.push_back({first, std::min(most, count - first)});
  return ranges;
}

void add(FrameTimes& times, const SubmissionTimes& submission) {
  for (const PassTime& pass : submission.passes) {
    const auto same = std::find_if(times.passes.begin(), times.passes.end(),
                                   [&](const PassTime& p) { return p.name == pass.name; });
    if (same == times.passes.end()) {
      times.passes.push_back(pass);
    } else {
      same->ms += pass.ms;
    }
    times.sum_ms += pass.ms;
  }
  times.span_ms += submission.span_ms;
}

// The shift of one iteration: from the seed's own along Roberts' R2 sequence, so that the iterations'
// lattices fill each other's gaps.
glm::uvec2 iteration_shift(uint32_t seed, uint32_t iteration) {
  return lattice_shift(seed) + iteration * glm::uvec2(3242174889u, 2447445414u);
}

}  // namespace

const std::vector<std::string>& importance_names() {
  static const std::vector<std::string> names = {"own", "vsgl", "vpl", "flux"};
  return names;
}

Importance parse_importance(const std::string& name) {
  const auto& names = importance_names();
  const auto it = std::find(names.begin(), names.end(), name);
  if (it != names.end()) return static_cast<Importance>(it - names.begin());
  throw fail(ErrorKind::config, "no importance '{}'{}", name, suggestion(name, names));
}

glm::uvec2 lattice_shift(uint32_t seed) {
  const uint64_t word = mix(seed);
  return {static_cast<uint32_t>(word), static_cast<uint32_t>(word >> 32)};
}

std::string light_memory(Half half, size_t bytes) {
  return fmt::format("lights.{} of {} bytes", half_name(half), bytes);
}

Stage::Stage(Device& d, KernelLibrary& k, const Scene& s)
    : device(d), kernels(k), scene(s), scratch(d), geometry(d, s) {}

DeferredTargets& Stage::targets(Half half, uint32_t width, uint32_t height) {
  auto& slot = targets_[fmt::format("{} {}x{}", half_name(half), width, height)];
  if (!slot) slot = std::make_unique<DeferredTargets>(device, half_name(half), width, height);
  return *slot;
}

ImperfectShadowMaps& Stage::shadow_maps(Visibility technique, const IsmParameters& p) {
  auto& slot = shadow_maps_[{technique, p.size, p.points}];
  if (!slot) slot = std::make_unique<ImperfectShadowMaps>(kernels, scratch, scene, technique, p);
  return *slot;
}

Frame::Frame(Stage& stage, const MethodInfo& method, const Json& method_parameters,
             const FrameParameters& parameters, ExactVisibility exact)
    : stage_(stage),
      parameters_(parameters),
      context_(stage.kernels, stage.scratch, method.folder, shading_defines(parameters.shading)),
      method_(make_method(method, context_, method_parameters)),
      exact_(std::move(exact)),
      check_(parameters.check_passes ? std::make_unique<PassCheck>(outputs()) : nullptr),
      recorder_(stage.device),
      gbuffer_(&stage.targets(Half::gbuffer, parameters.width, parameters.height)),
      rsm_(&stage.targets(Half::rsm, parameters.rsm, parameters.rsm)) {
  const uint64_t texels = uint64_t(parameters.rsm) * parameters.rsm;
  const uint64_t pixels = uint64_t(parameters.width) * parameters.height;
  if (method.takes_light_count && (parameters.lights == 0 || parameters.lights > texels)) {
    throw fail(ErrorKind::case_failed, "N = {} lights can't be drawn from an RSM of {} texels; use 1 … {}",
               parameters.lights, texels, texels);
  }
  light_count_ = light_count_of(*method_, method.name, parameters.lights, texels);
  std::string importance_name = method.name;
  if (lights_gbuffer() && parameters.importance != Importance::own) {
    importance_name = parameters.importance == Importance::vsgl ? "mfis" : "vpl";
    const MethodInfo info = load_method(importance_name, stage.device.info());
    other_context_ = std::make_unique<MethodContext>(stage.kernels, stage.scratch, info.folder,
                                                     shading_defines(parameters.shading));
    other_method_ = make_method(info, *other_context_, resolve_parameters(info, Json::object()));
  }
  importance_count_ = light_count_of(
      importance_method(), importance_name,
      static_cast<uint32_t>(std::clamp<uint64_t>(parameters.importance_lights, 1, pixels)), pixels);
  const View camera = camera_view(stage.scene.camera, parameters.width, parameters.height);
  camera_ = make_emitter(camera, parameters.width, parameters.height, glm::vec3(1), true);
  light_ = make_emitter(light_view(stage.scene.light), parameters.rsm, parameters.rsm,
                        stage.scene.light.power, false);
  camera_buffer_ = Buffer(stage.device, "camera", sizeof camera_);
  camera_buffer_.upload(&camera_, sizeof camera_);
  light_view_buffer_ = Buffer(stage.device, "light", sizeof light_);
  light_view_buffer_.upload(&light_, sizeof light_);
  recorder_.observe(check_.get());
}

Frame::~Frame() = default;

Buffer& Frame::pdf_buffer(Half half) {
  const auto& t = half == Half::gbuffer ? *gbuffer_ : *rsm_;
  return stage_.scratch.get(fmt::format("pdf.{}", half_name(half)), pyramid_texels(t.width, t.height) * 4);
}

Buffer& Frame::light_buffer(Half half) const {
  const bool gbuffer = half == Half::gbuffer;
  const uint32_t count = gbuffer ? importance_count_ : light_count_;
  const size_t stride = light_stride((gbuffer ? importance_method() : *method_).kind());
  return stage_.scratch.get(light_memory(half, count * stride), count * stride);
}

Field Frame::field(Half half, const Buffer* pdf) {
  const bool camera = half == Half::gbuffer;
  Field f;
  f.half = half;
  f.emitter = camera ? camera_ : light_;
  f.maps = (camera ? gbuffer_ : rsm_)->pointers();
  f.pdf = pdf;
  return f;
}

FrameTimes Frame::render(uint32_t seed, bool watched) {
  FrameTimes times;
  generate_dispatches_ = 0;
  restart_check();
  memory_fault_.clear();
  for (uint32_t i = 0; i < parameters_.progressive; ++i) render_iteration(seed, i, watched, &times);
  times.generate_dispatches = generate_dispatches_;
  return times;
}

void Frame::render_iteration(uint32_t seed, uint32_t iteration, bool watched, FrameTimes* times) {
  if (watched) arm_memory();
  const glm::uvec2 shift = iteration_shift(seed, iteration);
  recorder_.begin();
  if (iteration == 0) draw_halves(recorder_);
  if (uses_importance()) make_importance(recorder_, shift);
  generate_lights(recorder_, uses_importance() ? &pdf_buffer(Half::rsm) : nullptr, shift);
  if (parameters_.visibility == Visibility::exact) {
    // The host traces between two submissions; its time is not the frame's.
    add(*times, recorder_.submit_and_wait());
    if (watched) look_at_memory();
    if (!memory_fault_.empty()) return;  // nothing to trace from
    trace_visibility();
    recorder_.begin();
  }
  shade(recorder_, seed, iteration);
  add(*times, recorder_.submit_and_wait());
  if (watched && parameters_.visibility != Visibility::exact) look_at_memory();
}

void Frame::trace_visibility() {
  auto points = light_points();
  const auto same = [](const LightPoint& a, const LightPoint& b) {
    return a.position == b.position && a.stop_short == b.stop_short;
  };
  if (std::equal(points.begin(), points.end(), traced_.begin(), traced_.end(), same)) return;
  bits_ = exact_(points);
  traced_ = std::move(points);
}

KeptPdfs Frame::prepare(uint32_t seed) {
  if (!uses_importance()) throw fail(ErrorKind::case_failed, "this method makes no PDFs");
  restart_check();
  recorder_.begin();
  draw_halves(recorder_);
  make_importance(recorder_, lattice_shift(seed));
  recorder_.submit_and_wait();
  if (const auto bad = bad_output()) throw fail(ErrorKind::case_failed, "the PDFs: {}", bad->message());
  const auto keep = [&](Half half, const char* name) {
    const Buffer& made = pdf_buffer(half);
    const DeferredTargets& t = half == Half::gbuffer ? *gbuffer_ : *rsm_;
    const size_t texels = pyramid_texels(t.width, t.height);
    Buffer kept(stage_.device, name, texels * sizeof(float));
    kept.upload(std::span<const float>(made.download<float>(texels)));
    return kept;
  };
  return {keep(Half::gbuffer, "kept pdf.gbuffer"), keep(Half::rsm, "kept pdf.rsm")};
}

FrameTimes Frame::generate_only(uint32_t seed, const KeptPdfs& pdfs, bool watched) {
  memory_fault_.clear();
  if (watched) arm_memory();
  const glm::uvec2 shift = lattice_shift(seed);
  FrameTimes times;
  generate_dispatches_ = 0;
  restart_check();
  recorder_.begin();
  if (lights_gbuffer()) generate_importance_lights(recorder_, &pdfs.gbuffer, shift);
  generate_lights(recorder_, uses_importance() ? &pdfs.rsm : nullptr, shift);
  add(times, recorder_.submit_and_wait());
  if (watched) look_at_memory();
  times.generate_dispatches = generate_dispatches_;
  return times;
}

void Frame::draw_halves(Recorder& r) {
  const View camera = camera_view(stage_.scene.camera, gbuffer_->width, gbuffer_->height);
  r.pass("gbuffer", [&] { stage_.geometry.draw(r, camera, camera_buffer_, *gbuffer_); });
  r.pass("rsm", [&] { stage_.geometry.draw(r, light_view(stage_.scene.light), light_view_buffer_, *rsm_); });
}

void Frame::build_pdf_mips(Recorder& r, const Buffer& pdf, uint32_t w, uint32_t h) {
  const Kernel& mip = stage_.kernels.get(kernel_path("pdf_mip.comp"));
  for (uint32_t level = 1; level <= pyramid_top(w, h); ++level) {
    const struct { uint32_t width, height, level; } push{w, h, level};
    r.barrier();
    r.dispatch(mip, {pdf}, push, groups_for(groups_for(w, 1u << level), 8),
               groups_for(groups_for(h, 1u << level), 8));
  }
}

void Frame::reflectance_pdf(Recorder& r, Half half) {
  const Field f = field(half, nullptr);
  const Buffer& pdf = pdf_buffer(half);
  r.dispatch(stage_.kernels.get(kernel_path("pdf_reflectance.comp")),
             {*f.maps[0], *f.maps[1], *f.maps[2], *f.maps[3], *f.maps[4], pdf}, f.emitter,
             groups_for(f.emitter.width, 8), groups_for(f.emitter.height, 8));
  build_pdf_mips(r, pdf, f.emitter.width, f.emitter.height);
}

void Frame::make_importance(Recorder& r, glm::uvec2 shift) {
  if (parameters_.importance == Importance::flux) {
    r.pass("importance.rsm", [&] { reflectance_pdf(r, Half::rsm); });
    return;
  }
  // 1. The eye's PDF on the G-buffer: reflectance.
  r.pass("importance.gbuffer", [&] { reflectance_pdf(r, Half::gbuffer); });
  // 2. Lights on the G-buffer.
  generate_importance_lights(r, &pdf_buffer(Half::gbuffer), shift);
  // 3. What they are worth at every RSM texel.
  const Buffer& lights = light_buffer(Half::gbuffer);
  const auto m = rsm_->pointers();
  const ShaderDefines defines = light_defines(importance_method().kind(), parameters_.shading);
  r.pass("importance.rsm", [&] {
    const Buffer& pdf = pdf_buffer(Half::rsm);
    for (const LightRange& range : light_ranges(importance_count_, kMostLights)) {
      const struct {
        gpu::Emitter emitter;
        LightRange range;
      } push{light_, range};
      if (range.first > 0) r.barrier();
      r.dispatch(stage_.kernels.get(kernel_path("importance.comp"), defines),
                 {*m[0], *m[1], *m[2], *m[3], *m[4], lights, pdf}, push, groups_for(light_.width, 8),
                 groups_for(light_.height, 8));
    }
    build_pdf_mips(r, pdf, light_.width, light_.height);
  });
}

void Frame::generate_importance_lights(Recorder& r, const Buffer* pdf, glm::uvec2 shift) {
  generate(r, importance_method(), field(Half::gbuffer, pdf),
           {&light_buffer(Half::gbuffer), importance_count_, shift});
}

void Frame::generate_lights(Recorder& r, const Buffer* pdf, glm::uvec2 shift) {
  generate(r, *method_, field(Half::rsm, pdf), {&light_buffer(Half::rsm), light_count_, shift});
}

void Frame::generate(Recorder& r, Method& method, const Field& f, const LightTarget& target) {
  const unsigned before = r.dispatches();
  Steps steps(r, f.half);
  method.generate(steps, f, target);
  generate_dispatches_ += r.dispatches() - before;
}

bool Frame::clears_sigma() const { return chosen(parameters_.shading, "light_clearance") == "sigma"; }

bool Frame::needs_light_texels() const {
  if (method_->kind() != LightKind::vsgl) return false;
  return parameters_.bias_reduction > 0 || shading_defines(parameters_.shading).contains("LOBE_FILTER");
}

const Buffer& Frame::light_texels(Recorder& r) {
  const Buffer& texels = stage_.scratch.get("light texels", size_t(light_count_) * sizeof(gpu::Vpl));
  const auto m = rsm_->pointers();
  r.pass("shade.texels", [&] {
    const struct {
      gpu::Emitter emitter;
      uint32_t count;
    } push{light_, light_count_};
    r.dispatch(stage_.kernels.get(kernel_path("light_texels.comp"), shading_defines(parameters_.shading)),
               {*m[0], *m[1], *m[2], *m[3], *m[4], light_buffer(Half::rsm), texels}, push,
               groups_for(light_count_, 64));
  });
  return texels;
}

void Frame::shade(Recorder& r, uint32_t seed, uint32_t iteration) {
  const Buffer& lights = light_buffer(Half::rsm);
  const uint64_t pixels = uint64_t(camera_.width) * camera_.height;
  Buffer& indirect = stage_.scratch.get("indirect", pixels * sizeof(glm::vec4));
  const bool reduces_bias = method_->kind() == LightKind::vsgl && parameters_.bias_reduction > 0;
  ShaderDefines defines = light_defines(method_->kind(), parameters_.shading);
  // All kinds of shadow maps are read alike.
  defines["VISIBILITY"] = std::to_string(static_cast<int>(std::min(parameters_.visibility, Visibility::ism)));
  if (method_->kind() == LightKind::vsl) defines["LIGHT_VSL"] = "1";
  if (reduces_bias) defines["BIAS_REDUCTION"] = "1";
  const Kernel& kernel = stage_.kernels.get(kernel_path("shade.comp"), defines);
  ShadePush push{.emitter = camera_, .words = groups_for(pixels, 32), .map_size = parameters_.ism.size};
  push.random = static_cast<uint32_t>(mix(uint64_t(seed) << 32 | iteration));
  push.radius2_scale = std::pow(4.0f / 9.0f, static_cast<float>(iteration));
  push.weight = 1.0f / static_cast<float>(parameters_.progressive);
  push.alpha = parameters_.bias_reduction;

  const auto g = gbuffer_->pointers();
  std::vector<Binding> bound = {*g[0], *g[1], *g[2], *g[3], *g[4], lights, indirect};
  if (needs_light_texels()) {
    const Buffer& texels = light_texels(r);
    if (reduces_bias) bound.push_back(texels);
  }
  uint32_t most = kMostLights;
  std::vector<const Buffer*> bits;  // one of each range
  if (has_shadow_maps(parameters_.visibility)) {
    const auto maps = stage_.shadow_maps(parameters_.visibility, parameters_.ism)
                          .build(r, lights, method_->kind(), light_count_, *gbuffer_, clears_sigma());
    push.map_tolerance = maps.tolerance;
    bound.push_back(*maps.depth);
    bound.push_back(*maps.frames);
  } else if (parameters_.visibility == Visibility::exact) {
    most = std::min(most, upload_bits(push.words, &bits));
  }
  r.pass("shade", [&] {
    for (const LightRange& range : light_ranges(light_count_, most)) {
      push.first = range.first;
      push.count = range.count;
      push.accumulate = range.first > 0 || iteration > 0;
      if (range.first > 0) r.barrier();
      auto with_bits = bound;
      if (!bits.empty()) with_bits.push_back(*bits[range.first / most]);
      r.dispatch(kernel, with_bits, push, groups_for(camera_.width, 8), groups_for(camera_.height, 8));
    }
  });
}

// Bits in as many buffers as the device's storage-buffer range asks for; returns how many lights each holds.
uint32_t Frame::upload_bits(uint32_t words, std::vector<const Buffer*>* buffers) {
  const auto most = static_cast<uint32_t>(std::clamp<uint64_t>(
      stage_.device.info().max_storage_range / (words * sizeof(uint32_t)), 1, kMostLights));
  for (const LightRange& range : light_ranges(light_count_, most)) {
    const size_t bytes = size_t(range.count) * words * sizeof(uint32_t);
    Buffer& bits = stage_.scratch.get(fmt::format("visibility {}", range.first / most), bytes);
    bits.upload(&bits_[size_t(range.first) * words], bytes);
    buffers->push_back(&bits);
  }
  return most;
}

Image Frame::render_direct() {
  const uint64_t pixels = uint64_t(camera_.width) * camera_.height;
  Buffer& out = stage_.scratch.get("direct", pixels * sizeof(glm::vec4));
  const auto g = gbuffer_->pointers();
  recorder_.begin();
  draw_halves(recorder_);
  recorder_.pass("direct", [&] {
    recorder_.dispatch(stage_.kernels.get(kernel_path("direct.comp")),
                       {*g[0], *g[1], *g[2], *g[3], *g[4], rsm_->maps[0], out, light_view_buffer_}, camera_,
                       groups_for(camera_.width, 8), groups_for(camera_.height, 8));
  });
  recorder_.submit_and_wait();
  Image image(camera_.width, camera_.height);
  const auto texels = out.download<glm::vec4>(pixels);
  std::transform(texels.begin(), texels.end(), image.pixels.begin(),
                 [](const glm::vec4& t) { return glm::vec3(t); });
  return image;
}

}  // namespace vsglbench
