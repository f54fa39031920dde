// References of the frames of a scene in motion, with random numbers in common.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reference/reference.h"
#include "scene/scene.h"

namespace vsglbench {

// The frames that teach the others: the first, the last and two between, fewer of a short animation.
std::vector<uint32_t> teachers(uint32_t frames);
std::string hash_of_teachers(const Scene& scene);
Guidance learn_from_teachers(const Scene& scene, const ReferenceParameters& parameters);

// Random numbers are the same in every frame (random.h). Where nothing but objects moves, all frames also go
// by what a few of them teach of where light comes from (Guidance), and so take the same samples: what an
// object does not change keeps its noise, and the difference between two frames has little of it. The first
// frame alone would leave out where the objects go: by a quarter more noise there than a frame has that
// teaches itself. A camera or
// light that moves leaves nothing to share, and each frame teaches itself; it then shares its reference with
// the still scene of its pose. Frames of equal pose have equal images to the bit.
class ReferenceSequence {
 public:
  // Keeps a reference to `scene`, which set_frame() may pose.
  ReferenceSequence(const Scene& scene, const ReferenceParameters& parameters);

  // Of the present pose, as the cache knows it. The other frames but the first have no part in it.
  std::string hash() const { return reference_hash(scene_, parameters_, teachers_); }

  // The reference of the present pose: from the cache, or by tracer(), which is called only then and must be
  // of `scene` in this pose. The first that is not cached builds other tracers for a moment, to be taught.
  // Errors as compute_reference().
  ReferenceResult present(const std::function<const Tracer&()>& tracer, bool* from_cache = nullptr);

 private:
  const Guidance* guidance();

  const Scene& scene_;
  const ReferenceParameters parameters_;
  std::string teachers_;  // hash_of_teachers(); empty: each frame teaches itself
  std::optional<Guidance> guidance_;
};

struct SequenceFrame {
  uint32_t frame;
  const ReferenceResult& reference;
  bool from_cache;
};

// Poses `scene` in each of its frames, in order, and hands each one's reference on; one tracer for all is
// built when the first is missing in the cache, and refitted. Holds one result at a time. Leaves the scene in
// its last frame.
void reference_sequence(Scene* scene, const ReferenceParameters& parameters,
                        const std::function<void(const SequenceFrame&)>& visit);

}  // namespace vsglbench
