// How one set of lights lies on the RSM; lights/coverage.h measures it.
#pragma once

#include <optional>

namespace vsglbench {

// How evenly lights hold an area, of which c lights hold each texel, whole or in part. overlap + gap is the
// mean of |c - 1|: how far the lights are from holding every texel once.
struct Coverage {
  double overlap = 0;  // mean of max(c - 1, 0): 1 where every texel has one light too many
  double gap = 0;      // mean of max(1 - c, 0): 1 where no texel has one
  // The same means over texels distributed as the PDF: where that is 0 nobody needs a light. Absent without
  // a PDF, or with one that is 0 everywhere.
  std::optional<double> pdf_overlap, pdf_gap;
};

// What the filtering kernels hold of the PDF, each as a multiple of the 1/N that is meant [MFIS16 Eq. 2]: its
// mass. Over the lights that have a kernel.
struct KernelStats {
  double largest = 0, mean = 0;
  double over = 0;    // share of them, 0 … 1, of a mass above kTooLargeKernel
  double spread = 0;  // mean of |log2 mass|: 1 where each holds twice or half what it should
};

// On an even PDF a kernel of this mass has twice the side that it should; it is the K by which Křivánek and
// Colbert widened all kernels on purpose [MFIS16 §3.1]. What holds more at K = 1 has its centre at a local
// minimum of the PDF, and makes a light that is too bright [MFIS16 §5, Fig. 5].
inline constexpr double kTooLargeKernel = 4;

}  // namespace vsglbench
