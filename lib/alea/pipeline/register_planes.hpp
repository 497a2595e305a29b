#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/pipeline/registration.hpp"
#include "alea/plane/plane_detector.hpp"

namespace alea {

struct PlaneRegistrationOptions {
  PlaneDetector planes = PlaneDetector::cells;
  /// Approximate master_from_slave, within 5 deg and 0.15 m; empty: planes are matched by their
  /// angles.
  std::optional<RigidTransform> initial;
  std::vector<Eigen::Vector3d> check_plane_centroids_m;  ///< master frame; held out of the solution
  std::uint64_t seed = 1;
};

/// Registers two scans by the planes that both see and nothing else: what a target has to beat.
/// Two tilts and an offset of each pair, weighted with the covariances of the fits (see
/// solve_planes). Planes named as check planes take no part; with none named all take part, with a
/// warning. Without an initial transform the scanners' positions must be known or be the origins.
/// The same points in any order give the same bits. Refusals: no_match (no three planes fit),
/// ambiguous_target (two transforms fit about as well, e.g. a bare rectangular room), unobservable
/// (the normals do not span space).
Registration register_planes(const Cloud& master, const Cloud& slave,
                             const PlaneRegistrationOptions& options);

}  // namespace alea
