#pragma once

#include <optional>
#include <string>
#include <vector>

#include "alea/core/progress.hpp"
#include "alea/markerless/pose_graph.hpp"
#include "alea/pipeline/register_markerless.hpp"

namespace alea {

struct NetworkOptions {
  MarkerlessOptions pair;  ///< of each pair, method robust
  PoseGraphOptions graph;
  ProgressCallback progress;
};

/// What became of one pair of scans.
struct NetworkPair {
  std::size_t a = 0, b = 0;
  std::optional<Refusal> refusal;  ///< of the pair by itself
  std::optional<PoseEdge> edge;
  double overlap = 0;     ///< mean of both scans, at the pair's best pose
  bool accepted = false;  ///< closes with the others
};

struct NetworkRegistration {
  std::optional<Refusal> refusal;  ///< then there are no poses
  std::vector<RigidTransform> master_from_scan;
  std::vector<TransformCovariance> covariance;  ///< master frame; zero for the master
  std::vector<NetworkPair> pairs;               ///< every pair, by a, then b
  double chi_square = 0;
};

/// Any number of scans of the same place; the poses of all of them in the frame of the first. Every
/// pair is registered by itself, pairs that do not close in loops are rejected, the rest is
/// adjusted together. Refuses (no_match) where a scan has no accepted connection. Throws
/// Error(usage) for fewer than two scans or an empty one.
NetworkRegistration register_network(const std::vector<Cloud>& scans,
                                     const NetworkOptions& options);

}  // namespace alea
