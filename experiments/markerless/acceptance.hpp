#pragma once

#include <string>
#include <vector>

#include "experiments/engine/acceptance.hpp"

namespace alea::acceptance {

/// The topics of the markerless study, in the order in which they run.
std::vector<Topic> markerless_topics();

/// A number without a sampling error, judged as it is; `n` is what it was counted over.
Cell point_cell(const std::string& name, double value, const std::string& unit, const Limit& limit,
                std::uint64_t n);

/// Line 1: Table 1's ratio at the true pose, and how counts fall as the grid doubles.
void run_markerless_tables(const Options& options, const Report& report);
/// Line 2: the paper's method on both twins; trials: layouts of each.
void run_markerless_paper(const Options& options, const Report& report);
/// Line 3: the robust method on layouts that it was never tuned on; trials: layouts.
void run_markerless_layouts(const Options& options, const Report& report);
/// Line 3: the bare symmetric tower; trials: pairs.
void run_markerless_bare(const Options& options, const Report& report);
/// Line 4: networks with a fifth of their edges replaced by symmetric twins; trials: draws.
void run_markerless_network(const Options& options, const Report& report);
/// Line 6: the same bits for one and two threads and for shuffled points.
void run_markerless_bits(const Options& options, const Report& report);

}  // namespace alea::acceptance
