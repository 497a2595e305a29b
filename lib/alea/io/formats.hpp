#pragma once

#include <string>
#include <vector>

#include "alea/io/input_file.hpp"
#include "alea/io/scan_file.hpp"

namespace alea {

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

}  // namespace alea
