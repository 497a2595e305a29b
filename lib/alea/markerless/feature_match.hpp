#pragma once

#include <cstdint>
#include <vector>

#include "alea/markerless/fpfh.hpp"
#include "alea/markerless/pose_candidate.hpp"
#include "alea/markerless/prepared_scan.hpp"

namespace alea {

/// Feature a of one set is the nearest to feature b of the other.
struct FeatureMatch {
  std::uint32_t a = 0, b = 0;
  float ratio = 0;  ///< squared distance to the nearest over that to the second nearest
};

/// Mutually nearest features whose squared distance is at most `largest_ratio` times that of the
/// second nearest: Lowe 2004, doi 10.1023/B:VISI.0000029664.99615.94, and the mutual test. Sorted
/// by a.
std::vector<FeatureMatch> match_features(const std::vector<Fpfh>& a, const std::vector<Fpfh>& b,
                                         double largest_ratio);

struct FeatureMatchOptions {
  std::size_t draws = 20000;
  std::size_t candidates = 12;
  std::uint64_t seed = 1;
};

/// Poses that many feature matches agree with: triples of matches whose sides agree in length
/// (Fischler and Bolles 1981, doi 10.1145/358669.358692), each scored by the matches within two
/// coarse cells. Needs no idea of the vertical.
std::vector<PoseCandidate> feature_candidates(const PreparedScan& fixed, const PreparedScan& moving,
                                              const FeatureMatchOptions& options);

}  // namespace alea
