#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "report/synthetic_report.h"

using namespace vsglbench;

namespace {

std::vector<std::string> violations(const Json& json) { return schema_violations(json, report_schema()); }

// The synthetic report with one change; says what the schema makes of it.
std::string first_violation(const std::function<void(Json&)>& change) {
  Json json = to_json(synthetic_report());
  change(json);
  const auto found = violations(json);
  return found.empty() ? "" : found.front();
}

// Pointers of every object's keys, depth first.
void collect(const Json& value, const std::string& at, std::vector<std::string>& out) {
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      const std::string child = at + "/" + pointer_token(key);
      out.push_back(child);
      collect(member, child, out);
    }
  } else if (value.is_array()) {
    for (size_t i = 0; i < value.size(); ++i) collect(value[i], fmt::format("{}/{}", at, i), out);
  }
}

Json& at(Json& json, const std::string& pointer) { return json.at(Json::json_pointer(pointer)); }

}  // namespace

TEST(ReportSchema, AFullReportIsValid) {
  EXPECT_EQ(violations(to_json(synthetic_report())), std::vector<std::string>());
}

TEST(ReportSchema, KindsOfErrorAreThoseOfTheProgramme) {
  Json names = Json::array();
  for (const ErrorKindRow& row : kErrorKinds) names.push_back(row.name);
  EXPECT_EQ(report_schema()
                .at("$defs")
                .at("case")
                .at("properties")
                .at("error")
                .at("properties")
                .at("kind")
                .at("enum"),
            names);
}

TEST(ReportSchema, EveryFieldButTheOptionalOnesIsNeeded) {
  const Json full = to_json(synthetic_report());
  std::vector<std::string> pointers, optional;
  collect(full, "", pointers);
  for (const auto& pointer : pointers) {
    if (pointer.starts_with("/config/") || pointer.find("/parameters/") != std::string::npos ||
        pointer.find("/settings/") != std::string::npos || pointer.find("/constants/") != std::string::npos) {
      continue;  // free-form
    }
    Json json = full;
    const size_t slash = pointer.rfind('/');
    json.at(Json::json_pointer(pointer.substr(0, slash))).erase(pointer.substr(slash + 1));
    if (violations(json).empty()) optional.push_back(pointer);
  }
  std::vector<std::string> expected = {"/scenes/0/contact",
                                       "/scenes/0/notes",
                                       "/scenes/0/clocks",
                                       "/scenes/0/effects",
                                       "/scenes/0/effects_priced",
                                       "/scenes/0/region",
                                       "/scenes/0/effects/0/bytes",
                                       "/scenes/0/effects/0/ms",
                                       "/scenes/0/effects/0/ms_ci95",
                                       "/aa",
                                       "/environment/host/load_at_start",
                                       "/environment/host/load_at_end"};
  for (const char* key : {"frame/method",
                          "frame/host_visibility",
                          "generate/flux",
                          "generate/flux/ci95",
                          "generate/overlap",
                          "generate/gap",
                          "accuracy/smape/ci95",
                          "accuracy/rmse/ci95",
                          "accuracy/rrmse/ci95",
                          "accuracy/mrse/ci95",
                          "accuracy/bias/ci95",
                          "accuracy/quantiles",
                          "accuracy/smape_lit",
                          "accuracy/smape_lit/ci95",
                          "accuracy/lit_share",
                          "accuracy/flip",
                          "accuracy/flip/ci95",
                          "accuracy/flip_p99",
                          "accuracy/reference/noise_floor_rmse",
                          "accuracy/reference/noise_floor_smape_lit",
                          "accuracy/reference/noise_floor_rrmse",
                          "accuracy/reference/noise_floor_mrse",
                          "accuracy/reference/noise_floor_flip",
                          "accuracy/reference/light_ratio",
                          "accuracy/reference/black_share",
                          "accuracy/reference/batches",
                          "accuracy/reference/standard_error",
                          "accuracy/reference/ended_by",
                          "temporal",
                          "temporal/derivative/ci95",
                          "temporal/derivative/values",
                          "temporal/static",
                          "temporal/detail",
                          "temporal/detail/ci95",
                          "temporal/detail/values"}) {
    expected.push_back(std::string("/cases/0/") + key);
  }
  for (int seed = 0; seed < 8; ++seed) {
    for (const char* key : {"rrmse", "mrse", "bias", "smape_lit", "flip", "flip_p99", "p99_9", "flux",
                            "coverage", "coverage/pdf_overlap", "coverage/pdf_gap", "kernels", "detail",
                            "spikes", "cancellation_rate", "region", "region/bias", "region/detail"})
      expected.push_back(fmt::format("/cases/0/seeds/{}/{}", seed, key));
  }
  for (const char* key : {"health", "health/first_bad", "health/first_bad/pass"}) {
    expected.push_back(std::string("/cases/1/") + key);
  }
  std::sort(expected.begin(), expected.end());
  std::sort(optional.begin(), optional.end());
  EXPECT_EQ(optional, expected);
}

TEST(ReportSchema, NullIsNowhereAllowed) {
  const Json full = to_json(synthetic_report());
  std::vector<std::string> pointers;
  collect(full, "", pointers);
  EXPECT_GT(pointers.size(), 150u);
  for (const auto& pointer : pointers) {
    if (pointer.starts_with("/config/") || pointer.find("/parameters/") != std::string::npos) continue;
    Json json = full;
    at(json, pointer) = nullptr;
    EXPECT_FALSE(violations(json).empty()) << pointer;
  }
}

TEST(ReportSchema, UnknownFieldsAreRefused) {
  for (const char* object : {"",
                             "/git",
                             "/environment",
                             "/environment/host",
                             "/scenes/0",
                             "/scenes/0/effects/0",
                             "/scenes/0/effects_priced",
                             "/aa/0",
                             "/aa/0/times/1",
                             "/cases/0",
                             "/cases/0/passes/1",
                             "/cases/0/frame",
                             "/cases/0/generate",
                             "/cases/0/accuracy",
                             "/cases/0/accuracy/bias",
                             "/cases/0/accuracy/reference",
                             "/cases/0/seeds/2",
                             "/cases/0/seeds/2/coverage",
                             "/cases/0/seeds/2/kernels",
                             "/cases/0/seeds/2/region",
                             "/cases/0/health",
                             "/cases/1/error",
                             "/cases/0/temporal",
                             "/cases/0/temporal/static",
                             "/cases/0/temporal/detail"}) {
    EXPECT_NE(first_violation([&](Json& j) { at(j, object)["extra"] = 1; }), "") << object;
  }
}

TEST(ReportSchema, TheStatusDecidesWhatACaseHolds) {
  const auto broken = [](const std::string& pointer, const Json& value) {
    return first_violation([&](Json& j) { at(j, pointer) = value; });
  };
  EXPECT_NE(broken("/cases/0/status", "fine"), "");
  EXPECT_NE(broken("/cases/0/status", "failed"), "");  // without an error
  EXPECT_NE(broken("/cases/1/status", "ok"), "");      // with an error, without numbers
  EXPECT_NE(broken("/cases/0/health/nan", 1), "");     // an ok case has no bad pixel
  EXPECT_EQ(broken("/cases/1/health/nan", 5), "");
  EXPECT_NE(first_violation([](Json& j) { j["cases"][0]["error"] = {{"kind", "x"}, {"message", "y"}}; }), "");
  EXPECT_NE(first_violation([](Json& j) { j["cases"][0]["passes"] = Json::array(); }), "");
  EXPECT_NE(first_violation([](Json& j) { j["cases"][0]["images"].erase("error"); }), "");
}

TEST(ReportSchema, GenerationAloneHasTimesAndNothingElse) {
  const auto broken = [](const std::function<void(Json&)>& change) {
    return first_violation([&](Json& j) {
      Report r;
      r.cases = {synthetic_generation("cornell/mfis", 10)};
      j["cases"] = to_json(r)["cases"];
      change(j["cases"][0]);
    });
  };
  EXPECT_EQ(broken([](Json&) {}), "");
  for (const char* key : {"measure", "passes", "frame", "generate", "stopping", "health"}) {
    EXPECT_NE(broken([&](Json& c) { c.erase(key); }), "") << key;
  }
  for (const char* key : {"accuracy", "seeds", "temporal", "images"}) {
    const Json full = to_json(synthetic_report())["cases"][0][key];
    EXPECT_NE(broken([&](Json& c) { c[key] = full; }), "") << key;
  }
  EXPECT_NE(broken([](Json& c) { c["passes"][0]["name"] = "shade"; }), "");
  EXPECT_NE(first_violation([](Json& j) { j["cases"][0]["measure"] = "generation"; }), "");
}

TEST(ReportSchema, ABadPixelLightOrElement) {
  const auto broken = [](const Json& first_bad) {
    return first_violation([&](Json& j) { j["cases"][1]["health"]["first_bad"] = first_bad; });
  };
  EXPECT_EQ(broken({{"pass", "generate.rsm"}, {"light", 7}}), "");
  EXPECT_NE(broken({{"pass", "generate.rsm"}}), "");
  const Json element = {{"pass", "generate.rsm.mipmap"},
                        {"buffer", "moments1.rsm"},
                        {"field", "x"},
                        {"element", 1234},
                        {"texel", {12, 3}},
                        {"level", 2}};
  EXPECT_EQ(broken(element), "");
  EXPECT_EQ(broken({{"pass", "generate.rsm"}, {"light", 7}, {"buffer", "lights.rsm"}, {"field", "power"}}),
            "");
  Json nameless = element;
  nameless.erase("buffer");
  EXPECT_NE(broken(nameless), "");
}

TEST(ReportSchema, ValuesOutOfRangeAreRefused) {
  const std::pair<const char*, Json> faults[] = {{"/schema", "vsglbench.report/2"},
                                                 {"/created", "yesterday"},
                                                 {"/git/commit", "main"},
                                                 {"/argv", Json::array()},
                                                 {"/environment/device/type", "toaster"},
                                                 {"/environment/device/timestamp_period_ns", 0},
                                                 {"/scenes/0/triangles", -1},
                                                 {"/scenes/0/triangles", 1.5},
                                                 {"/scenes/0/light_flux", {1, 2}},
                                                 {"/scenes/0/contact", "/absolute.png"},
                                                 {"/scenes/0/clocks/readings", -1},
                                                 {"/scenes/0/effects_priced/rounds", 0},
                                                 {"/scenes/0/effects_priced/ratio", 0},
                                                 {"/aa/0/times/0/ratio", 0},
                                                 {"/aa/0/times/0/column", "shading"},
                                                 {"/environment/host/load_at_start", -1},
                                                 {"/cases/0/id", ""},
                                                 {"/cases/0/passes/0/name", "Gen erate"},
                                                 {"/cases/0/passes/0/samples_ms", Json::array()},
                                                 {"/cases/0/passes/0/samples_ms/0", -1},
                                                 {"/cases/0/passes/0/ci95_ms", {1}},
                                                 {"/cases/0/generate/gap", 1.5},
                                                 {"/cases/0/accuracy/smape/value", 201},
                                                 {"/cases/0/accuracy/rmse/value", -0.1},
                                                 {"/cases/0/accuracy/pixels", 0},
                                                 {"/cases/0/seeds/0/smape", "12"},
                                                 {"/cases/0/seeds/0/coverage/gap", 1.5},
                                                 {"/cases/0/seeds/0/kernels/over", 1.5},
                                                 {"/cases/0/seeds/0/spikes", 1.5},
                                                 {"/cases/0/seeds/0/cancellation_rate", -0.5},
                                                 {"/cases/0/seeds/0/region/rmse", -1},
                                                 {"/scenes/0/region", {0, 0, 32}},
                                                 {"/scenes/0/region/2", 0.5},
                                                 {"/cases/0/stopping/reason", "bored"},
                                                 {"/cases/0/images/indirect", "/absolute.exr"}};
  for (const auto& [pointer, value] : faults) {
    EXPECT_NE(first_violation([&](Json& j) { at(j, pointer) = value; }), "") << pointer << " = " << value;
  }
}

TEST(ReportSchema, AMetricIsAValueOrAReason) {
  EXPECT_EQ(first_violation([](Json& j) {
              Json& bias = j["cases"][0]["accuracy"]["bias"];
              bias.erase("value");
              bias.erase("ci95");
              bias["undefined"] = "the reference is black";
            }),
            "");
  EXPECT_NE(
      first_violation([](Json& j) { j["cases"][0]["accuracy"]["bias"]["undefined"] = "and yet a value"; }),
      "");
}
