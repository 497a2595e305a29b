#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace alea::command {

/// Centroids of the check planes: one x y z a line (master frame, m), # begins a comment line.
/// Throws Error(input) with file, line and expectation.
std::vector<Eigen::Vector3d> read_centroid_file(const std::string& path);

}  // namespace alea::command
