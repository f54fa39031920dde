// Tests only: the programme as a process, on the small experiments of RunFixture.
#pragma once

#include "cli/process.h"
#include "run/run_fixture.h"

namespace vsglbench {

class CliTest : public RunFixture {
 protected:
  Finished run(const std::vector<std::string>& arguments, const Limits& limits = {}) const {
    return finish(start(arguments, limits));
  }
  Finished run_config(const Limits& limits = {}) const {
    return run({"-q", "run", write_config().string(), "--out", out_.string()}, limits);
  }
  Report report() const { return read_report(out_ / "report.json"); }

  // Ended by itself with this code and one line on stderr that says `part`.
  static void expect_refused(const Finished& f, int code, const std::string& part) {
    EXPECT_EQ(f.signal, 0);
    EXPECT_EQ(f.code, code) << f.err;
    ASSERT_EQ(f.errors().size(), 1u) << f.err;
    EXPECT_TRUE(contains(f.errors()[0], part));
  }
  // A run that ended with exit code 1, its only case failed with `part`, in a sound report.
  void expect_failed_case(const std::string& part, const Limits& limits = {}) const {
    const Finished f = run_config(limits);
    EXPECT_EQ(f.signal, 0);
    EXPECT_EQ(f.code, 1) << f.err;
    EXPECT_TRUE(f.errors().empty()) << f.err;
    expect_sound(out_ / "report.json");
    const Report r = report();
    ASSERT_EQ(r.cases.size(), 1u);
    EXPECT_EQ(r.cases[0].status, Status::failed);
    EXPECT_TRUE(contains(r.cases[0].error->message, part));
    EXPECT_EQ(r.cases[0].error->message.find('\n'), std::string::npos);
  }
  void use_scene(const Json& scene, const std::string& gltf) {
    config_["scenes"] = {write_scene("square", scene, gltf)};
  }
};

}  // namespace vsglbench
