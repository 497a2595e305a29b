#pragma once

#include <string>
#include <vector>

#include "alea/core/progress.hpp"
#include "alea/pipeline/register_by_paper.hpp"
#include "experiments/markerless/twin_scene.hpp"

namespace alea::experiments::markerless {

/// A twin's scans with the truth.
struct TwinScans {
  std::vector<std::string> names;
  std::vector<Cloud> clouds;
  std::vector<RigidTransform> scene_from_scan;
  RigidTransform truth(std::size_t fixed, std::size_t moving) const {
    return scene_from_scan[fixed].inverse() * scene_from_scan[moving];
  }
};

/// Scans of the given stations (all where empty), the noise keyed by `seed`.
TwinScans scan_twin(const Scene& scene, const std::vector<std::size_t>& stations,
                    std::uint64_t seed);

/// How far a pose is from the truth.
struct PoseError {
  double rotation_deg = 0, translation_m = 0;
  /// 1 deg and 0.1 m.
  bool is_right() const { return rotation_deg < 1 && translation_m < 0.1; }
};
PoseError pose_error(const RigidTransform& estimate, const RigidTransform& truth);

/// Root mean square of the nearest-neighbour distances of what ICP pairs, at a pose, as it reports
/// it.
double rmse_at(const Cloud& fixed, const Cloud& moving, const RigidTransform& fixed_from_moving,
               const PaperIcpOptions& options);

/// The same for scans that are prepared already.
double rmse_at(const PaperScan& fixed, const PaperScan& moving,
               const RigidTransform& fixed_from_moving);

/// One pair by the paper's method, beside the truth.
struct PaperTrial {
  std::string fixed, moving;
  RigidTransform estimate, truth;
  PoseError error;
  double rmse_m = 0, rmse_at_truth_m = 0;
  double overlap = 0, overlap_at_truth = 0;  ///< share of the moving points
  int iterations = 0;
  std::size_t points_moving = 0;  ///< of the moving scan that ICP sees
  double time_s = 0;
};

/// Places in the twin's scans.
struct ScanPair {
  std::size_t fixed = 0, moving = 0;
};

/// The reference station with every other, then every other with the reference.
std::vector<ScanPair> reference_pairs(std::size_t scans, std::size_t reference);

/// Every scan with every other, both ways.
std::vector<ScanPair> all_pairs(std::size_t scans);

/// The paper's method on pairs; one with too few keypoints makes no trial.
std::vector<PaperTrial> run_paper(const TwinScans& scans, const std::vector<ScanPair>& pairs,
                                  const PaperIcpOptions& options,
                                  const ProgressCallback& progress = {});

}  // namespace alea::experiments::markerless
