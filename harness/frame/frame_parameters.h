// Parameters of a case that are not the method's own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frame/seeds.h"
#include "frame/shading.h"
#include "frame/visibility.h"
#include "scene/effects.h"

namespace vsglbench {

// Whose lights on the G-buffer make the PDF on the RSM: the method's own; VSGLs [VSGL14 §3] or VPLs, as the
// first BRSM had it (Ritschel et al. 2011) [VSGL14 Fig. 4a], of the method that says that it makes importance
// by them; or nobody's: the power that each texel reflects.
enum class Importance { own, vsgl, vpl, flux };
const std::vector<std::string>& importance_names();    // in the order of the enumeration
Importance parse_importance(const std::string& name);  // throws Error(config)

// Which mean over the view the PDF on the RSM is proportional to, of what a texel's light adds to a pixel:
// the arithmetic one [VSGL14 §3], by which a sampler's estimate of the image's mean varies least; or the
// quadratic one, by which the sum of its pixels' variances is least.
enum class ImportanceNorm { l1, l2 };
const std::vector<std::string>& importance_norm_names();        // in the order of the enumeration
ImportanceNorm parse_importance_norm(const std::string& name);  // throws Error(config)

const std::vector<std::string>& lattice_names();  // in the order of the enumeration
Lattice parse_lattice(const std::string& name);   // throws Error(config)

struct FrameParameters {
  uint32_t width = 480, height = 272;  // G-buffer
  uint32_t rsm = 256;                  // RSM, texels a side
  uint32_t lights = 256;               // N
  uint32_t importance_lights = 2048;   // on the G-buffer; at most its number of pixels is used
  Visibility visibility = Visibility::exact;
  IsmParameters ism;
  Shading shading;           // of VSGLs
  float bias_reduction = 0;  // α of [VSGL14 §3.3], of VSGLs; 0: none
  Importance importance = Importance::own;
  ImportanceNorm importance_norm = ImportanceNorm::l1;
  // Of generation alone, in place of `importance`: read by who makes the PDFs (run/pdf_source.h).
  std::string pdf = "mfis";
  // Progressive: images of so many light sets are averaged, the radius of lights × 2/3 from one to the next
  // [VSGL14 §5].
  uint32_t progressive = 1;
  // The pixels of every block of so many by so many share the lights out; 1: each takes all.
  uint32_t interleave = 1;
  Lattice lattice = Lattice::fixed;  // of an animation: read by who renders its frames
  // What is not among them is left out: passes, channels, lobes and branches of shaders
  // (frame/permutation.h).
  EffectSet effects = EffectSet::all();
  // What a case asks for against what its scene calls for: in `effects` of a run are those that the scene
  // needs and the forced ones, without the skipped ones.
  EffectSet force_effects = EffectSet::none(), skip_effects = EffectSet::none();
  // Every pass is submitted by itself and what it wrote is looked at: see Frame::bad_output(). Times of such
  // a frame are not comparable.
  bool check_passes = false;
};

}  // namespace vsglbench
