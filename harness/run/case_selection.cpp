#include <algorithm>

#include "base/error.h"
#include "base/nearest.h"
#include "report/case_names.h"
#include "run/sweep.h"

namespace vsglbench {

std::vector<Case> select_cases(const std::vector<Case>& cases, const std::vector<std::string>& globs,
                               const std::string& option) {
  for (const std::string& glob : globs) {
    if (std::ranges::any_of(cases, [&](const Case& c) { return matches_glob(c.id, glob); })) continue;
    std::vector<std::string> ids;
    for (const Case& c : cases) ids.push_back(c.id);
    throw fail(ErrorKind::usage,
               "{} '{}' matches none of the {} cases; the nearest is '{}', and a glob such as '*/{}/*' "
               "takes several",
               option, glob, cases.size(), nearest_name(glob, ids), cases.front().method);
  }
  std::vector<Case> out;
  std::ranges::copy_if(cases, std::back_inserter(out), [&](const Case& c) {
    return globs.empty() ||
           std::ranges::any_of(globs, [&](const auto& glob) { return matches_glob(c.id, glob); });
  });
  return out;
}

}  // namespace vsglbench
