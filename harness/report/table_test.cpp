#include "report/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "report/synthetic_report.h"
#include "report/table_notes.h"

using namespace vsglbench;

namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

size_t signs(const std::string& text) {
  return static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// The first line that starts with `start`, blanks aside.
std::string line_of(const std::string& table, const std::string& start) {
  for (const auto& line : split(table)) {
    if (line.substr(std::min(line.find_first_not_of(' '), line.size())).starts_with(start)) return line;
  }
  return "no line starts with " + start;
}

void expect_parts(const std::string& line, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(line.find(part), std::string::npos) << part << " in: " << line;
}

CaseResult case_of(const std::string& scene, const std::string& method, const std::string& settings,
                   double ms) {
  CaseResult c = synthetic_generation(scene + "/" + method + "/" + settings, ms);
  c.scene = scene;
  c.method = method;
  return c;
}

Report sweep() {
  Report r = synthetic_report();
  r.config["measure"] = "generation";
  r.cases = {case_of("a", "fis", "N=64,rsm=256", 10), case_of("a", "fis", "N=256,rsm=256", 20),
             case_of("a", "mfis", "N=64,rsm=256", 30), case_of("a", "mfis", "N=256,rsm=256", 250),
             case_of("b", "fis", "N=64,rsm=256", 50)};
  r.aa = {{"a", "x", "y", {synthetic_noise("generate", 0.125)}},
          {"b", "x", "y", {synthetic_noise("generate", 0.25)}}};
  return r;
}

}  // namespace

TEST(Table, OneRowACaseAndAligned) {
  Report r = synthetic_report();
  r.cases.push_back(synthetic_case("a much longer name of a case"));
  const std::string table = terminal_table(r);
  const std::string head = line_of(table, "case"), row = line_of(table, "mfis");
  expect_parts(head, {"generate ms", "method ms [95 %]", "rays ms (host)"});
  expect_parts(row, {" 12.00 ± ", " -1.00 ± ",  // bias in percent
                     " 4.50 ",                  // generate: 0.5 + 1 + 3
                     " 24.50 [18.38, 30.62] ",  // and shade's 20; not gbuffer's 2
                     " 100 "});                 // rays
  EXPECT_TRUE(row.ends_with(" 27.00"));
  EXPECT_EQ(signs(head), signs(row));
  EXPECT_EQ(signs(head), signs(line_of(table, "a much longer name")));
}

TEST(Table, ASceneStandsOnceAboveItsCases) {
  const auto lines = split(terminal_table(synthetic_report()));
  EXPECT_EQ(lines[1], "cornell");
  EXPECT_TRUE(lines[2].starts_with("  mfis "));
  EXPECT_TRUE(lines[3].starts_with("  vpl "));
  EXPECT_TRUE(lines[4].starts_with("  noise floor "));
  EXPECT_EQ(lines[5], "sponza");
}

TEST(Table, FailedAndSkippedCasesSayWhy) {
  const auto lines = split(terminal_table(synthetic_report()));
  EXPECT_NE(lines[3].find("failed: a NaN in pass shade"), std::string::npos);
  EXPECT_NE(lines[6].find("skipped: sponza.gltf is absent"), std::string::npos);
  Report r = synthetic_report();
  r.cases.erase(r.cases.begin());  // none is sound
  expect_parts(terminal_table(r), {"failed: a NaN in pass shade"});
  expect_parts(markdown_table(r), {"failed: a NaN in pass shade"});
}

TEST(Table, AReasonThatCasesShareIsToldOnce) {
  Report r = synthetic_report();
  r.cases.push_back(synthetic_failure("sponza/other", Status::skipped, "sponza.gltf is absent"));
  const std::string table = terminal_table(r);
  EXPECT_EQ(table.find("sponza.gltf is absent"), table.rfind("sponza.gltf is absent")) << table;
  expect_parts(table, {"skipped: as said above"});
}

TEST(Table, ErrorsUnderTheFloorAreNotDifferences) {
  Report r = synthetic_report();
  r.cases[0].accuracy->reference.noise_floor_smape = 12.5;
  r.cases[0].accuracy->bias.value.reset();
  const std::string table = terminal_table(r);
  EXPECT_NE(table.find("12.00 ≤ floor 12.50"), std::string::npos);
  EXPECT_EQ(table.find("12.00 ±"), std::string::npos);
  EXPECT_NE(table.find("undefined"), std::string::npos);
}

// Each time has its own noise, and each scene: the A/A pair of one says nothing of the other.
TEST(Table, NoiseStandsUnderEachColumnOfEachScene) {
  Report r = synthetic_report();
  CaseResult other = synthetic_case("ring514/mfis");
  other.scene = "ring514";
  other.accuracy->reference.noise_floor_smape = 11.5;
  r.cases = {r.cases[0], other};
  const auto lines = split(terminal_table(r));
  expect_parts(lines[3], {"noise floor", " 0.5 ", " 0.001 ", " 16 % ", " 4 % ", " 2 %"});
  expect_parts(lines[6], {"noise floor", " 12 "});
  EXPECT_EQ(lines[6].find('%'), std::string::npos) << "a noise that nobody measured: " << lines[6];
  r.aa.push_back({"ring514", "x", "y", {synthetic_noise("frame", 0.0625)}});
  expect_parts(split(terminal_table(r))[6], {" 6.2 %"});
  CaseResult third = other;  // with a reference of its own
  third.id = "ring514/vpl";
  third.accuracy->reference.noise_floor_smape = 3;
  r.cases.push_back(third);
  expect_parts(split(terminal_table(r))[7], {"noise floor", " 3 … 12 "});
}

TEST(Table, WhatCasesDifferInIsNoNoteOfAll) {
  Report r = synthetic_report();
  r.cases.push_back(r.cases[0]);
  for (size_t i : {0, 3}) r.cases[i].parameters["importance_lights"] = 128;
  EXPECT_NE(terminal_table(r).find("128 importance lights"), std::string::npos);
  r.cases[3].parameters["importance_lights"] = 1024;
  EXPECT_EQ(terminal_table(r).find("importance lights"), std::string::npos);
}

TEST(Table, ATimeOfFewFramesHasNoInterval) {
  Report r = synthetic_report();
  EXPECT_EQ(terminal_table(r).find("frames)"), std::string::npos);
  r.cases[0].frame->method = summarize({24.5, 25.5});
  EXPECT_NE(terminal_table(r).find(" 25.00 (2 frames)"), std::string::npos) << terminal_table(r);
}

TEST(Table, ClocksThatWereHeldDownAreTold) {
  Report r = synthetic_report();
  EXPECT_EQ(terminal_table(r).find("held down"), std::string::npos);
  r.scenes[0].clocks->throttled_by = {"power cap", "hot (driver)"};
  EXPECT_NE(terminal_table(r).find(
                "cornell: the GPU's clocks were held down (power cap, hot (driver)), 1800 to 1980 MHz"),
            std::string::npos);
}

TEST(Table, AColumnThatNoCaseHasIsLeftOut) {
  Report r = synthetic_report();
  EXPECT_NE(terminal_table(r).find("rays ms"), std::string::npos);
  r.cases[0].frame->host_visibility.reset();
  EXPECT_EQ(terminal_table(r).find("rays ms"), std::string::npos);
}

TEST(Table, GenerationAloneIsComparedWithTheScenesFirst) {
  Report r = synthetic_report();
  r.cases = {synthetic_failure("a/broken", Status::failed, "it crashed"), case_of("a", "mfis", "", 10),
             case_of("a", "kmeans", "", 40), case_of("b", "fis", "", 20)};
  r.cases[0].scene = "a";
  r.config["measure"] = "generation";
  r.config["pdfs_made_by"] = "mfis";
  const std::string table = terminal_table(r);
  EXPECT_EQ(table.find("SMAPE"), std::string::npos);
  expect_parts(line_of(table, "broken"), {"failed: it crashed"});
  expect_parts(line_of(table, "mfis"), {" 10.00 ", " 2.50 ", " 7.50 "});  // the G-buffer half is the second
  EXPECT_TRUE(line_of(table, "mfis").ends_with(" 1"));
  expect_parts(line_of(table, "kmeans"), {" 4.000 ["});
  EXPECT_TRUE(line_of(table, "fis").ends_with(" 1"));  // another scene
  EXPECT_EQ(signs(line_of(table, "case")), signs(line_of(table, "kmeans")));
  expect_parts(table, {"PDFs, made by mfis"});
  r.config["pdfs_made_by"] = "mfis; the power that each texel reflects";
  r.cases[1].parameters["pdf"] = "mfis";
  r.cases[2].parameters["pdf"] = "flux";
  expect_parts(terminal_table(r),
               {"on the same halves, and on the same PDFs where `pdf` is the same: mfis; the power"});
  r.cases[1].parameters["pdf"] = r.cases[2].parameters["pdf"] = "own";
  expect_parts(terminal_table(r), {"on the same halves, each method on the PDFs that it makes itself"});
  const auto rows = split(markdown_table(r));
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(std::count(rows[i].begin(), rows[i].end(), '|'), 6) << rows[i];
}

TEST(Table, CasesAreNamedByWhatTellsThemApart) {
  const std::string table = terminal_table(sweep());
  expect_parts(line_of(table, "mfis N=256"), {" 250 "});
  EXPECT_EQ(table.find("mfis N=256,rsm"), std::string::npos);
  expect_parts(line_of(table, "every case"), {"every case: rsm=256"});
}

TEST(Table, MethodsAcross) {
  const auto rows = split(markdown_table(sweep(), {{"generate", "ratio"}, {}, "method", ""}));
  EXPECT_EQ(rows[0], "| case | fis | mfis | noise floor |");
  EXPECT_EQ(rows[2], "| a N=64 | 10.00 / 1.00 | 30.00 / 3.00 | 12 % / 12 % |");
  EXPECT_EQ(rows[3], "| a N=256 | 20.00 / 2.00 | 250 / 25.00 | 12 % / 12 % |");
  EXPECT_EQ(rows[4], "| b N=64 | 50.00 / 1.00 | | 25 % / 25 % |");  // of mfis no such case
  EXPECT_EQ(rows[6], "each cell: generate ms / x first;");
}

TEST(Table, NoiseThatNobodyMeasuredHasNoPlaceAcross) {
  Report r = sweep();
  r.aa.clear();
  EXPECT_EQ(split(markdown_table(r, {{"generate"}, {}, "method", ""}))[0], "| case | fis | mfis |");
  EXPECT_EQ(markdown_table(r, {{"generate"}, {}, "scene", ""}).find("noise floor"), std::string::npos);
  r.aa = {{"a", "x", "y", {synthetic_noise("generate.rsm", 0.125)}}};
  const auto rows = split(markdown_table(r, {{"generate", "generate.rsm"}, {"a/*"}, "method", ""}));
  EXPECT_EQ(rows[2], "| a N=64 | 10.00 / 7.50 | 30.00 / 22.50 | - / 12 % |");
}

TEST(Table, ScenesOrAKeyAcross) {
  const auto scenes = split(markdown_table(sweep(), {{"generate"}, {"*/N=64,*"}, "scene", ""}));
  EXPECT_EQ(scenes[0], "| case | a | b |");
  EXPECT_EQ(scenes[2], "| fis | 10.00 | 50.00 |");
  EXPECT_EQ(scenes[3], "| mfis | 30.00 | |");
  EXPECT_EQ(scenes[4], "| noise floor | 12 % | 25 % |");
  const auto keys = split(markdown_table(sweep(), {{"generate"}, {"a/*"}, "N", ""}));
  EXPECT_EQ(keys[0], "| case | N=64 | N=256 | noise floor |");
  EXPECT_EQ(keys[3], "| a mfis | 30.00 | 250 | 12 % |");
}

TEST(Table, WhatIsNotInTheReportIsRefused) {
  EXPECT_THROW(terminal_table(sweep(), {{"smape"}, {}, "", ""}), Error);  // generation alone has no errors
  EXPECT_THROW(terminal_table(sweep(), {{}, {"c/*"}, "", ""}), Error);
  EXPECT_THROW(terminal_table(sweep(), {{}, {}, "K", ""}), Error);
}

TEST(Table, SaysWhatTheTimesAreWorth) {
  Report r = synthetic_report();
  expect_parts(terminal_table(r), {"do not compare its times with a GPU's", "host: A CPU, 2 cores"});
  EXPECT_EQ(terminal_table(r).find("busy"), std::string::npos);  // load 0.25
  EXPECT_EQ(terminal_table(r).find("incomplete"), std::string::npos);
  r.complete = false;
  r.device.type = "discrete";
  r.host.load_at_start = 1.25;
  expect_parts(terminal_table(r),
               {"incomplete", "the machine was busy when the run began: load 1.25 on 2 cores"});
  EXPECT_EQ(terminal_table(r).find("do not compare"), std::string::npos);
  r.host.load_at_start = 1;  // half of the cores
  EXPECT_EQ(terminal_table(r).find("busy"), std::string::npos);
}

// A report of old that lacks the median of seeds of which one is a spike, or has it where there is none.
TEST(Table, SeedsTellHeavyTails) {
  Report r = synthetic_report();
  CaseResult& c = r.cases[0];
  for (size_t s = 0; s < c.seeds.size(); ++s) c.seeds[s].errors.rmse = s == 0 ? 5 : 0.25;
  const auto cell = [&] { return split(csv_table(r, {{"rmse"}, {c.id}, "", ""}))[1]; };
  c.accuracy->rmse.value = 0.84;
  EXPECT_TRUE(cell().ends_with(",0.25,0.25,5")) << cell();
  expect_parts(markdown_table(r, {{"rmse"}, {c.id}, "", ""}), {"0.25 [0.25 … 5]"});
  EXPECT_EQ(split(markdown_table(r, {{"rmse"}, {c.id}, "method", ""}))[2].find("0.84"), std::string::npos);
  for (SeedResult& s : c.seeds) s.errors.rmse = 0.84;
  c.accuracy->rmse.heavy_tailed = true;
  c.accuracy->rmse.median = c.accuracy->rmse.least = c.accuracy->rmse.largest = 7;
  EXPECT_NE(cell().find(",0.84,"), std::string::npos) << cell();
  c.seeds.clear();  // nothing to judge by
  EXPECT_TRUE(cell().ends_with(",7,7,7")) << cell();
}

TEST(Table, FlickerHasColumnsWhereSomethingMoves) {
  Report r = synthetic_report();
  const auto rows =
      split(markdown_table(r, {{"flicker", "static_flicker", "detail"}, {"cornell/mfis*"}, "", ""}));
  EXPECT_EQ(rows[0], "| case | flicker | static flicker | detail |");
  expect_parts(rows[2], {"| 0.1000 ± 0.01 | 0.0500 | 0.9000 ± 0.1 |"});
  expect_parts(terminal_table(r), {" flicker ", "relative to the mean of the references: flicker, how far"});
  const auto csv = split(csv_table(r, {{"flicker", "static_flicker"}, {"cornell/mfis*"}, "", ""}));
  EXPECT_TRUE(
      csv[0].ends_with(",flicker,flicker_lo,flicker_hi,static_flicker,static_flicker_lo,static_flicker_hi"));
  EXPECT_TRUE(csv[1].ends_with(",0.1,0.09,0.11,0.05,,")) << csv[1];
  expect_parts(latex_table(r), {"& flicker & static flicker & detail &", "0.1000 $\\pm$ 0.01"});

  r.cases = {r.cases[0], r.cases[0]};
  r.cases[1].id = "cornell/steady";
  r.cases[1].temporal->derivative.value = 0.05;
  TableOptions least{{"flicker"}, {}, "", "flicker"};
  EXPECT_TRUE(split(markdown_table(r, least))[2].starts_with("| cornell steady |"));
  least.sort = "-flicker";
  EXPECT_TRUE(split(markdown_table(r, least))[3].starts_with("| cornell steady |"));

  for (CaseResult& c : r.cases) c.temporal.reset();
  EXPECT_EQ(terminal_table(r).find("flicker"), std::string::npos);
}

TEST(Table, WhereTheTimeWentIsNoShareOfNothing) {
  WallTime w{10, 2, 3, 1, 0.5, 1.75};
  EXPECT_EQ(
      wall_text(w),
      "10.0 s in all: frames on the device 2.0, references 3.0, exact visibility 1.0, compilation 0.5, the "
      "rest 3.5, 175 % of the device's time");
  w.device_s = 0;
  EXPECT_TRUE(wall_text(w).ends_with(", the rest 5.5"));
}

TEST(Table, MarkdownHasItsColumnsInEveryRow) {
  Report r = synthetic_report();
  r.cases[1].error->message = "a | b";
  const auto lines = split(markdown_table(r));
  const auto bars = [](const std::string& line) {
    size_t count = 0;
    for (size_t k = 0; k < line.size(); ++k) count += line[k] == '|' && (k == 0 || line[k - 1] != '\\');
    return count;
  };
  EXPECT_GE(bars(lines[0]), 9u);
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(bars(lines[i]), bars(lines[0])) << lines[i];
}

TEST(Table, NothingOfAReportReachesTheTerminalRaw) {
  Report r = synthetic_report();
  r.cases[0].id = "cornell/\x1b[2Jmfis";
  r.cases[1].error->message = "two\nlines\x7f";
  r.device.name = "\x1b]0;title\x07";
  for (const auto& table : {terminal_table(r), markdown_table(r)}) {
    EXPECT_TRUE(std::ranges::none_of(
        table, [](char c) { return c != '\n' && (static_cast<unsigned char>(c) < 0x20 || c == 0x7f); }));
    EXPECT_EQ(table.find("two\nlines"), std::string::npos);
  }
}
