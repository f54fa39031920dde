#include "frame/frame.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/file.h"
#include "method/filtered_sampling.h"

namespace vsglbench {
namespace {

std::filesystem::path kernel_path(const char* file) { return data_root() / "harness" / "frame" / file; }

ShaderDefines light_define(LightKind kind) { return {{"LIGHT_VPL", kind == LightKind::vpl ? "1" : "0"}}; }

// SplitMix64: one well-mixed word a seed.
uint64_t mix(uint64_t x) {
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
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

}  // namespace

glm::uvec2 lattice_shift(uint32_t seed) {
  if (seed == 0) return glm::uvec2(0);
  const uint64_t word = mix(seed);
  return {static_cast<uint32_t>(word), static_cast<uint32_t>(word >> 32)};
}

std::vector<glm::vec4> download_map(const DeviceImage& image) {
  std::vector<glm::vec4> texels(size_t(image.width()) * image.height());
  image.download(texels.data(), texels.size() * sizeof(glm::vec4));
  return texels;
}

Stage::Stage(Device& d, KernelLibrary& k, const Scene& s)
    : device(d), kernels(k), scene(s), scratch(d), geometry(d, s) {}

DeferredTargets& Stage::targets(Half half, uint32_t width, uint32_t height) {
  auto& slot = targets_[fmt::format("{} {}x{}", half_name(half), width, height)];
  if (!slot) slot = std::make_unique<DeferredTargets>(device, half_name(half), width, height);
  return *slot;
}

ImperfectShadowMaps& Stage::shadow_maps(const IsmParameters& p) {
  auto& slot = shadow_maps_[{p.size, p.points}];
  if (!slot) slot = std::make_unique<ImperfectShadowMaps>(kernels, scratch, scene, p);
  return *slot;
}

Frame::Frame(Stage& stage, const MethodInfo& method, const Json& method_parameters,
             const FrameParameters& parameters, ExactVisibility exact)
    : stage_(stage),
      parameters_(parameters),
      context_(stage.kernels, stage.scratch, method.folder),
      method_(method.create(context_, method_parameters)),
      exact_(std::move(exact)),
      recorder_(stage.device),
      gbuffer_(&stage.targets(Half::gbuffer, parameters.width, parameters.height)),
      rsm_(&stage.targets(Half::rsm, parameters.rsm, parameters.rsm)) {
  const uint64_t texels = uint64_t(parameters.rsm) * parameters.rsm;
  const uint64_t pixels = uint64_t(parameters.width) * parameters.height;
  if (method.takes_light_count && (parameters.lights == 0 || parameters.lights > texels)) {
    throw fail(ErrorKind::case_failed, "N = {} lights can't be drawn from an RSM of {} texels; use 1 … {}",
               parameters.lights, texels, texels);
  }
  light_count_ = method_->light_count(parameters.lights, texels);
  importance_count_ = method_->light_count(
      static_cast<uint32_t>(std::clamp<uint64_t>(parameters.importance_lights, 1, pixels)), pixels);
  const View camera = camera_view(stage.scene.camera, parameters.width, parameters.height);
  camera_ = make_emitter(camera, parameters.width, parameters.height, glm::vec3(1), true);
  light_ = make_emitter(light_view(stage.scene.light), parameters.rsm, parameters.rsm,
                        stage.scene.light.power, false);
  camera_buffer_ = Buffer(stage.device, "camera", sizeof camera_);
  camera_buffer_.upload(&camera_, sizeof camera_);
  light_view_buffer_ = Buffer(stage.device, "light", sizeof light_);
  light_view_buffer_.upload(&light_, sizeof light_);
}

Frame::~Frame() = default;

Buffer& Frame::pdf_buffer(Half half) {
  const auto& t = half == Half::gbuffer ? *gbuffer_ : *rsm_;
  return stage_.scratch.get(fmt::format("pdf.{}", half_name(half)), pyramid_texels(t.width, t.height) * 4);
}

Buffer& Frame::light_buffer(Half half, uint32_t count) {
  return stage_.scratch.get(fmt::format("lights.{}", half_name(half)), count * light_stride(method_->kind()));
}

Field Frame::field(Half half) {
  const bool camera = half == Half::gbuffer;
  Field f;
  f.half = half;
  f.emitter = camera ? camera_ : light_;
  f.maps = (camera ? gbuffer_ : rsm_)->pointers();
  f.pdf = method_->uses_importance() ? &pdf_buffer(half) : nullptr;
  return f;
}

FrameTimes Frame::render(uint32_t seed) {
  const glm::uvec2 shift = lattice_shift(seed);
  FrameTimes times;
  generate_dispatches_ = 0;
  recorder_.begin();
  draw_halves(recorder_);
  if (method_->uses_importance()) make_importance(recorder_, shift);
  generate(recorder_, Half::rsm, light_buffer(Half::rsm, light_count_), light_count_, shift);
  if (parameters_.visibility == Visibility::exact) {
    // The host traces between two submissions; its time is not the frame's.
    add(times, recorder_.submit_and_wait());
    auto points = light_points();
    const auto same = [](const LightPoint& a, const LightPoint& b) {
      return a.position == b.position && a.stop_short == b.stop_short;
    };
    if (!std::equal(points.begin(), points.end(), traced_.begin(), traced_.end(), same)) {
      bits_ = exact_(points);
      traced_ = std::move(points);
    }
    recorder_.begin();
  }
  shade(recorder_);
  add(times, recorder_.submit_and_wait());
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

void Frame::make_importance(Recorder& r, glm::uvec2 shift) {
  // 1. The eye's PDF on the G-buffer: reflectance.
  const auto g = gbuffer_->pointers();
  r.pass("importance.gbuffer", [&] {
    const Buffer& pdf = pdf_buffer(Half::gbuffer);
    r.dispatch(stage_.kernels.get(kernel_path("pdf_gbuffer.comp")), {*g[0], *g[1], *g[2], *g[3], *g[4], pdf},
               camera_, groups_for(camera_.width, 8), groups_for(camera_.height, 8));
    build_pdf_mips(r, pdf, camera_.width, camera_.height);
  });
  // 2. Lights on the G-buffer, by the method under test.
  Buffer& lights = light_buffer(Half::gbuffer, importance_count_);
  generate(r, Half::gbuffer, lights, importance_count_, shift);
  // 3. What they are worth at every RSM texel.
  const auto m = rsm_->pointers();
  r.pass("importance.rsm", [&] {
    const Buffer& pdf = pdf_buffer(Half::rsm);
    const struct {
      gpu::Emitter emitter;
      uint32_t count;
    } push{light_, importance_count_};
    r.dispatch(stage_.kernels.get(kernel_path("importance.comp"), light_define(method_->kind())),
               {*m[0], *m[1], *m[2], *m[3], *m[4], lights, pdf}, push, groups_for(light_.width, 8),
               groups_for(light_.height, 8));
    build_pdf_mips(r, pdf, light_.width, light_.height);
  });
}

void Frame::generate(Recorder& r, Half half, const Buffer& lights, uint32_t count, glm::uvec2 shift) {
  const unsigned before = r.dispatches();
  Steps steps(r, half);
  method_->generate(steps, field(half), {&lights, count, shift});
  generate_dispatches_ += r.dispatches() - before;
}

void Frame::shade(Recorder& r) {
  const Buffer& lights = light_buffer(Half::rsm, light_count_);
  const uint64_t pixels = uint64_t(camera_.width) * camera_.height;
  Buffer& indirect = stage_.scratch.get("indirect", pixels * sizeof(glm::vec4));
  ShaderDefines defines = light_define(method_->kind());
  defines["VISIBILITY"] = std::to_string(static_cast<int>(parameters_.visibility));
  const Kernel& kernel = stage_.kernels.get(kernel_path("shade.comp"), defines);
  const uint32_t words = groups_for(pixels, 32), gx = groups_for(camera_.width, 8),
                 gy = groups_for(camera_.height, 8);
  const auto g = gbuffer_->pointers();
  struct {
    gpu::Emitter emitter;
    uint32_t first, count, words, accumulate, map_size;
  } push{camera_, 0, light_count_, words, 0, parameters_.ism.size};

  if (parameters_.visibility == Visibility::none) {
    r.pass("shade", [&] {
      r.dispatch(kernel, {*g[0], *g[1], *g[2], *g[3], *g[4], lights, indirect}, push, gx, gy);
    });
    return;
  }
  if (parameters_.visibility == Visibility::ism) {
    const auto maps = stage_.shadow_maps(parameters_.ism).build(r, lights, method_->kind(), light_count_);
    r.pass("shade", [&] {
      r.dispatch(kernel, {*g[0], *g[1], *g[2], *g[3], *g[4], lights, indirect, *maps.depth, *maps.frames},
                 push, gx, gy);
    });
    return;
  }
  // Bits in as many buffers as the device's storage-buffer range asks for.
  const auto most = static_cast<uint32_t>(
      std::clamp<uint64_t>(stage_.device.info().max_storage_range / (words * sizeof(uint32_t)), 1, 16384));
  std::vector<const Buffer*> chunks;
  for (uint32_t first = 0; first < light_count_; first += most) {
    const uint32_t count = std::min(most, light_count_ - first);
    Buffer& chunk = stage_.scratch.get(fmt::format("visibility {}", first / most),
                                       size_t(count) * words * sizeof(uint32_t));
    chunk.upload(&bits_[size_t(first) * words], size_t(count) * words * sizeof(uint32_t));
    chunks.push_back(&chunk);
  }
  r.pass("shade", [&] {
    for (size_t i = 0; i < chunks.size(); ++i) {
      push.first = static_cast<uint32_t>(i) * most;
      push.count = std::min(most, light_count_ - push.first);
      push.accumulate = i > 0;
      r.dispatch(kernel, {*g[0], *g[1], *g[2], *g[3], *g[4], lights, indirect, *chunks[i]}, push, gx, gy);
      r.barrier();
    }
  });
}

std::vector<LightPoint> Frame::light_points() const {
  std::vector<LightPoint> points;
  for (const auto& light : vsgls()) points.push_back({light.mean, std::sqrt(light.variance)});
  for (const auto& light : vpls()) points.push_back({light.position, 0});
  return points;
}

Image Frame::indirect() const {
  Image image(camera_.width, camera_.height);
  const auto texels = stage_.scratch.get("indirect", image.pixels.size() * sizeof(glm::vec4))
                          .download<glm::vec4>(image.pixels.size());
  std::transform(texels.begin(), texels.end(), image.pixels.begin(),
                 [](const glm::vec4& t) { return glm::vec3(t); });
  return image;
}

std::vector<uint8_t> Frame::surface_mask() const {
  const auto position = download_map(gbuffer_->maps[0]);
  std::vector<uint8_t> mask(position.size());
  std::transform(position.begin(), position.end(), mask.begin(), [](const glm::vec4& p) { return p.w > 0; });
  return mask;
}

std::vector<gpu::Vsgl> Frame::vsgls() const {
  if (method_->kind() != LightKind::vsgl) return {};
  return const_cast<Frame*>(this)->light_buffer(Half::rsm, light_count_).download<gpu::Vsgl>(light_count_);
}

std::vector<gpu::Vpl> Frame::vpls() const {
  if (method_->kind() != LightKind::vpl) return {};
  return const_cast<Frame*>(this)->light_buffer(Half::rsm, light_count_).download<gpu::Vpl>(light_count_);
}

std::vector<float> Frame::importance() const {
  if (!method_->uses_importance()) return {};
  return const_cast<Frame*>(this)->pdf_buffer(Half::rsm).download<float>(size_t(light_.width) *
                                                                         light_.height);
}

std::string Frame::first_bad_pass() const {
  const auto bad_floats = [](const float* begin, size_t count) {
    return std::any_of(begin, begin + count, [](float v) { return !std::isfinite(v); });
  };
  const auto bad_maps = [&](const DeferredTargets& targets) {
    return std::any_of(targets.maps.begin(), targets.maps.end(), [&](const DeviceImage& map) {
      const auto texels = download_map(map);
      return bad_floats(&texels.front().x, 4 * texels.size());
    });
  };
  const auto bad_lights = [&](const auto& lights) {
    return bad_floats(reinterpret_cast<const float*>(lights.data()),
                      lights.size() * sizeof(lights[0]) / sizeof(float));
  };
  if (bad_maps(*gbuffer_)) return "gbuffer";
  if (bad_maps(*rsm_)) return "rsm";
  if (const auto p = importance(); !p.empty() && bad_floats(p.data(), p.size())) return "importance.rsm";
  if (bad_lights(vsgls()) || bad_lights(vpls())) return "generate.rsm";
  const Image image = indirect();
  return bad_floats(&image.pixels.front().x, 3 * image.pixels.size()) ? "shade" : "";
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
