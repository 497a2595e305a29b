#pragma once

#include <string>
#include <vector>

#include "experiments/engine/result_table.hpp"
#include "experiments/markerless/twin_study.hpp"

namespace alea::experiments::markerless {

/// The keypoint step that the paper describes and its numbers do not contain: ICP of all points of
/// the grid (`every_point`, the pairs' trials) beside ICP of their Harris and ISS keypoints.
void add_keypoint_cells(const std::string& building, const TwinScans& scans,
                        const std::vector<ScanPair>& pairs,
                        const std::vector<PaperTrial>& every_point, ResultTable& table,
                        const ProgressCallback& progress = {});

/// The empty table.
ResultTable keypoint_table();

}  // namespace alea::experiments::markerless
