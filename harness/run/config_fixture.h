// Tests only: a small config, its cases, and what is wrong with it.
#pragma once

#include "base/error.h"
#include "run/config.h"
#include "run/run_fixture.h"

namespace vsglbench {

class ConfigTest : public RunFixture {
 protected:
  Config load(const Overrides& overrides = Json::object()) { return load_config(write_config(), overrides); }
  std::vector<std::string> ids() {
    std::vector<std::string> out;
    for (const Case& c : load().cases) out.push_back(c.id);
    return out;
  }
  // The error of `config_`, or of a text, which must be a config error of one line that names file and line.
  std::string problem() { return problem_of(config_.dump(1)); }
  std::string problem_of(const std::string& text) {
    const auto path = write("bad.json", text);
    try {
      load_config(path);
    } catch (const Error& e) {
      EXPECT_EQ(e.exit_code(), 2);
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      EXPECT_TRUE(contains(e.what(), path.string() + ":"));
      return e.what();
    }
    return "no error";
  }
};

}  // namespace vsglbench
