// The conformance kit: what every method must keep to, checked on made-up halves and on a small scene.
//
//   repeatable  the same shift of the lattice gives the same lights to the bit: from a second frame, from a
//   new
//               Method, and with scratch memory that another case left full; another shift gives other
//               lights, where the method takes a light count
//   lights      every light written and finite, no negative power, sharpness ≥ 0, variance > 0, axes unit; no
//               light of power where there is no surface, no flux or no PDF; also with each parameter at each
//               of its choices, its minimum and its maximum
//   flux        Σ light power within MethodInfo::flux_bound of Σ texel power, in the mean over 16 shifts,
//               also with each parameter at each of its choices, its minimum and its maximum; on a PDF that
//               changes by a factor of 16 within a few texels, within uneven_flux_bound and three standard
//               errors
//   passes      each pass is one of Steps (generate.<half>.<step>) and has a time; two frames have the same
//               ones; nothing is dispatched outside a pass
//   bounds      nothing is written past the lights asked for, nor past the end of a scratch buffer: up to 4
//   KiB
//               behind it, and on one input of each half up to 64 MiB (of more than 7 buffers 512 MiB in all)
//   memory      a second frame takes no more device memory, and in the end all of it is given back
//   validation  the Vulkan validation layers are silent, synchronisation checks included (those of 1.3.239
//   see a read
//               after an unfenced write, but not two unfenced writes of dispatches to one buffer)
//   image       a frame of a scene: same seed, same image to the bit; image and lights finite; black where
//               the light has no flux or sees no surface; and the same, in the mean to 0.1 %, where the
//               kernels are compiled without the specular lobes that the scene does not have
//
// Each check runs in a process of its own: a method that crashes, hangs or loses the device fails that check,
// and the others go on. The G-buffer half is asked only of methods that use importance, as in a frame.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "method/method.h"

namespace vsglbench {

struct ConformanceOptions {
  std::string device;             // as in DeviceOptions::select
  double silence_s = 120;         // a check that is silent for longer is stopped
  bool large = true;              // inputs of 512×512 and 1920×1088 texels too
  std::vector<std::string> only;  // names of checks; empty: all
};

struct CheckResult {
  std::string name;
  unsigned inputs = 0;                // looked at
  std::vector<std::string> failures;  // one line each: "<input>: <what came>; expected <what>"
  std::vector<std::string> left_out;  // "<input>: <why>", where the device has no room for it
  std::vector<std::string> measured;  // "<input>: <figure>", of a check that holds a figure to a bound
  double seconds = 0;
  bool ok() const { return failures.empty(); }
};

// Names of the checks, in order.
std::vector<std::string> conformance_checks();

// Runs the checks, telling each result as it comes. A method without `create` is loaded from its library, in
// the checking process only. The caller has neither threads nor a Vulkan device (base/supervise.h). Throws
// Error(device) without a usable device, Error(plugin) for a plugin that is refused, Error(usage) for an
// unknown check.
std::vector<CheckResult> check_conformance(const MethodInfo& method, const ConformanceOptions& options,
                                           const std::function<void(const CheckResult&)>& on_result);

}  // namespace vsglbench
