// One cell of the stability table: hard case × method × diffuse model, and how figures become its verdict.
#pragma once

#include <string>

#include "base/json.h"

namespace vsglbench {

// ok        every figure within kOkError of the double-precision one, and nothing impossible
// bias      finite and ≥ 0, but off by more than that; or the lights' power is beyond the method's flux_bound
// bad       NaN, Inf, negative, off by more than kBadError; an error where none is due, or none where one
//           is; a crash
// left_out  the case means nothing to the method
enum class Stability { ok, bias, bad, left_out };
const char* stability_name(Stability status);

// Single precision has 6e-8, and a light or a pixel is some hundred operations and at most a thousand sums:
// 1e-3 leaves room for them, and none for a cancellation, which costs all digits. 5 % is what can be seen.
inline constexpr double kOkError = 1e-3, kBadError = 0.05;

struct StabilityCell {
  std::string hard_case, method;
  std::string diffuse;  // model of the pixels' shading; "-" where lights are no VSGLs
  Stability status = Stability::ok;
  double error = 0;   // the worst relative one; infinity where something is impossible
  std::string where;  // it was: "light 3: variance", "pixel (3,1)"; empty: nothing had an error
  std::string why;    // one line
};
// An infinite error is the string "infinite": JSON has no such number.
Json to_json(const StabilityCell& cell);
StabilityCell cell_from_json(const Json& json);

// Collects what is seen of one cell.
class Judgement {
 public:
  // A relative error, which says `where` if it is the worst; NaN counts as infinite. `explanation`: how the
  // two figures read.
  void error(double relative, const std::string& where, const std::string& explanation = "");
  void bad(const std::string& why);
  void bias(const std::string& why);
  // Said where nothing is wrong.
  void note(const std::string& text);
  bool is_bad() const { return status_ == Stability::bad; }
  StabilityCell cell(const std::string& hard_case, const std::string& method,
                     const std::string& diffuse) const;

 private:
  void raise(Stability status, const std::string& why);
  Stability status_ = Stability::ok;
  double worst_ = 0;
  std::string where_, explanation_, why_, note_;
};

}  // namespace vsglbench
