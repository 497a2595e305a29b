#include "tests/support/json_schema.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <stdexcept>

#include "tests/support/paths.hpp"

namespace alea::testing {
namespace {

using nlohmann::json;

const std::set<std::string> annotations{"$schema", "$id", "$defs", "title", "description"};
const std::set<std::string> rules{
    "type",     "enum",    "const",   "properties", "required", "items", "minItems",
    "maxItems", "minimum", "maximum", "pattern",    "anyOf",    "$ref",  "additionalProperties"};

bool has_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number_integer();
  throw std::runtime_error("schema: unknown type " + type);
}

class Checker {
 public:
  explicit Checker(const json& root) : root_(root) {}

  void check(const json& value, const json& schema, const std::string& path) {
    if (schema.is_boolean()) {
      if (!schema.get<bool>()) report(path, "is not allowed here");
      return;
    }
    for (const auto& [keyword, rule] : schema.items())
      if (!annotations.contains(keyword) && !rules.contains(keyword))
        report(path, "the schema uses the unsupported keyword " + keyword);
    check_value(value, schema, path);
    if (value.is_object()) check_object(value, schema, path);
    if (value.is_array()) check_array(value, schema, path);
  }

  std::vector<std::string> take() { return std::move(found_); }

 private:
  void report(const std::string& path, const std::string& what) {
    found_.push_back((path.empty() ? "/" : path) + ": " + what);
  }

  void check_value(const json& value, const json& schema, const std::string& path) {
    if (schema.contains("$ref")) check(value, resolve(schema["$ref"]), path);
    if (schema.contains("type")) {
      const json types = schema["type"].is_array() ? schema["type"] : json::array({schema["type"]});
      if (std::none_of(types.begin(), types.end(),
                       [&](const json& t) { return has_type(value, t); }))
        report(path, "is " + std::string(value.type_name()) + ", not " + types.dump());
    }
    if (schema.contains("const") && value != schema["const"])
      report(path, "is " + value.dump() + ", not " + schema["const"].dump());
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
      report(path, value.dump() + " is none of " + schema["enum"].dump());
    if (schema.contains("anyOf")) check_any(value, schema["anyOf"], path);
    if (value.is_number()) {
      const double number = value.get<double>();
      if (schema.contains("minimum") && !(number >= schema["minimum"].get<double>()))
        report(path, value.dump() + " is below " + schema["minimum"].dump());
      if (schema.contains("maximum") && !(number <= schema["maximum"].get<double>()))
        report(path, value.dump() + " is above " + schema["maximum"].dump());
    }
    if (value.is_string() && schema.contains("pattern") &&
        !std::regex_search(value.get<std::string>(),
                           std::regex(schema["pattern"].get<std::string>())))
      report(path, value.dump() + " does not match " + schema["pattern"].dump());
  }

  void check_any(const json& value, const json& alternatives, const std::string& path) {
    std::string why;
    for (const json& alternative : alternatives) {
      Checker one(root_);
      one.check(value, alternative, path);
      if (one.found_.empty()) return;
      why += (why.empty() ? "" : " | ") + one.found_.front();
    }
    report(path, "fits no alternative: " + why);
  }

  void check_object(const json& value, const json& schema, const std::string& path) {
    for (const json& name : schema.value("required", json::array()))
      if (!value.contains(name)) report(path, "lacks " + name.dump());
    const json properties = schema.value("properties", json::object());
    for (const auto& [name, member] : value.items()) {
      if (properties.contains(name))
        check(member, properties[name], path + "/" + name);
      else if (schema.contains("additionalProperties"))
        check(member, schema["additionalProperties"], path + "/" + name);
    }
  }

  void check_array(const json& value, const json& schema, const std::string& path) {
    if (schema.contains("minItems") && value.size() < schema["minItems"].get<std::size_t>())
      report(path, "has fewer than " + schema["minItems"].dump() + " items");
    if (schema.contains("maxItems") && value.size() > schema["maxItems"].get<std::size_t>())
      report(path, "has more than " + schema["maxItems"].dump() + " items");
    if (!schema.contains("items")) return;
    for (std::size_t i = 0; i < value.size(); ++i)
      check(value[i], schema["items"], path + "/" + std::to_string(i));
  }

  const json& resolve(const std::string& reference) const {
    if (!reference.starts_with("#/")) throw std::runtime_error("schema: outside reference");
    return root_.at(json::json_pointer(reference.substr(1)));
  }

  const json& root_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> schema_violations(const json& value, const json& schema) {
  Checker checker(schema);
  checker.check(value, schema, "");
  return checker.take();
}

json load_schema(const std::string& name) {
  const std::string path = testing::source_dir() + "/experiments/command/schemas/" + name + ".json";
  std::ifstream file(path);
  if (!file) throw std::runtime_error("no schema " + path);
  return json::parse(file);
}

}  // namespace alea::testing
