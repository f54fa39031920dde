// What a pass is called. Passes are told apart by the parts of their names; the dotted text is for reports,
// labels and messages.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

namespace vsglbench {

enum class Half { gbuffer, rsm };
inline const char* half_name(Half half) { return half == Half::gbuffer ? "gbuffer" : "rsm"; }

// What a pass is for. `draw`: rasterising a half. `other`: no part of a frame.
enum class PassStage { draw, importance, generate, visibility, shade, direct, other };

struct PassId {
  PassStage stage = PassStage::other;
  std::optional<Half> half;  // absent where a pass works on no half, or its stage says on which
  std::string step;          // within the stage; may be empty
  bool operator==(const PassId&) const = default;
  // "gbuffer", "importance.rsm", "generate.rsm.sort", "shade", the step alone of `other`.
  std::string name() const;
};

// The reverse of PassId::name(), for readers of report files and for nobody else. What no frame calls a pass
// becomes a step of PassStage::other.
PassId parse_pass_name(const std::string& name);

}  // namespace vsglbench

template <>
struct fmt::formatter<vsglbench::PassId> : fmt::formatter<std::string> {
  template <class Context>
  auto format(const vsglbench::PassId& pass, Context& context) const {
    return fmt::formatter<std::string>::format(pass.name(), context);
  }
};
