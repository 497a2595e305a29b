#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "alea/io/record_columns.hpp"

namespace alea {

enum class PcdEncoding { ascii, binary, binary_compressed };

struct PcdField {
  std::string name;  ///< "_" for padding
  ScalarType type = ScalarType::float32;
  std::size_t count = 1;
};

struct PcdHeader {
  PcdEncoding encoding = PcdEncoding::ascii;
  std::vector<PcdField> fields;
  std::size_t points = 0;
  std::size_t image_columns = 0;  ///< WIDTH where the points are an image (HEIGHT above 1)
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  std::size_t body_offset = 0;
  std::size_t body_line = 1;
  /// Bytes of one point.
  std::size_t record_size() const;
};

/// Parses a PCD header. Throws Error(input) with file, line and expectation.
PcdHeader parse_pcd_header(const std::string& path, std::string_view bytes);

}  // namespace alea
