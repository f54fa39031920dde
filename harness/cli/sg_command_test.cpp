// `vsglbench sg` as a user meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/file.h"
#include "cli/process.h"

namespace vsglbench {
namespace {

class SgCommand : public ::testing::Test {
 protected:
  SgCommand() {
    folder_ = std::filesystem::path(testing::TempDir()) / ("vsglbench-sg-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~SgCommand() override { std::filesystem::remove_all(folder_); }

  Finished run(const std::string& csv, std::vector<std::string> more = {}) const {
    write_text(folder_ / "in.csv", csv);
    std::vector<std::string> all = {"sg", "--in", (folder_ / "in.csv").string()};
    all.insert(all.end(), more.begin(), more.end());
    return finish(start(all));
  }
  void expect_refused(const std::string& csv, const std::string& part,
                      const std::vector<std::string>& more = {}) const {
    const Finished f = run(csv, more);
    EXPECT_EQ(f.code, 2) << f.err;
    ASSERT_EQ(f.errors().size(), 1u) << f.err;
    EXPECT_NE(f.err.find(part), std::string::npos) << f.err;
    EXPECT_EQ(f.out, "");
  }

  std::filesystem::path folder_;
};

}  // namespace

TEST_F(SgCommand, WritesWhatItReadWithValueExactAndError) {
  const Finished f = run("cosine, sharpness\r\n1,8\r\n0.5,0\r\n\r\n", {"--kernel", "tokuyoshi2024"});
  ASSERT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(f.out.starts_with("cosine,sharpness,value,exact,abs_error\n1,8,0.875")) << f.out;
  EXPECT_NE(f.out.find("\n0.5,0,0.25,0.25"), std::string::npos) << f.out;
  const Finished to_file =
      run("sharpness\n2\n", {"--function", "integral", "--out", (folder_ / "out.csv").string()});
  ASSERT_EQ(to_file.code, 0) << to_file.err;
  EXPECT_TRUE(read_text(folder_ / "out.csv").starts_with("sharpness,value,exact,rel_error\n2,3.084"));
  const Finished product = run("cosine,sharpness1,sharpness2\n-1,2,2\n", {"--function", "product"});
  EXPECT_TRUE(
      product.out.starts_with("cosine,sharpness1,sharpness2,log_amplitude,exact_log_amplitude,sharpness,"
                              "exact_sharpness,rel_error\n-1,2,2,-4"))
      << product.out;
}

TEST_F(SgCommand, SkipsAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF", header = "cosine,sharpness\n";
  const Finished f = run(mark + header + "0.5,1.5\n");
  ASSERT_EQ(f.code, 0) << f.err;
  EXPECT_EQ(f.out, run(header + "0.5,1.5\n").out);
  expect_refused(mark + mark + header, "in.csv:1: the header is not");
  expect_refused(mark, "in.csv:1: the header is not");
  expect_refused(header + mark + "0.5,1.5\n", "in.csv:2: cosine");
}

TEST_F(SgCommand, RefusesBadInputWithFileAndLine) {
  expect_refused("", "in.csv:1: empty; the first line is \"cosine,sharpness\"");
  expect_refused("cos,sharpness\n", "in.csv:1: the header is not \"cosine,sharpness\"");
  expect_refused("cosine,sharpness\n0,1\n0.5\n", "in.csv:3: 1 values, not the 2");
  expect_refused("cosine,sharpness\n0,1,\n", "in.csv:2: 3 values, not the 2");
  expect_refused("cosine,sharpness\n0,eight\n", "in.csv:2: sharpness: \"eight\" is not a number");
  expect_refused("cosine,sharpness\n0,1e\n", "in.csv:2: sharpness: \"1e\" is not a number");
  expect_refused("cosine,sharpness\nnan,1\n", "in.csv:2: cosine is nan, not in [-1, 1]");
  expect_refused("cosine,sharpness\n1.01,1\n", "in.csv:2: cosine is 1.01");
  expect_refused("cosine,sharpness\n0,-1\n", "in.csv:2: sharpness is -1");
  expect_refused("cosine,sharpness\n0,inf\n", "in.csv:2: sharpness is inf");
  expect_refused("cosine,sharpness\n0,0\n", "in.csv:2: sharpness is 0", {"--kernel", "pettineo-hill"});
  expect_refused("axis_x,axis_y,axis_z,sharpness,eta_x,eta_y\n1,1,0,1,1,1\n",
                 "in.csv:2: the axis has length 1.414", {"--function", "asg_product"});
  expect_refused("", "no diffuse model 'tokuyoshi2023'; did you mean", {"--kernel", "tokuyoshi2023"});
  expect_refused("", "no function 'integal'", {"--function", "integal"});
  expect_refused("", "has no hemispherical integral", {"--function", "hemisphere", "--kernel", "cosine"});
  expect_refused("", "means nothing to --function integral",
                 {"--function", "integral", "--kernel", "cosine"});
  const Finished none = finish(start({"sg", "--in", (folder_ / "none.csv").string()}));
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("none.csv: not a file that can be read"), std::string::npos) << none.err;
}

// A white Lambert surface, the light of 3 W/sr 2 m above it: 3/4/π.
TEST_F(SgCommand, ShadesAWholeLight) {
  const std::string header =
      "distance,variance,light_cosine,light_azimuth,diffuse_angle,diffuse_azimuth,diffuse_sharpness,"
      "diffuse_intensity,specular_angle,specular_azimuth,specular_sharpness,specular_intensity,view_cosine,"
      "albedo,f0,"
      "ndf,frame";
  const std::vector<std::string> shade = {"--function", "shade"};
  const Finished f = run(header + "\n2,1e-6,1,0,0,0,0,3,0,0,0,0,1,1,0,0.5,0\n", shade);
  ASSERT_EQ(f.code, 0) << f.err;
  EXPECT_NE(f.out.find(",0.5,0,0.2387"), std::string::npos) << f.out;
  EXPECT_TRUE(f.out.starts_with(header + ",value,exact,error_over_condition\n")) << f.out;
  expect_refused(header + "\n2,1e-6,1,0,0,0,0,3,0,0,0,0,1,1,0,0,0\n",
                 "in.csv:2: ndf is 0, not in [0.001, 1] (GGX)", shade);
  expect_refused(header + "\n0,1e-6,1,0,0,0,0,3,0,0,0,0,1,1,0,1,0\n", "in.csv:2: distance is 0", shade);
  const Finished random = finish(start({"sg", "--function", "shade", "--random", "2000"}));
  EXPECT_EQ(random.code, 0) << random.out << random.err;
  EXPECT_NE(random.out.find("shade cosine, 2000 random rows, seed 1: error_over_condition p50"),
            std::string::npos)
      << random.out;
}

// Without rows of its own: the table of the receiver's lobe, in which a lobe turned by 90° is off by more
// than 2 % at 60°.
TEST_F(SgCommand, PrintsTheReceiversTable) {
  const Finished f = finish(start({"sg", "--function", "receiver"}));
  ASSERT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(f.out.starts_with("ndf,f0,view,offset,plane,sharpness,value,exact,rel_error\n-30,1,0,0,0,30,"))
      << f.out;
  EXPECT_EQ(std::count(f.out.begin(), f.out.end(), '\n'), 1 + 18 * 7 * 4);
  const std::string header = "ndf,f0,view,offset,plane,sharpness\n";
  const Finished one = run(header + "-1023,1,60,2,90,1023\n", {"--function", "receiver"});
  ASSERT_EQ(one.code, 0) << one.err;
  const double error = std::stod(one.out.substr(one.out.rfind(',') + 1));
  EXPECT_LT(error, 0.02) << one.out;
  expect_refused(header + "0,1,60,2,90,1023\n", "in.csv:2: ndf is 0", {"--function", "receiver"});
  expect_refused(header + "1,1,91,2,90,1023\n", "in.csv:2: view is 91, not in [0, 90]",
                 {"--function", "receiver"});
}

TEST_F(SgCommand, RandomRowsAreRepeatableAndFailuresComeWithAReproducer) {
  const std::vector<std::string> sound = {"sg",     "--kernel", "tokuyoshi2024", "--random", "2000",
                                          "--seed", "5"};
  const Finished a = finish(start(sound)), b = finish(start(sound));
  EXPECT_EQ(a.code, 0) << a.err;
  EXPECT_EQ(a.out, b.out);
  EXPECT_NE(a.out.find("p99"), std::string::npos);
  const Finished bad = finish(start({"sg", "--kernel", "pettineo-hill", "--random", "500"}));
  EXPECT_EQ(bad.code, 1);
  EXPECT_NE(bad.out.find("negative: printf 'cosine,sharpness\\n"), std::string::npos) << bad.out;
}

}  // namespace vsglbench
