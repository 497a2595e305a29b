#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "alea/core/cloud.hpp"

namespace alea {

/// How a file of points is to be read. The defaults keep everything.
struct ReadOptions {
  /// Metres in one unit of the file: 1 for metres, 0.001 for millimetres, 0.3048 for feet.
  double unit_m = 1;
  /// Names of a text file's columns, in order ("x", "y", "z", "intensity", "red", "green", "blue",
  /// "nx", "ny", "nz"; any other name is skipped). Empty: from the header, else by their number.
  std::vector<std::string> columns = {};
  /// Moves a single scan into the file's common frame; several scans read as one always are.
  bool apply_pose = false;
  /// Applies a pose that is not rigid as it stands instead of calling it bad input.
  bool accept_non_rigid_pose = false;
  /// Keeps every n-th of the points that are valid and inside `crop_m`.
  std::uint32_t keep_every = 1;
  /// Keeps the points inside this box (metres, the scan's own frame, border included).
  std::optional<Eigen::AlignedBox3d> crop_m = {};
};

/// One scan of a file, in the scan's own frame.
struct ScanFile {
  Cloud cloud;
  /// common_from_scan, 4x4 for column vectors, metres; empty where the file has none.
  std::optional<Eigen::Matrix4d> pose;
  std::string name;
  std::vector<std::string> fields;  ///< every field of the file, by the file's own names
};

}  // namespace alea
