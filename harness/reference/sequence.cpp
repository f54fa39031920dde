#include "reference/sequence.h"

#include <algorithm>

#include "base/hash.h"
#include "reference/cache.h"
#include "scene/animation.h"

namespace vsglbench {
namespace {

constexpr uint32_t kMostTeachers = 4;

Scene posed(const Scene& scene, uint32_t frame) {
  Scene pose = scene;
  set_frame(&pose, frame);
  return pose;
}

}  // namespace

std::vector<uint32_t> teachers(uint32_t frames) {
  const uint32_t count = std::min(frames, kMostTeachers);
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < count; ++i) out.push_back(i == 0 ? 0 : i * (frames - 1) / (count - 1));
  return out;
}

std::string hash_of_teachers(const Scene& scene) {
  Hasher hasher;
  hasher.text("vsglbench.teachers");
  for (const uint32_t frame : teachers(frame_count(scene))) hasher.text(posed(scene, frame).hash);
  return hasher.hex();
}

Guidance learn_from_teachers(const Scene& scene, const ReferenceParameters& parameters) {
  std::optional<Guidance> all;
  for (const uint32_t frame : teachers(frame_count(scene))) {
    const Scene pose = posed(scene, frame);
    Guidance one = learn_guidance(Tracer(pose), parameters);
    if (!all) {
      all = std::move(one);
      continue;
    }
    all->light.learn_from(one.light);
    all->photons.learn_from(one.photons);
    all->sharp = std::max(all->sharp, one.sharp);
  }
  all->taught_by = hash_of_teachers(scene);
  return *std::move(all);
}

ReferenceSequence::ReferenceSequence(const Scene& scene, const ReferenceParameters& parameters)
    : scene_(scene), parameters_(parameters) {
  const Moved& moves = scene.animation.moves;
  if (!moves.objects.empty() && !moves.camera && !moves.light) teachers_ = hash_of_teachers(scene);
}

const Guidance* ReferenceSequence::guidance() {
  if (teachers_.empty()) return nullptr;
  if (!guidance_) guidance_ = learn_from_teachers(scene_, parameters_);
  return &*guidance_;
}

ReferenceResult ReferenceSequence::present(const std::function<const Tracer&()>& tracer, bool* from_cache) {
  return load_or_compute(
      scene_, hash(), parameters_,
      [&] { return compute_reference(tracer(), parameters_, nullptr, guidance()); }, from_cache);
}

void reference_sequence(Scene* scene, const ReferenceParameters& parameters,
                        const std::function<void(const SequenceFrame&)>& visit) {
  ReferenceSequence sequence(*scene, parameters);
  std::optional<Tracer> tracer;
  const auto present = [&]() -> const Tracer& { return tracer ? *tracer : tracer.emplace(*scene); };
  for (uint32_t frame = 0; frame < frame_count(*scene); ++frame) {
    const Moved moved = set_frame(scene, frame);
    if (tracer) tracer->update(moved);
    bool from_cache = false;
    const ReferenceResult result = sequence.present(present, &from_cache);
    visit({frame, result, from_cache});
  }
}

}  // namespace vsglbench
