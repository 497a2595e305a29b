#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "alea/die/die_shape.hpp"

namespace alea::command {

/// Reads a die's shape: a DIE.json, or a file that holds it as its `die` (truth.json of `alea
/// simulate`). `planes` has "1" to "6" with `normal` and `offset_m` in one die frame, null for a
/// facet that was never seen. Throws Error(input) naming file and entry.
DieShape read_die_file(const std::string& path);

/// Parses a JSON file. Throws Error(input) naming the file and what its contents should be.
nlohmann::json read_json_file(const std::string& path, const std::string& expectation);

}  // namespace alea::command
