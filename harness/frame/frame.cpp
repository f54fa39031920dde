#include "frame/frame.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/error.h"

namespace vsglbench {
namespace {

void add(FrameTimes& times, const SubmissionTimes& submission) {
  for (const PassTime& time : submission.passes) {
    const auto same = std::ranges::find(times.passes, time.pass, &PassTime::pass);
    if (same == times.passes.end()) {
      times.passes.push_back(time);
    } else {
      same->ms += time.ms;
    }
    times.sum_ms += time.ms;
  }
  times.span_ms += submission.span_ms;
}

}  // namespace

Frame::Frame(Stage& stage, const MethodInfo& method, const Json& method_parameters,
             const FrameParameters& parameters, ExactVisibility exact)
    : parts_(stage, method, method_parameters, parameters, std::move(exact)),
      check_(parameters.check_passes ? std::make_unique<PassCheck>(outputs_of(parts_)) : nullptr),
      recorder_(stage.device) {
  recorder_.observe(check_.get());
}

void Frame::follow(const Moved& moved) {
  if (!moved.any()) return;
  parts_.halves.follow(moved);
  parts_.shade.forget();
}

void Frame::restart() {
  watch_.restart();
  if (check_) check_->restart();
}

FrameTimes Frame::render(uint32_t seed, bool watched) { return render(seed, Mode{.watched = watched}); }

FrameTimes Frame::render_in_motion(uint32_t seed, Carried* carried) {
  if (carried) carried->resize(parts_.parameters.progressive);
  return render(seed, Mode{.watched = true, .motion = Halves::Motion::frames, .carried = carried});
}

FrameTimes Frame::render(uint32_t seed, const Mode& mode) {
  FrameTimes times;
  restart();
  for (uint32_t i = 0; i < parts_.parameters.progressive; ++i) render_iteration(seed, i, mode, &times);
  return times;
}

void Frame::render_iteration(uint32_t seed, uint32_t iteration, const Mode& mode, FrameTimes* times) {
  const bool traced = parts_.parameters.visibility == Visibility::exact;
  const bool watched = mode.watched;
  const glm::uvec2 shift = iteration_shift(seed, iteration);
  CarriedLights* carried = mode.carried ? &mode.carried->at(iteration) : nullptr;
  if (watched) watch_.arm(carried);
  recorder_.begin();
  // 1. What eye and light see.
  if (iteration == 0) times->triangles = parts_.halves.draw(recorder_, mode.motion);
  // 2. Which texels of the RSM matter to the eye.
  if (parts_.importance) times->generate_dispatches += parts_.importance->record(recorder_, shift, carried);
  // 3. Lights drawn from them.
  const Buffer* pdf = parts_.importance ? &parts_.importance->pdf(Half::rsm) : nullptr;
  times->generate_dispatches += parts_.lights.generate(recorder_, pdf, shift, carried);
  // 4. Which pixels see them: by the host, between two submissions, whose time is not the frame's; or by
  // shadow maps, as passes of 5.
  if (traced) {
    add(*times, recorder_.submit_and_wait());
    if (watched) watch_.look();
    if (!watch_.fault().empty()) return;  // nothing to trace from
    parts_.shade.trace();
    recorder_.begin();
  }
  // 5. Their sum at every pixel.
  parts_.shade.record(recorder_, seed, iteration);
  add(*times, recorder_.submit_and_wait());
  if (watched && !traced) watch_.look();
}

KeptPdfs Frame::prepare(uint32_t seed) {
  if (!parts_.importance) throw fail(ErrorKind::case_failed, "this method makes no PDFs");
  restart();
  recorder_.begin();
  parts_.halves.draw(recorder_);
  parts_.importance->record(recorder_, lattice_shift(seed));
  recorder_.submit_and_wait();
  if (const auto bad = bad_output()) throw fail(ErrorKind::case_failed, "the PDFs: {}", bad->message());
  if (const auto bad = results_.bad_importance()) throw fail(ErrorKind::case_failed, "{}", bad->message());
  return parts_.importance->keep();
}

FrameTimes Frame::generate_only(uint32_t seed, const KeptPdfs& pdfs, bool watched) {
  const glm::uvec2 shift = lattice_shift(seed);
  FrameTimes times;
  restart();
  if (watched) watch_.arm();
  recorder_.begin();
  if (parts_.importance) times.generate_dispatches += parts_.importance->generate(recorder_, pdfs, shift);
  times.generate_dispatches +=
      parts_.lights.generate(recorder_, parts_.importance ? &pdfs.rsm : nullptr, shift);
  add(times, recorder_.submit_and_wait());
  if (watched) watch_.look();
  return times;
}

Image Frame::render_direct() {
  const Field seen = parts_.halves.field(Half::gbuffer, nullptr);
  Stage& stage = parts_.stage;
  const Buffer& out = stage.memory.direct.get(stage.device, "direct", seen.texels() * sizeof(glm::vec4));
  recorder_.begin();
  parts_.halves.draw(recorder_);
  recorder_.pass({.stage = PassStage::direct}, [&] {
    recorder_.dispatch(
        stage.kernels.get(frame_kernel("direct.comp"),
                          permutation(parts_.parameters.effects, Half::gbuffer, Half::gbuffer)),
        {seen.maps, *rsm().field_maps().position, out, parts_.halves.emitter_buffer(Half::rsm)}, seen.emitter,
        groups_for(seen.emitter.width, 8), groups_for(seen.emitter.height, 8));
  });
  recorder_.submit_and_wait();
  Image image(seen.emitter.width, seen.emitter.height);
  const auto texels = out.download<glm::vec4>(seen.texels());
  std::ranges::transform(texels, image.pixels.begin(), [](const glm::vec4& t) { return glm::vec3(t); });
  return image;
}

size_t Frame::method_kernels() const {
  std::set<const Kernel*> kernels;
  for (const LightGenerator* generator : parts_.generators())
    kernels.insert(generator->context().kernels().begin(), generator->context().kernels().end());
  return kernels.size();
}

size_t Frame::method_bytes() const {
  std::map<std::string, size_t> bytes;
  for (const LightGenerator* generator : parts_.generators()) {
    for (const auto& [name, scratch] : generator->context().scratch_buffers())
      bytes[name] = std::max(bytes[name], scratch.bytes);
  }
  size_t total = 0;
  for (const auto& [name, size] : bytes) total += size;
  return total;
}

size_t Frame::memory_bytes() const {
  constexpr size_t depth = 4, rgba = sizeof(glm::vec4);
  size_t total = method_bytes();
  for (const Half half : {Half::gbuffer, Half::rsm}) {
    const size_t maps = parts_.halves.field(half, nullptr).maps.bindings().size();
    total += parts_.halves.texels(half) * (maps * rgba + depth);
    if (parts_.importance) total += parts_.importance->pdf_bytes(half);
    if (const HalfLights* lights = parts_.lights_on(half)) total += lights->bytes();
  }
  const uint64_t pixels = parts_.halves.texels(Half::gbuffer);
  if (parts_.parameters.visibility == Visibility::exact)
    total += light_count() * ((pixels + 31) / 32) * sizeof(uint32_t);  // of each light, whole words
  return total + pixels * rgba * (parts_.parameters.interleave > 1 ? 2 : 1);
}

}  // namespace vsglbench
