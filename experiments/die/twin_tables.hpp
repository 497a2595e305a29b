#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/die/twin_trial.hpp"
#include "experiments/engine/result_table.hpp"

namespace alea::experiments::die {

/// The twins of every dataset, keyed "A" to "D".
using TwinRuns = std::map<std::string, std::vector<TwinOutcome>>;

/// Table 1: counts, distances and facets are inputs; the angular steps that they imply are ours.
ResultTable twin_table1(const PublishedTables& tables, const TwinRuns& runs);

/// Tables 2 (A) to 5 (D): the RMSE of the check planes, every printed cell judged.
ResultTable twin_check_plane_table(const PublishedTables& tables, const TwinRuns& runs,
                                   const std::string& dataset);

/// Table 6: the angles are inputs (their size is the tilts' prior), the calibrated edges judged.
ResultTable twin_table6(const PublishedTables& tables, const TwinRuns& runs);

/// The data that the paper omits, in the order in which every sample carries its draws.
const std::vector<std::string>& omitted_data();

/// The draws of the omitted data that concern one check plane of a twin.
std::vector<double> omitted_draws(const TwinOutcome& outcome, std::size_t plane);

}  // namespace alea::experiments::die
