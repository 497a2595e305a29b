#pragma once

#include "experiments/die/twin_tables.hpp"

namespace alea::experiments::die {

/// The statements that the paper's text makes about its method, each against the twins: what holds,
/// what does not, what cannot be decided from what is printed.
ResultTable twin_statements(const PublishedTables& tables, const TwinRuns& runs);

/// The statements that need no scan: quality of manufacture, overlapping facets, range. `dice` per
/// cell, noise-free and drawn with `seed`.
ResultTable shape_statements(std::size_t dice, std::uint64_t seed);

}  // namespace alea::experiments::die
