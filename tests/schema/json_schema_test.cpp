#include "tests/support/json_schema.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/paths.hpp"

namespace {

using alea::testing::schema_violations;
using nlohmann::json;

const json point = json::parse(R"({
  "$defs": {"number_or_null": {"type": ["number", "null"]}},
  "type": "object", "required": ["status", "xyz"], "additionalProperties": false,
  "properties": {
    "status": {"enum": ["measured", "refused"]},
    "edge": {"type": "string", "pattern": "^[1-6]-[1-6]$"},
    "sd": {"$ref": "#/$defs/number_or_null"},
    "share": {"type": "number", "minimum": 0, "maximum": 1},
    "xyz": {"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number"}},
    "any": {"anyOf": [{"type": "null"}, {"type": "object", "required": ["code"]}]}
  }})");

TEST(JsonSchema, AcceptsWhatConforms) {
  const json value = json::parse(
      R"({"status": "measured", "xyz": [1, 2, 3.5], "edge": "1-2", "sd": null, "any": {"code": "x"}})");
  EXPECT_TRUE(schema_violations(value, point).empty());
}

TEST(JsonSchema, ReportsEachBrokenRuleOnce) {
  const auto violations_with = [](const char* change) {
    json value = json::parse(R"({"status": "measured", "xyz": [1, 2, 3]})");
    value.merge_patch(json::parse(change));
    return schema_violations(value, point).size();
  };
  EXPECT_EQ(violations_with(R"({})"), 0u);
  EXPECT_EQ(violations_with(R"({"status": "done"})"), 1u);
  EXPECT_EQ(violations_with(R"({"status": null})"), 1u);  // the patch removes a required member
  EXPECT_EQ(violations_with(R"({"xyz": [1, 2]})"), 1u);
  EXPECT_EQ(violations_with(R"({"xyz": [1, 2, 3, 4]})"), 1u);
  EXPECT_EQ(violations_with(R"({"xyz": [1, 2, "3"]})"), 1u);
  EXPECT_EQ(violations_with(R"({"edge": "1-7"})"), 1u);
  EXPECT_EQ(violations_with(R"({"sd": "small"})"), 1u);
  EXPECT_EQ(violations_with(R"({"share": 1.5})"), 1u);
  EXPECT_EQ(violations_with(R"({"share": -0.5})"), 1u);
  EXPECT_EQ(violations_with(R"({"any": {"no": 1}})"), 1u);
  EXPECT_EQ(violations_with(R"({"extra": 1})"), 1u);
}

TEST(JsonSchema, ReportsAKeywordThatItCannotCheck) {
  EXPECT_EQ(schema_violations(json(1), json{{"multipleOf", 2}}).size(), 1u);
}

TEST(JsonSchema, EverySchemaFileIsReadableAndNamesItself) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(alea::testing::source_dir()) / "experiments/command/schemas";
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream file(entry.path());
    const json schema = json::parse(file);
    EXPECT_EQ(schema.value("$id", ""), "alea:" + entry.path().stem().string()) << entry.path();
    EXPECT_FALSE(schema.value("description", "").empty()) << entry.path();
  }
}

}  // namespace
