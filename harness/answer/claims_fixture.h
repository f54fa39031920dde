// Tests only: claims and cases of a made-up report.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "answer/claims.h"
#include "answer/made_report.h"

namespace vsglbench {

inline PaperClaim claim_of(Json a, Json b, Says says = Says::less) {
  PaperClaim c;
  c.name = "made";
  c.a = std::move(a);
  c.b = std::move(b);
  c.both = Json::object();
  c.says = says;
  c.metrics = {"rmse"};
  c.scenes = {"*"};
  return c;
}

inline MadeCase made(const std::string& method, int n, double error, double ms = 1,
                     const std::string& scene = "box") {
  return {.scene = scene,
          .method = method,
          .parameters = {{"N", n}, {"visibility", "none"}},
          .passes = {{"generate.rsm.sample", 0.5 * ms}, {"shade", 0.5 * ms}},
          .error = error};
}

inline ClaimRow only_row(const Report& report, const PaperClaim& claim) {
  const TriedClaim tried = try_claim(report, claim);
  EXPECT_EQ(tried.rows.size(), 1u);
  return tried.rows.at(0);
}

}  // namespace vsglbench
