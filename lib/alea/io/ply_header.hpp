#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "alea/io/record_columns.hpp"

namespace alea {

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::float32;
  std::optional<ScalarType> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
  bool has_list() const;
  /// Bytes of one record without lists.
  std::size_t record_size() const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::optional<Eigen::Vector3d> scanner_position;  ///< from our own comment line
  std::size_t body_offset = 0;
  std::size_t body_line = 1;
};

/// Parses a PLY header. Throws Error(input) with file, line and expectation.
PlyHeader parse_ply_header(const std::string& path, std::string_view bytes);

/// The comment that keeps where the scanner stood: "alea scanner_position_m X Y Z".
inline constexpr std::string_view ply_position_comment = "alea scanner_position_m";

}  // namespace alea
