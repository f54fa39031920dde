#include "base/json.h"

#include <gtest/gtest.h>

using namespace vsglbench;

namespace {

std::string message_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

JsonDocument parse(std::string_view text) { return JsonDocument::parse(text, "f.json", ErrorKind::config); }

const char* kSchema = R"({
  "type": "object", "required": ["name"], "additionalProperties": false,
  "properties": {"name": {"type": "string"}, "size": {"type": "integer", "minimum": 1},
                 "id": {"type": "string", "pattern": "^[a-z]+$"}, "kind": {"enum": ["spot", "sun"]}, "list": {"type": "array", "items": {"type": "number"}}}})";

}  // namespace

TEST(Json, RecordsTheLineOfEveryValue) {
  const auto doc = parse("{\n  \"a\": 1,\n  \"b\": [\n    10,\n    20\n  ],\n  \"c\": {\"d\": true}\n}\n");
  EXPECT_EQ(doc.line("/a"), 2);
  EXPECT_EQ(doc.line("/b"), 3);
  EXPECT_EQ(doc.line("/b/0"), 4);
  EXPECT_EQ(doc.line("/b/1"), 5);
  EXPECT_EQ(doc.line("/c/d"), 7);
  EXPECT_EQ(doc.line("/c/missing"), 7);
  EXPECT_EQ(doc.root()["b"][1], 20);
}

TEST(Json, SyntaxErrorsSayTheLine) {
  EXPECT_NE(message_of([] { parse("{\n\"a\": 1,\n\"b\": }\n"); }).find("f.json:3: not JSON"),
            std::string::npos);
  EXPECT_EQ(message_of([] { parse("{\n\"a\": 1,\n\"a\": 2}\n"); }),
            "f.json:3: the key 'a' stands here twice");
  EXPECT_NE(message_of([] { parse(std::string(100, '[')); }).find("nested deeper"), std::string::npos);
  EXPECT_NE(message_of([] { parse(""); }).find("f.json:1: not JSON"), std::string::npos);
}

TEST(Json, SchemaErrorsSayLineAndNearestKey) {
  const Json schema = Json::parse(kSchema);
  EXPECT_EQ(message_of([&] { check_schema(parse("{\"name\": \"x\",\n\"sise\": 3}"), schema); }),
            "f.json:2: 'sise' unknown key 'sise'; did you mean 'size'?");
  EXPECT_EQ(message_of([&] { check_schema(parse("{\"name\": \"x\",\n\n\"size\": 0}"), schema); }),
            "f.json:3: 'size' 0 must be at least 1");
  EXPECT_EQ(message_of([&] { check_schema(parse("{\"name\": \"x\", \"kind\": \"spit\"}"), schema); }),
            "f.json:1: 'kind' 'spit' is not allowed; did you mean 'spot'?");
  EXPECT_EQ(message_of([&] { check_schema(parse("{}"), schema); }), "f.json:1: lacks 'name'");
  EXPECT_EQ(message_of([&] { check_schema(parse("{\"name\": \"x\", \"list\": [1,\n\"2\"]}"), schema); }),
            "f.json:2: 'list/1' is \"2\" but must be number");
  EXPECT_EQ(message_of([&] { check_schema(parse("{\"name\": \"x\", \"size\": 2}"), schema); }), "no error");
}

TEST(Json, ATextTooLongForItsPatternIsRefused) {
  const auto message_for = [](size_t bytes) {
    const Json schema = Json::parse(kSchema);
    return message_of(
        [&] { check_schema(parse(R"({"name": "x", "id": ")" + std::string(bytes, 'a') + "\"}"), schema); });
  };
  EXPECT_EQ(message_for(4096), "no error");
  EXPECT_EQ(message_for(1 << 20), "f.json:1: 'id' has 1048576 bytes but may have 4096");
}

TEST(Json, ListsAllViolations) {
  const auto found = schema_violations(Json::parse(R"({"size": 0, "kind": 4})"), Json::parse(kSchema));
  EXPECT_EQ(found.size(), 3u);
}
