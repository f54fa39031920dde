// The dashboard: one page for one report, two, or a history, which opens from a file and asks nothing of a
// network.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"
#include "dashboard/pictures.h"

namespace vsglbench {

struct DashboardOrder {
  std::vector<std::filesystem::path> reports;  // report.json, or its folder; at least one
  std::filesystem::path stability, papers;     // `stability --json`, papers.json; empty: none
  PictureOrder pictures;
};

struct Dashboard {
  Json digest;                    // reports/dashboard/src/data.ts, Digest
  std::vector<Picture> pictures;  // whose bytes digest.images names
};

// One report or two are shown in full, two also compared: the first is the base. Of more, which are of the
// newest's device, the newest is shown in full, and all by time in a history. Throws Error(config) for a
// damaged file, Error(usage) without a report.
Dashboard make_dashboard(const DashboardOrder& order);

// The page in which the digest and the pictures are embedded. Throws Error(output), and Error(usage) where
// this build has no page to fill.
void write_dashboard(const Dashboard& dashboard, const std::filesystem::path& out);

}  // namespace vsglbench
