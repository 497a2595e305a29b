#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "alea/io/e57_pages.hpp"

namespace alea {

/// How one field of an E57 point record is stored (ASTM E2807-11, 8.4.6 and 9).
struct E57Field {
  enum class Kind { float32, float64, integer, text };
  std::string name;
  Kind kind = Kind::float64;
  // value = (minimum + bits) * scale + offset for integers, bits wide enough for maximum - minimum.
  std::int64_t minimum = 0;
  std::int64_t maximum = 0;
  double scale = 1;
  double offset = 0;
  bool bounded = false;  ///< the file gives minimum and maximum
  double lowest = 0;     ///< the declared bounds as values, where bounded
  double highest = 0;
  /// Bits of one value in its bytestream; 0 where all values are the same.
  unsigned bits() const;
};

/// One scan (data3D entry) of an E57 file.
struct E57Scan {
  std::size_t number = 1;  ///< in the file, counted from one
  std::string name;
  std::optional<Eigen::Matrix4d> pose;  ///< file_from_scan
  std::uint64_t section_offset = 0;     ///< physical, of the compressed vector
  std::uint64_t records = 0;
  std::vector<E57Field> fields;
  /// Limits of the colours: value to full scale; empty where the file says nothing.
  std::optional<std::array<double, 2>> colour_limits;
};

/// The scans that the XML part describes. Throws Error(input) with file and the element that is
/// wrong.
std::vector<E57Scan> parse_e57_document(const E57Pages& pages);

/// Longest XML part that is read.
inline constexpr std::uint64_t e57_xml_limit = 16 << 20;
/// Memory for the tree of the XML part, beside twice the file's size.
inline constexpr std::uint64_t e57_markup_limit = 24 << 20;

}  // namespace alea
