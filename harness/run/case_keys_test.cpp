// The table of keys, and what is written from it.
#include "run/case_keys.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "run/case_key_docs.h"
#include "run/run_fixture.h"

namespace vsglbench {
namespace {

// Every default is a value that the key takes, and what is written is read again.
TEST(CaseKeys, EachReadsItsDefaultAndWritesWhatItRead) {
  for (const CaseKey& key : case_keys()) {
    FrameParameters frame;
    key.read(key.default_value, &frame);
    EXPECT_EQ(key.write(frame), key.default_value) << key.name;
    EXPECT_EQ(key.write(FrameParameters()), key.default_value) << key.name;
    EXPECT_TRUE(schema_violations(key.default_value, key.schema).empty()) << key.name;
    EXPECT_FALSE(key.help.empty() || key.help.find('\n') != std::string::npos) << key.name;
    EXPECT_EQ(find_case_key(key.name), &key);
  }
  EXPECT_EQ(find_case_key("n"), nullptr);
}

// The schema of a value takes what the reader takes, and no more.
TEST(CaseKeys, SchemaAndReaderAgree) {
  const std::vector<Json> tried = {0,        1,      -1,       0.0,     -0.0,    0.5,
                                   2,        2.0,    2.2925,   1 << 30, 1e300,   "0",
                                   "exact",  "own",  "flux",   "sigma", "tism",  "off",
                                   "vsgl14", "disk", "2.2925", true,    nullptr, Json::array()};
  for (const CaseKey& key : case_keys()) {
    for (const Json& value : tried) {
      bool read = true;
      try {
        FrameParameters frame;
        key.read(value, &frame);
      } catch (const Error&) {
        read = false;
      }
      EXPECT_EQ(read, schema_violations(value, key.schema).empty()) << key.name << " " << value;
    }
  }
}

TEST(CaseKeys, AChoiceThatIsANumberIsOneHoweverItIsWritten) {
  const CaseKey& clearance = *find_case_key("light_clearance");
  for (const Json& value : {Json(0), Json(0.0), Json("0")}) {
    FrameParameters frame;
    clearance.read(value, &frame);
    EXPECT_EQ(clearance.write(frame), "0") << value;
  }
}

// The lines of `text` between the line that begins with `after` and the next that begins with `before`.
struct Block {
  size_t begin, end;
};
Block block_of(const std::string& text, const std::string& after, const std::string& before) {
  const size_t begin = text.find('\n', text.find("\n" + after) + 1) + 1;
  return {begin, text.find("\n" + before, begin - 1) + 1};
}

// With VSGLBENCH_WRITE_KEYS (ci/write-keys) the lines are written instead.
void expect_block(const std::filesystem::path& file, const std::string& after, const std::string& before,
                  const std::string& wanted) {
  std::string text = read_text(file);
  const Block block = block_of(text, after, before);
  ASSERT_NE(block.end, 0u) << file;
  if (std::getenv("VSGLBENCH_WRITE_KEYS")) {
    write_text(file, text.replace(block.begin, block.end - block.begin, wanted));
    return;
  }
  EXPECT_EQ(text.substr(block.begin, block.end - block.begin), wanted)
      << file << " is not what the table of keys says; run ci/write-keys";
}

TEST(CaseKeys, TheSchemaHasThemAll) {
  const auto file = std::filesystem::path(VSGLBENCH_SOURCE_DIR) / "harness" / "run" / "config.schema.json";
  expect_block(file, "    \"methods\":", "    \"preset\":", keys_as_schema());
}

TEST(CaseKeys, TheReadmeHasThemAll) {
  const auto file = std::filesystem::path(VSGLBENCH_SOURCE_DIR) / "configs" / "README.md";
  expect_block(file, "| --- | --- | --- | --- | --- |", "\n", keys_as_markdown());
}

}  // namespace
}  // namespace vsglbench
