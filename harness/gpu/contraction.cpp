#include "gpu/contraction.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string_view>

#include "base/error.h"

namespace vsglbench {
namespace {

constexpr size_t kHeaderWords = 5;
constexpr uint32_t kOpDecorate = 71, kOpMemberDecorate = 72, kNoContraction = 42;

// Floating-point arithmetic, whose result is the third word [SPIR-V 3.3.13].
bool is_arithmetic(uint32_t op) {
  static constexpr uint32_t ops[] = {127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148};
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
    const uint32_t op = (*spirv)[i] & 0xFFFFu, words = (*spirv)[i] >> 16;
    const auto from = spirv->begin() + static_cast<std::ptrdiff_t>(i);
    if (annotations == 0 && (op == kOpDecorate || op == kOpMemberDecorate)) annotations = out.size();
    if (is_arithmetic(op))
      decorations.insert(decorations.end(), {3u << 16 | kOpDecorate, from[2], kNoContraction});
    if (op != kOpDecorate || from[2] != kNoContraction) out.insert(out.end(), from, from + words);
    i += words;
  }
  if (contraction == Contraction::never && annotations > 0) {
    out.insert(out.begin() + static_cast<std::ptrdiff_t>(annotations), decorations.begin(),
               decorations.end());
  }
  *spirv = std::move(out);
}

}  // namespace vsglbench
