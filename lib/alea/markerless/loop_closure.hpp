#pragma once

#include <vector>

#include "alea/markerless/pose_graph.hpp"

namespace alea {

/// Which edges of a network close with the others.
struct LoopClosure {
  std::vector<bool> accepted;                     ///< by edge
  std::vector<bool> in_tree;                      ///< by edge: of the spanning tree
  std::vector<RigidTransform> network_from_scan;  ///< along the tree, from station 0
  std::vector<bool> reached;                      ///< by station
};

/// The covariance of an edge with the floors of the options added.
Matrix6d grown_covariance(const PoseEdge& edge, const PoseGraphOptions& options);

/// Grows a spanning tree by the edges that close the most triangles, tests every other edge against
/// the path through the tree, and drops tree edges that every loop through them contradicts.
LoopClosure close_loops(std::size_t stations, const std::vector<PoseEdge>& edges,
                        const PoseGraphOptions& options);

}  // namespace alea
