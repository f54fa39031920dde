#include "report/case_names.h"

#include <fnmatch.h>

#include <algorithm>
#include <sstream>

#include "base/nearest.h"

namespace vsglbench {
namespace {

struct Parts {
  std::string method;
  std::vector<std::string> settings;  // "N=64", …
};

Parts parts_of(const CaseResult& c) {
  const std::string rest = c.id.starts_with(c.scene + "/") ? c.id.substr(c.scene.size() + 1) : c.id;
  const size_t slash = std::min(rest.find('/'), rest.size());
  Parts parts{rest.substr(0, slash), {}};
  std::istringstream settings(rest.substr(std::min(slash + 1, rest.size())));
  for (std::string s; std::getline(settings, s, ',');) parts.settings.push_back(s);
  return parts;
}

std::string key_of(const std::string& setting) { return setting.substr(0, setting.find('=')); }

bool holds(const std::vector<std::string>& list, const std::string& item) {
  return std::ranges::find(list, item) != list.end();
}

}  // namespace

bool matches_glob(const std::string& id, const std::string& glob) {
  return ::fnmatch(glob.c_str(), id.c_str(), 0) == 0;
}

CaseNames::CaseNames(const std::vector<const CaseResult*>& cases) : known_({"scene", "method"}) {
  if (!cases.empty()) shared_ = parts_of(*cases.front()).settings;
  for (const CaseResult* c : cases) {
    const auto settings = parts_of(*c).settings;
    std::erase_if(shared_, [&](const std::string& s) { return !holds(settings, s); });
    for (const auto& s : settings) {
      if (!holds(known_, key_of(s))) known_.push_back(key_of(s));
    }
  }
}

std::string CaseNames::shared() const { return fmt::format("{}", fmt::join(shared_, ",")); }

std::string CaseNames::label(const CaseResult& c) const { return label_without(c, "scene"); }

std::string CaseNames::part(const CaseResult& c, const std::string& part) const {
  if (!holds(known_, part))
    throw fail(ErrorKind::usage, "no part '{}' of the cases' ids{}", part, suggestion(part, known_));
  if (part == "scene") return c.scene;
  const Parts parts = parts_of(c);
  if (part == "method") return parts.method;
  for (const auto& s : parts.settings) {
    if (key_of(s) == part) return s;
  }
  return "-";
}

std::string CaseNames::label_without(const CaseResult& c, const std::string& part) const {
  const Parts parts = parts_of(c);
  std::vector<std::string> settings;
  for (const auto& s : parts.settings) {
    if (!holds(shared_, s) && key_of(s) != part) settings.push_back(s);
  }
  const std::string method = part == "method" ? "" : parts.method;
  return fmt::format("{}{}{}", method, method.empty() || settings.empty() ? "" : " ",
                     fmt::join(settings, ","));
}

}  // namespace vsglbench
