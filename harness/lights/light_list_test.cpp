#include "lights/light_list.h"

#include <gtest/gtest.h>

#include <sstream>

namespace vsglbench {
namespace {

gpu::Vsgl vsgl() {
  gpu::Vsgl l{};
  l.mean = {0.1f, 2, -3};
  l.variance = 0.25f;
  l.power = 1.5f;
  l.level = 3.5f;
  l.diffuse_axis = {0, 1, 0};
  l.diffuse_sharpness = 2;
  l.diffuse = {1, 0.5f, 0.2f};
  l.specular_axis = {0, 0, 1};
  l.specular_sharpness = 1e6f;
  l.specular = {4, 5, 6};
  return l;
}

gpu::Vpl vpl() {
  gpu::Vpl l{};
  l.position = {1, 2, 3};
  l.normal = l.geometric_normal = l.incident = {0, 1, 0};
  l.power = 2;
  l.flux = {1, 2, 3};
  l.diffuse = {0.5f, 0.5f, 0.5f};
  l.f0 = {0.04f, 0.04f, 0.04f};
  l.ndf = 0.3f;
  return l;
}

LightSet two_vsgls() {
  LightSet set;
  set.lights = records_of(LightKind::vsgl, std::vector{gpu::Vsgl{}, vsgl()});  // the first has no power
  set.shapes.squares = {{}, {8.5f, 4.5f, 11.3f, 0}};
  set.edges = {{}, {0.25, 0.1}};
  return set;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

// Far from the world's origin the offset keeps its digits only in double.
TEST(LightList, VsglInWorldCoordinates) {
  const LightSet set = two_vsgls();
  EXPECT_EQ(set.count(), 2u);
  EXPECT_EQ(set.empty(), 1u);
  const Json list = light_list(set, {1e7, 0, 0});
  ASSERT_EQ(list.size(), 1u);
  const Json& l = list[0];
  EXPECT_EQ(l.at("index"), 1);
  EXPECT_EQ(l.at("mean")[0].get<double>(), 1e7 + double(0.1f));
  EXPECT_EQ(l.at("sigma"), 0.5);
  EXPECT_EQ(l.at("level"), 3.5);
  EXPECT_EQ(l.at("diffuse").dump(), R"({"axis":[0.0,1.0,0.0],"sharpness":2.0,"amplitude":[1.0,0.5,0.2]})");
  EXPECT_EQ(l.at("specular").at("sharpness"), 1e6);
  EXPECT_EQ(static_cast<float>(l.at("footprint").at("side").get<double>()), 11.3f);
  EXPECT_EQ(l.at("edge_share"), 0.25);
}

// Of two lights, the second's square is the texel that has three quarters of the PDF.
TEST(LightList, FootprintsHaveTheirMass) {
  LightSet set = two_vsgls();
  set.shapes.squares[1] = {1.5f, 0.5f, 1, 0};
  set.rsm = 2;
  EXPECT_FALSE(light_list(set, {})[0].contains("mass"));
  set.pdf = {0.25f, 3, 0.25f, 0.5f};
  EXPECT_DOUBLE_EQ(light_list(set, {})[0].at("mass").get<double>(), 1.5);
}

TEST(LightList, VplsHaveTheirBrdf) {
  LightSet set;
  std::vector vsls = {vpl(), vpl()};
  vsls[1].ndf = -50;
  vsls[1].radius = 0.125f;
  set.lights = records_of(LightKind::vsl, vsls);
  const Json list = light_list(set, {});
  EXPECT_EQ(list[0].at("brdf").at("alpha").dump(), "0.3");
  EXPECT_FALSE(list[0].contains("radius") || list[0].contains("clamp"));
  EXPECT_EQ(list[1].at("brdf").at("exponent"), 50);
  EXPECT_EQ(list[1].at("radius"), 0.125);
  EXPECT_EQ(list[1].at("flux").dump(), "[1.0,2.0,3.0]");
}

// Every row has a cell for every column, also where lights differ in what they have.
TEST(LightList, CsvIsATable) {
  LightSet set;
  std::vector vpls = {vpl(), vpl()};
  vpls[1].ndf = -50;
  set.lights = records_of(LightKind::vpl, vpls);
  std::istringstream in(to_csv(light_list(set, {})));
  std::string head, first, second, rest;
  ASSERT_TRUE(std::getline(in, head) && std::getline(in, first) && std::getline(in, second));
  EXPECT_FALSE(std::getline(in, rest));
  const auto names = cells(head);
  ASSERT_EQ(names.front(), "index");
  ASSERT_EQ(names.back(), "brdf.exponent");
  EXPECT_EQ(std::count(first.begin(), first.end(), ','), static_cast<long>(names.size()) - 1);
  EXPECT_EQ(cells(second).size(), names.size());
  EXPECT_EQ(cells(second).back(), "50.0");
  const auto at = std::find(names.begin(), names.end(), "position.2") - names.begin();
  EXPECT_EQ(cells(first)[static_cast<size_t>(at)], "3.0");
}

}  // namespace
}  // namespace vsglbench
