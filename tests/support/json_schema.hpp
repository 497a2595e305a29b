#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace alea::testing {

/// What is wrong with `value` by `schema`, one line for each place; empty where it conforms.
/// The subset of JSON Schema (draft 2020-12) that the project's schemas use: type, enum, const,
/// properties, required, additionalProperties, items, minItems, maxItems, minimum, maximum,
/// pattern, anyOf and $ref into $defs. A schema with another keyword is itself reported, so that
/// no rule goes unchecked.
std::vector<std::string> schema_violations(const nlohmann::json& value,
                                           const nlohmann::json& schema);

/// The schema of one command's output, e.g. "register.v1".
nlohmann::json load_schema(const std::string& name);

}  // namespace alea::testing
