#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/markerless/pose_search.hpp"
#include "alea/pipeline/registration.hpp"
#include "alea/transform/icp.hpp"

namespace alea {

enum class MarkerlessMethod { paper, robust };

/// What the orientation study's ICP pairs: its text describes Harris keypoints, its numbers are
/// those of all points of the grid.
enum class PaperKeypoints { none, harris, iss };

/// The orientation study's chain: grid average, then ICP from identity over all pairs.
struct PaperIcpOptions {
  double cell_m = 0.05;  ///< of the grid average; 0: every point
  IcpObjective objective = IcpObjective::point_to_plane;
  int normal_neighbours = 6;
  int max_iterations = 20;
  double rotation_tolerance_rad = 0.5 * 3.14159265358979323846 / 180;
  double translation_tolerance_m = 0.01;
  PaperKeypoints keypoints = PaperKeypoints::none;
  /// Of Harris's neighbours and of ISS's salient ones; 2/3 of it suppresses ISS's.
  double keypoint_radius_m = 0.3;
};

/// When a pose is reported and when it is refused.
struct AcceptanceOptions {
  double least_overlap = 0.08;  ///< share of the points that agree, mean of both scans
  double largest_conflict_ratio = 0.06;
  /// And at most this times the overlap: scans that hardly meet hardly contradict each other.
  double largest_conflict_for_overlap = 0.2;
  /// Largest standard deviations of a pose that claims anything: 1 deg and 0.1 m are three of them.
  double largest_rotation_sd_rad = 3.14159265358979323846 / 180 / 3;
  double largest_position_sd_m = 0.1 / 3;  ///< of the moving scanner
  double least_margin = 0.01;              ///< of the runner-up's conflict ratio over the winner's
  double least_factor = 2;                 ///< and as a factor, both raised by conflict_floor
  double conflict_floor = 0.005;
  /// A pose whose residuals are this many times the winner's does not fit about as well.
  double largest_residual_factor = 3;
};

struct MarkerlessOptions {
  MarkerlessMethod method = MarkerlessMethod::robust;
  bool levelled = false;                  ///< both scanners' z axes are vertical within 0.5 deg
  std::optional<RigidTransform> initial;  ///< fixed_from_moving, the scans' own frames
  PaperIcpOptions paper;
  AcceptanceOptions acceptance;
  std::uint64_t seed = 1;
};

/// One pose that was considered.
struct MarkerlessAlternative {
  RigidTransform fixed_from_moving;  ///< the scans' own frames
  double overlap = 0;
  double conflict_ratio = 0;
  std::string source;  ///< the generator that proposed it
};

struct MarkerlessReport {
  double overlap_fixed = 0, overlap_moving = 0;  ///< share of the points of a scan on the other
  double conflict_ratio = 0;
  double rmse_m = 0;
  int iterations = 0;                                     ///< paper
  std::size_t keypoints_fixed = 0, keypoints_moving = 0;  ///< paper, where it asks for them
  std::optional<RigidTransform> best;  ///< the least contradicted pose, also of a refusal
  std::vector<MarkerlessAlternative> alternatives;  ///< other poses, the least contradicted first
};

struct MarkerlessRegistration {
  Registration registration;  ///< master is the fixed scan, slave the moving one
  MarkerlessReport report;
};

/// Two scans of the same place without any target in; the transform between their frames out.
/// `robust` refuses (ambiguous_target, low_overlap, no_match, unobservable) where the data cannot
/// support a pose; `paper` does where a scan has too few keypoints (too_few_points), else never.
/// Same bits for any thread count and order of the points. Throws Error(usage) for an empty cloud.
/// lib/alea/markerless/README.md.
MarkerlessRegistration register_markerless(const Cloud& fixed, const Cloud& moving,
                                           const MarkerlessOptions& options);

/// The same for scans that are prepared already, as a network of many pairs has them.
MarkerlessRegistration register_prepared(const PreparedScan& fixed, const PreparedScan& moving,
                                         const MarkerlessOptions& options);

}  // namespace alea
