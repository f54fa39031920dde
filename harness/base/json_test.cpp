#include "base/json.h"

#include <gtest/gtest.h>

#include "base/json_number.h"

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

TEST(Json, ATextOfAnyLengthIsHeldAgainstItsPattern) {
  const auto message_for = [](const std::string& id) {
    const Json schema = Json::parse(kSchema);
    return message_of([&] { check_schema(parse(R"({"name": "x", "id": ")" + id + "\"}"), schema); });
  };
  EXPECT_EQ(message_for(std::string(1 << 20, 'a')), "no error");
  EXPECT_EQ(message_for(std::string(1 << 20, 'A')), "f.json:1: 'id' '" + std::string(95, 'A') + "…" +
                                                        std::string(24, 'A') + "' does not match ^[a-z]+$");
}

TEST(Json, AStringMayBeAsLongAsItsSchemaSays) {
  const Json schema = Json::parse(R"({"properties": {"name": {"type": "string", "maxLength": 3}}})");
  EXPECT_EQ(message_of([&] { check_schema(parse(R"({"name": "äöü"})"), schema); }), "no error");
  EXPECT_EQ(message_of([&] { check_schema(parse(R"({"name": "abcd"})"), schema); }),
            "f.json:1: 'name' has 4 characters but may have 3");
  const Json names = Json::parse(R"({"type": "object", "propertyNames": {"maxLength": 2}})");
  EXPECT_EQ(message_of([&] { check_schema(parse(R"({"ab": 1})"), names); }), "no error");
  EXPECT_EQ(message_of([&] { check_schema(parse(R"({"abc": 1})"), names); }),
            "f.json:1: 'abc' has 3 characters but may have 2");
}

TEST(Json, WholeNumbersAreIntegers) {
  const Json schema = Json::parse(kSchema);
  EXPECT_EQ(message_of([&] { check_schema(parse(R"({"name": "x", "size": 16.0})"), schema); }), "no error");
  EXPECT_EQ(message_of([&] { check_schema(parse(R"({"name": "x", "size": 16.5})"), schema); }),
            "f.json:1: 'size' is 16.5 but must be integer");
  EXPECT_EQ(message_of([&] { check_schema(parse(R"({"name": "x", "size": 1e300})"), schema); }),
            "f.json:1: 'size' is 1e+300 but must be integer");
  EXPECT_EQ(with_integers(Json::parse(R"({"N": [16.0, 0.5, -0.0], "s": "1.0"})")).dump(),
            R"({"N":[16,0.5,0],"s":"1.0"})");
}

// Whatever part of a file an error quotes: it is short, and nothing in it steers the terminal.
TEST(Json, ErrorsQuoteNoMoreThanAnExcerpt) {
  const Json schema = Json::parse(kSchema);
  const std::string esc = "\\u001b[2J" + std::string(1 << 20, 'x');
  for (const std::string& text :
       {R"({"name": 1, ")" + esc + "\": 2}",               // a key
        R"({"name": "x", "kind": ")" + esc + "\"}",        // a value of an enum
        R"({"name": "x", "id": ")" + esc + "\"}",          // of a pattern
        R"({"name": "x", "size": ")" + esc + "\"}",        // of another type
        R"({"name": "x", "list": [")" + esc + "\"]}",      // in a list
        R"({"name": ")" + esc + "\" \"",                   // before a fault of syntax
        "{\"" + std::string(1 << 20, 'k') + "\x1b\": 1}",  // a token that is no JSON
        R"({")" + esc + R"(": 1, ")" + esc + "\": 2}"}) {  // a key that stands twice
    const std::string message = message_of([&] { check_schema(parse(text), schema); });
    EXPECT_LT(message.size(), 600u) << message.substr(0, 200);
    EXPECT_EQ(message.find('\x1b'), std::string::npos) << message.substr(0, 200);
    EXPECT_EQ(message.rfind("f.json:1: ", 0), 0u) << message.substr(0, 200);
  }
}

TEST(Json, ListsAllViolations) {
  const auto found = schema_violations(Json::parse(R"({"size": 0, "kind": 4})"), Json::parse(kSchema));
  EXPECT_EQ(found.size(), 3u);
}
