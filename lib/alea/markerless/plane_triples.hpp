#pragma once

#include <vector>

#include "alea/markerless/pose_candidate.hpp"
#include "alea/markerless/prepared_scan.hpp"

namespace alea {

struct PlaneTripleOptions {
  std::size_t planes = 14;  ///< of each scan, the largest
  double least_volume =
      0.25;  ///< |det| of the three normals: triples nearer to a pencil are left out
  double angle_tolerance_rad = 0.035;
  double offset_tolerance_m = 0.25;
  std::size_t candidates = 12;
};

/// Poses that carry three planes of one scan onto three of the other. A triple must have the same
/// dihedral angles and the same hand in both scans; the hand is decided by the exact sign of the
/// determinant of the normals, which face the scanner. Scored by the planes that then agree,
/// each counted by its share of the points. He, Hirose 2012, Observation-driven 3D planes matching;
/// Dold, Brenner 2006, Registration of terrestrial laser scanning data using planar patches.
std::vector<PoseCandidate> plane_triple_candidates(const PreparedScan& fixed,
                                                   const PreparedScan& moving,
                                                   const PlaneTripleOptions& options);

}  // namespace alea
