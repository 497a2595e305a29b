#pragma once

#include "experiments/engine/result_table.hpp"
#include "experiments/markerless/published.hpp"
#include "experiments/markerless/twin_study.hpp"

namespace alea::experiments::markerless {

/// Table 1 on the twin: each sampling's counts, time and RMSE, at the estimate and at the truth.
ResultTable twin_table1(const PublishedTables& published, const TwinScans& scans);

/// Table 2 on the twin: counts for each grid, and their fall as the grid doubles.
ResultTable twin_table2(const PublishedTables& published, const TwinScans& scans);

/// Table 3 or 4 on a twin: averages of both blocks and every statement of the text.
ResultTable twin_pairs_table(const std::string& id, const std::string& title,
                             const std::vector<PublishedPair>& published,
                             const std::vector<PublishedAverage>& averages,
                             const std::vector<PaperTrial>& trials);

/// The trials one by one, for pictures and for reading.
std::string trials_csv(const std::vector<PaperTrial>& trials);

}  // namespace alea::experiments::markerless
