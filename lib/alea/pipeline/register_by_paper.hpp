#pragma once

#include <optional>

#include "alea/pipeline/register_markerless.hpp"

namespace alea {

/// A scan as the orientation study registers it.
struct PaperScan {
  Cloud grid;  ///< its grid average; normals where keypoints or the objective need them
  std::optional<Cloud> keypoints;
  /// What ICP sees.
  const Cloud& registered() const { return keypoints ? *keypoints : grid; }
};

/// `is_target`: point-to-plane needs its normals. Throws as grid_average and the keypoints do.
PaperScan prepare_paper_scan(const Cloud& scan, const PaperIcpOptions& options, bool is_target);

/// The chain of Mohd Isa and others 2019: grid average, keypoints where they are asked for, ICP of
/// all nearest neighbours from identity (or `initial`). `rmse_m` is of the pairs of ICP, overlaps
/// are of the grids. Refuses only a scan with fewer keypoints than the objective needs.
MarkerlessRegistration register_by_paper(const Cloud& fixed, const Cloud& moving,
                                         const MarkerlessOptions& options);

/// The same for scans that are prepared already; `fixed` as a target.
MarkerlessRegistration register_paper_scans(const PaperScan& fixed, const PaperScan& moving,
                                            const MarkerlessOptions& options);

}  // namespace alea
