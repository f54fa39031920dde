// papers.json, what a device gave of the exhibits, and the page that is made of it.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "papers/exhibit.h"
#include "papers/trial.h"

namespace vsglbench {

inline constexpr const char* kPapersSchema = "vsglbench.papers/1";

// The trials of all exhibits of a papers.json.
std::vector<ClaimTrial> trials_in(const Json& papers);

// Exhibits of `fresh` in place of those of the same name in `earlier`, in the order of `all`; those that it
// does not name come last.
Json merged(const Json& earlier, const Json& fresh, const std::vector<Exhibit>& all);

// README.md of a folder with papers.json and the thumbnails that it names, wholly made from the JSON.
std::string papers_page(const Json& papers);

}  // namespace vsglbench
