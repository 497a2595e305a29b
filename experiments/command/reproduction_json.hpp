#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/engine/result_table.hpp"

namespace alea::command {

/// The cells of a reproduction as `alea reproduce --json` writes them (schema reproduce.v1).
nlohmann::json reproduction_json(const std::vector<experiments::ResultTable>& tables,
                                 std::uint64_t seed, bool smoke);

}  // namespace alea::command
