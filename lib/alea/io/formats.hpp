#pragma once

#include <string>
#include <vector>

#include "alea/io/input_file.hpp"
#include "alea/io/scan_file.hpp"

namespace alea {

/// Scans that one file may hold: each takes memory of its own, however few points it has.
inline constexpr std::size_t scan_limit = 10000;

/// Throws Error(input) where a file holds more than scan_limit scans.
void check_scan_count(const std::string& path, std::size_t scans);

// One reader and one writer for each format; cloud_file.hpp picks among them. All throw
// Error(input) with file, place and expectation.

/// PLY 1.0, ascii and binary of both byte orders (Turk 1994, The PLY polygon file format).
ScanFile read_ply(const InputFile& file, const ReadOptions& options);
void write_ply(const std::string& path, const Cloud& cloud);

/// PCD 0.5 to 0.7, ascii, binary and binary_compressed (Point Cloud Library, The PCD file format).
ScanFile read_pcd(const InputFile& file, const ReadOptions& options);
void write_pcd(const std::string& path, const Cloud& cloud);

/// Columns of numbers with or without a line of names.
ScanFile read_xyz(const InputFile& file, const ReadOptions& options);
/// Separator ' ' for xyz, txt and asc, ',' for csv; a csv starts with the names, the others with a
/// comment line.
void write_xyz(const std::string& path, const Cloud& cloud, char separator);

/// Leica PTS: a number of points, then as many lines of x y z [intensity] [red green blue]; blocks
/// of this kind may follow each other.
std::vector<ScanFile> read_pts(const InputFile& file, const ReadOptions& options);

/// Leica PTX: scans of columns times rows points in the scanner's frame, column by column, each
/// with its pose; a point at 0 0 0 is a missing return.
std::vector<ScanFile> read_ptx(const InputFile& file, const ReadOptions& options);
/// Keeps intensity (0.5 where there is none) and colours to 8 bits; a cloud whose rows and columns
/// do not make a grid becomes one column. 0 0 0, which the format keeps for missing returns, is
/// written as 1e-300 0 0.
void write_ptx(const std::string& path, const std::vector<ScanFile>& scans);
/// The eight lines of a PTX header that hold a pose: position, three axes, and the 4x4 for row
/// vectors.
std::string ptx_pose_lines(const Eigen::Matrix4d& pose);

/// E57 (ASTM E2807-11): every scan in its own frame with its pose. Not read: images, blobs, point
/// groups, intensity and colour flags.
std::vector<ScanFile> read_e57(const InputFile& file, const ReadOptions& options);
/// Points untouched, the pose beside them. Throws Error(input) for a pose that is not rigid, which
/// the format cannot hold.
void write_e57(const std::string& path, const std::vector<ScanFile>& scans);
/// The element `pose` of a scan: a unit quaternion and a translation. The pose must be rigid.
std::string e57_pose_xml(const Eigen::Matrix4d& pose);

/// LAS 1.0 to 1.4, point formats 0 to 10 (ASPRS, LAS specification 1.4 R15). All points are kept,
/// also those that are flagged as withheld; colours of which none exceeds 255 are taken as 8-bit.
ScanFile read_las(const InputFile& file, const ReadOptions& options);

}  // namespace alea
