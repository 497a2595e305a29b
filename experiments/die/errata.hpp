#pragma once

#include <cstdint>

#include "experiments/engine/result_table.hpp"

namespace alea::experiments::die {

/// What each misprint of the paper's equations does to a perfect die without noise.
ResultTable errata_table(std::uint64_t seed);

/// What the choice of the fixed axis leaks of a die's tilts, noise-free.
ResultTable frame_rule_table(std::uint64_t dice, std::uint64_t seed);

}  // namespace alea::experiments::die
