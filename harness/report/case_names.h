// What tells the cases of a table apart, and what all of them share.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace vsglbench {

// Whether a case's id is what `--only` and `--case` ask for: a glob, in which '*' takes '/' too.
bool matches_glob(const std::string& id, const std::string& glob);

// Short names for ids "SCENE/METHOD/KEY=VALUE,KEY=VALUE": a key that has one value in all `cases` is left out
// of their names.
class CaseNames {
 public:
  explicit CaseNames(const std::vector<const CaseResult*>& cases);

  std::string shared() const;                    // "rsm=256,vis=exact"
  std::string label(const CaseResult& c) const;  // "mfis N=64": without the scene
  // `part`: "scene", "method" or a key. Throws Error(usage) where no case has it.
  std::string part(const CaseResult& c,
                   const std::string& part) const;  // "mfis", "N=64", "-" for a case without
  std::string label_without(const CaseResult& c, const std::string& part) const;

 private:
  std::vector<std::string> shared_;  // "rsm=256", …
  std::vector<std::string> known_;   // parts
};

}  // namespace vsglbench
