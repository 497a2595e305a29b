#pragma once

#include <string>
#include <vector>

#include "alea/io/scan_file.hpp"

namespace alea {

/// Every scan of a file, each in its own frame: PLY, PCD, XYZ/TXT/CSV, PTS, PTX, E57, LAS. The
/// format is told by the contents, for text by the extension. `file.e57#2` is the second scan
/// alone. Non-finite, invalid and missing points are counted in Cloud::dropped and left out. Throws
/// Error(input) with file, place and expectation.
std::vector<ScanFile> read_scans(const std::string& path, const ReadOptions& options = {});

/// The scans as one cloud. One scan stays in its own frame unless options.apply_pose; several are
/// moved into the file's common frame. The scanner's position is kept where it is one.
/// Throws Error(input) for a pose that is applied and not rigid, unless the options accept it.
Cloud merged_scans(std::vector<ScanFile> scans, const ReadOptions& options = {});

/// read_scans, then merged_scans.
Cloud read_cloud(const std::string& path, const ReadOptions& options = {});

/// True where an upper left 3x3 block is a rotation to 1e-3 in every entry of R'R - I, of positive
/// determinant, and the last row is 0 0 0 1.
bool is_rigid(const Eigen::Matrix4d& pose);

/// Writes one cloud in the format of the extension (ply, pcd, xyz, txt, csv, asc, ptx, e57), whole
/// or not at all. Coordinates keep every bit: as float where that is exact, else as double. Throws
/// Error(input) where the file cannot be written or the format cannot hold a cloud.
void write_cloud(const std::string& path, const Cloud& cloud);

/// The same for several scans. E57 and PTX keep each scan in its own frame with its pose, unless
/// options.apply_pose moves them into the common one; the other formats have room for one cloud and
/// get merged_scans(scans, options).
void write_scans(const std::string& path, std::vector<ScanFile> scans,
                 const ReadOptions& options = {});

/// One line for each pose that is not rigid, starting with "pose_not_rigid".
std::vector<std::string> pose_warnings(const std::vector<ScanFile>& scans);

}  // namespace alea
