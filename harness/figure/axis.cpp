#include "figure/axis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <initializer_list>
#include <set>
#include <vector>

namespace vsglbench {
namespace {

std::vector<std::string> ticks_at(std::initializer_list<double> factors, double least, double most) {
  std::vector<std::string> out;
  for (int e = static_cast<int>(std::floor(std::log10(least))); std::pow(10.0, e) <= most; ++e) {
    for (const double factor : factors) {
      const double value = factor * std::pow(10.0, e);
      if (value >= least && value <= most) out.push_back(fmt::format("{:.6g}", value));
    }
  }
  return out;
}

// 1, 2 and 5 times powers of ten, more where those are few.
std::vector<std::string> ticks_between(double least, double most) {
  std::vector<std::string> out = ticks_at({1, 2, 5}, least, most);
  if (out.size() < 4) out = ticks_at({1, 1.5, 2, 3, 4, 5, 6, 7, 8}, least, most);
  for (int digits = 3; out.size() < 3 && digits < 10; ++digits) {
    std::set<std::string> three;
    for (const double share : {0.1, 0.5, 0.9})
      three.insert(fmt::format("{:.{}g}", least * std::pow(most / least, share), digits));
    if (three.size() == 3) out.assign(three.begin(), three.end());
  }
  return out;
}

}  // namespace

LogAxis log_axis(char name, double least, double most) {
  const double decades = std::log10(most / least), margin = std::pow(10, decades > 0 ? 0.03 * decades : 0.5);
  LogAxis axis{least / margin, most * margin, ""};
  axis.commands = fmt::format("set logscale {0}\nset {0}range [{1}:{2}]\n", name, axis.least, axis.most);
  if (decades > 1.5)
    axis.commands += fmt::format("set format {} '10^{{%T}}'\nset m{}tics 10\n", name, name);
  else
    axis.commands +=
        fmt::format("set {}tics ({})\n", name, fmt::join(ticks_between(axis.least, axis.most), ","));
  return axis;
}

}  // namespace vsglbench
