#include "conformance/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "frame/light_flux.h"
#include "method/oracle.h"

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

double carried_power(const gpu::Vsgl& v) { return reflected_power(v); }
double carried_power(const gpu::Vpl& v) { return oracle::luminance(glm::dvec3(v.flux)); }

void compare_power(Judge& judge, double stated, double carried) {
  if (!(std::abs(stated - carried) <= kPowerTolerance * carried))
    judge.found("states a power of {:.6g} W but carries {:.6g} W; expected the same", stated, carried);
}

template <class Light>
Light record(const LightRecords& lights, size_t i) {
  Light light;
  std::memcpy(&light, &lights.bytes[i * sizeof light], sizeof light);
  return light;
}

bool unwritten(const LightRecords& lights, size_t i) {
  const size_t stride = light_stride(lights.kind);
  std::vector<uint32_t> words(stride / 4);
  std::memcpy(words.data(), &lights.bytes[i * stride], stride);
  return std::ranges::all_of(words, [](uint32_t word) { return word == unwritten_word; });
}

template <class Light>
std::string fault_in(const LightRecords& lights, size_t i, bool powerless) {
  if (unwritten(lights, i)) return "was not written; expected each of the lights asked for";
  const auto light = record<Light>(lights, i);
  if (std::string fault = fault_of(light); !fault.empty()) return fault;
  const double power = std::max(double(light.power), carried_power(light));
  return powerless && power > 0 ? fmt::format("has a power of {:.6g} W; expected no power", power) : "";
}

}  // namespace

gpu::Vsgl LightRecords::vsgl(size_t i) const { return record<gpu::Vsgl>(*this, i); }
gpu::Vpl LightRecords::vpl(size_t i) const { return record<gpu::Vpl>(*this, i); }

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
  compare_power(judge, v.power, carried_power(v));
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
  compare_power(judge, v.power, carried_power(v));
  return judge.fault();
}

std::string first_fault(const LightRecords& lights, bool powerless) {
  for (size_t i = 0; i < lights.count(); ++i) {
    const std::string fault = lights.kind == LightKind::vsgl ? fault_in<gpu::Vsgl>(lights, i, powerless)
                                                             : fault_in<gpu::Vpl>(lights, i, powerless);
    if (!fault.empty()) return fmt::format("light {} {}", i, fault);
  }
  return "";
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
  for (size_t i = 0; i < lights.count(); ++i) {
    if (lights.kind == LightKind::vsgl) {
      sum.stated += lights.vsgl(i).power;
      sum.carried += carried_power(lights.vsgl(i));
    } else {
      sum.stated += lights.vpl(i).power;
      sum.carried += carried_power(lights.vpl(i));
    }
  }
  return sum;
}

}  // namespace vsglbench
