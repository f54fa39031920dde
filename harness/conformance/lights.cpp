#include "conformance/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vsglbench {
namespace {

constexpr double kUnitTolerance = 1e-3;   // of an axis' length
constexpr double kPowerTolerance = 1e-3;  // of the stated power against the lobes'

// Collects the first fault of one light.
class Judge {
 public:
  void finite(const char* what, float v) {
    if (!std::isfinite(v)) found("has {} {}; expected a finite number", what, v);
  }
  void above_zero(const char* what, float v) {
    if (!std::isfinite(v) || !(v > 0)) found("has {} {}; expected a finite number > 0", what, v);
  }
  void not_negative(const char* what, float v) {
    if (!std::isfinite(v) || !(v >= 0)) found("has {} {}; expected a finite number ≥ 0", what, v);
  }
  void not_negative(const char* what, const glm::vec3& v) {
    if (!all_finite(v) || std::min({v.x, v.y, v.z}) < 0)
      found("has {} ({}, {}, {}); expected finite numbers ≥ 0", what, v.x, v.y, v.z);
  }
  void finite(const char* what, const glm::vec3& v) {
    if (!all_finite(v)) found("has {} ({}, {}, {}); expected finite numbers", what, v.x, v.y, v.z);
  }
  void unit(const char* what, const glm::vec3& v) {
    const double length = glm::length(glm::dvec3(v));
    if (!(std::abs(length - 1) <= kUnitTolerance))
      found("has {} of length {:.6g}; expected a unit vector", what, length);
  }
  template <class... Args>
  void found(fmt::format_string<Args...> format, Args&&... args) {
    if (fault_.empty()) fault_ = fmt::format(format, std::forward<Args>(args)...);
  }
  const std::string& fault() const { return fault_; }

 private:
  static bool all_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  }
  std::string fault_;
};

void compare_power(Judge& judge, double stated, double carried) {
  if (!(std::abs(stated - carried) <= kPowerTolerance * carried))
    judge.found("states a power of {:.6g} W but carries {:.6g} W; expected the same", stated, carried);
}

// What any light must keep to: of a kind whose record has no rules of its own below.
template <class Record>
std::string fault_of(const Record& light) {
  const LightSummary s = summary_of(light);
  Judge judge;
  judge.not_negative("power", s.power);
  judge.finite("position", s.position);
  judge.not_negative("variance", s.variance);
  judge.not_negative("radius", s.radius);
  compare_power(judge, s.power, s.carried);
  return judge.fault();
}

bool unwritten(const LightRecords& lights, size_t i) {
  const size_t stride = light_stride(lights.kind);
  std::vector<uint32_t> words(stride / 4);
  std::memcpy(words.data(), &lights.bytes[i * stride], stride);
  return std::ranges::all_of(words, [](uint32_t word) { return word == unwritten_word; });
}

}  // namespace

std::string fault_of(const gpu::Vsgl& v) {
  Judge judge;
  judge.not_negative("power", v.power);
  judge.finite("mean", v.mean);
  judge.not_negative("diffuse", v.diffuse);
  judge.not_negative("specular", v.specular);
  judge.not_negative("diffuse sharpness", v.diffuse_sharpness);
  judge.not_negative("specular sharpness", v.specular_sharpness);
  judge.finite("diffuse axis", v.diffuse_axis);
  judge.finite("specular axis", v.specular_axis);
  judge.finite("level", v.level);
  if (v.power > 0) {
    judge.above_zero("variance", v.variance);
    judge.unit("diffuse axis", v.diffuse_axis);
    judge.unit("specular axis", v.specular_axis);
  } else {
    judge.not_negative("variance", v.variance);
  }
  compare_power(judge, v.power, summary_of(v).carried);
  return judge.fault();
}

std::string fault_of(const gpu::Vpl& v) {
  Judge judge;
  judge.not_negative("power", v.power);
  judge.finite("position", v.position);
  judge.finite("ndf", v.ndf);
  judge.finite("normal", v.normal);
  judge.finite("geometric normal", v.geometric_normal);
  judge.finite("incident direction", v.incident);
  judge.not_negative("flux", v.flux);
  judge.not_negative("diffuse reflectance", v.diffuse);
  judge.not_negative("F0", v.f0);
  if (v.power > 0) {
    judge.unit("normal", v.normal);
    judge.unit("geometric normal", v.geometric_normal);
    judge.unit("incident direction", v.incident);
    if (v.ndf == 0) judge.found("has ndf 0; expected a GGX alpha > 0 or minus a Phong exponent");
  }
  compare_power(judge, v.power, summary_of(v).carried);
  return judge.fault();
}

std::string first_fault(const LightRecords& lights, bool powerless) {
  std::string first;
  lights.each([&](size_t i, const auto& light) {
    if (!first.empty()) return;
    std::string fault =
        unwritten(lights, i) ? "was not written; expected each of the lights asked for" : fault_of(light);
    const double power = std::max(double(light.power), summary_of(light).carried);
    if (fault.empty() && powerless && power > 0)
      fault = fmt::format("has a power of {:.6g} W; expected no power", power);
    if (!fault.empty()) first = fmt::format("light {} {}", i, fault);
  });
  return first;
}

std::string first_difference(const LightRecords& a, const LightRecords& b) {
  const size_t stride = light_stride(a.kind);
  for (size_t i = 0; i < a.count(); ++i) {
    if (std::memcmp(&a.bytes[i * stride], &b.bytes[i * stride], stride) != 0)
      return fmt::format("light {} differs", i);
  }
  return "";
}

LightPower sum_power(const LightRecords& lights) {
  LightPower sum;
  for (const LightSummary& light : summaries_of(lights)) {
    sum.stated += light.power;
    sum.carried += light.carried;
  }
  return sum;
}

}  // namespace vsglbench
