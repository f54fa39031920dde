#include "gpu/contraction.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <spirv/unified1/spirv.hpp11>
#include <string_view>

#include "base/error.h"

namespace vsglbench {
namespace {

constexpr size_t kHeaderWords = 5;
constexpr auto kNoContraction = static_cast<uint32_t>(spv::Decoration::NoContraction);

// Floating-point arithmetic, whose result is the third word [SPIR-V 3.3.13].
bool is_arithmetic(spv::Op op) {
  using spv::Op;
  static constexpr Op ops[] = {Op::OpFNegate,
                               Op::OpFAdd,
                               Op::OpFSub,
                               Op::OpFMul,
                               Op::OpFDiv,
                               Op::OpFRem,
                               Op::OpFMod,
                               Op::OpVectorTimesScalar,
                               Op::OpMatrixTimesScalar,
                               Op::OpVectorTimesMatrix,
                               Op::OpMatrixTimesVector,
                               Op::OpMatrixTimesMatrix,
                               Op::OpOuterProduct,
                               Op::OpDot};
  return std::ranges::count(ops, op) > 0;
}

}  // namespace

Contraction contraction_asked() {
  const char* asked = std::getenv("VSGLBENCH_CONTRACTION");
  const std::string_view value = asked ? asked : "";
  if (value == "never") return Contraction::never;
  if (value == "always") return Contraction::always;
  if (value.empty()) return Contraction::as_written;
  throw fail(ErrorKind::usage, "$VSGLBENCH_CONTRACTION is '{}'; use never or always, or unset it", value);
}

void set_contraction(Contraction contraction, std::vector<uint32_t>* spirv) {
  if (contraction == Contraction::as_written) return;
  std::vector<uint32_t> out(spirv->begin(), spirv->begin() + kHeaderWords), decorations;
  size_t annotations = 0;  // where they begin in `out`
  for (size_t i = kHeaderWords; i < spirv->size();) {
    const auto op = static_cast<spv::Op>((*spirv)[i] & spv::OpCodeMask);
    const uint32_t words = (*spirv)[i] >> spv::WordCountShift;
    const auto from = spirv->begin() + static_cast<std::ptrdiff_t>(i);
    if (annotations == 0 && (op == spv::Op::OpDecorate || op == spv::Op::OpMemberDecorate))
      annotations = out.size();
    if (is_arithmetic(op))
      decorations.insert(decorations.end(), {3u << spv::WordCountShift | uint32_t(spv::Op::OpDecorate),
                                             from[2], kNoContraction});
    if (op != spv::Op::OpDecorate || from[2] != kNoContraction) out.insert(out.end(), from, from + words);
    i += words;
  }
  if (contraction == Contraction::never && annotations > 0) {
    out.insert(out.begin() + static_cast<std::ptrdiff_t>(annotations), decorations.begin(),
               decorations.end());
  }
  *spirv = std::move(out);
}

}  // namespace vsglbench
