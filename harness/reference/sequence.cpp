#include "reference/sequence.h"

#include "reference/cache.h"
#include "scene/animation.h"

namespace vsglbench {
namespace {

Scene first_frame(const Scene& scene) {
  Scene first = scene;
  set_frame(&first, 0);
  return first;
}

}  // namespace

ReferenceSequence::ReferenceSequence(const Scene& scene, const ReferenceParameters& parameters)
    : scene_(scene), parameters_(parameters) {
  const Moved& moves = scene.animation.moves;
  if (!moves.objects.empty() && !moves.camera && !moves.light) teacher_ = first_frame(scene).hash;
}

const Guidance* ReferenceSequence::guidance() {
  if (teacher_.empty()) return nullptr;
  if (!guidance_) {
    const Scene first = first_frame(scene_);
    guidance_ = learn_guidance(Tracer(first), parameters_);
  }
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
