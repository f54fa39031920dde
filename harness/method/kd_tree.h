// A kd-tree over cluster centres, built on the device by Karras' binary radix tree [MFIS16 App. D; Karras
// 2012].
#pragma once

#include "gpu/recorder.h"
#include "method/context.h"
#include "method/radix_sort.h"

namespace vsglbench {

class KdTree {
 public:
  static constexpr uint32_t kLeafSize = 8;  // centres a leaf holds at most
  static constexpr uint32_t kMaxCentres = 1u << 21;
  // Up to so many are built by one workgroup: its dispatches, and not its work, is what a small tree takes.
  static constexpr uint32_t kFewCentres = 4096;

  // `dimensions` is 2 or 3; in 2-D the centres' z is left out.
  KdTree(MethodContext& context, int dimensions);
  // Records the build over `centres`, `count` vec4 (xyz; w > 0: there is one). In the recorder's current
  // pass, with barriers after each step. Throws Error(case_failed) for a count of 0 or over kMaxCentres.
  void build(Recorder& recorder, const Buffer& centres, uint32_t count);
  // What shaders/kd_tree.glsl describes, until the next build: TreeNode, and TreeCentre in tree order.
  const Buffer& nodes() const { return *nodes_; }
  const Buffer& centres() const { return *sorted_; }

  static ShaderDefines defines(int dimensions);

 private:
  // Scratch memory for so many centres. It is named by size, so that a later and larger tree of the same
  // frame doesn't replace what is recorded here.
  const Buffer& scratch(const char* name, uint32_t count, size_t bytes_each);
  void build_few(Recorder& recorder, const Buffer& centres, uint32_t count);
  void build_many(Recorder& recorder, const Buffer& centres, uint32_t count);

  MethodContext& context_;
  const Kernel &few_, &bounds_, &codes_;
  RadixSort sort_;
  const Kernel &build_, &fit_;
  const Buffer *nodes_ = nullptr, *sorted_ = nullptr;
};

}  // namespace vsglbench
