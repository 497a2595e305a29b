#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace alea {

/// Red, green, blue with 16 bits each. An 8-bit value v is held as v * 257, so that both widths
/// survive a round trip.
using Colour = std::array<std::uint16_t, 3>;

/// Points that a reader met and did not keep.
struct DroppedPoints {
  std::size_t non_finite = 0;  ///< a coordinate is NaN or infinite
  std::size_t invalid = 0;     ///< the file itself marks the point as invalid
  std::size_t missing = 0;     ///< an empty return of a structured scan
};

/// One scan as parallel arrays. Every array but `positions` is either empty or as long as
/// `positions`. Coordinates are metres in the scan's own frame.
struct Cloud {
  std::vector<Eigen::Vector3d> positions;
  std::vector<float> intensity;  ///< as stored in the file; no unit
  std::vector<Eigen::Vector3f> normals;
  std::vector<Colour> colours;
  std::vector<std::int32_t> rows;     ///< of a structured scan
  std::vector<std::int32_t> columns;  ///< of a structured scan
  /// Where the scanner stood, in the frame of the points (metres); empty where nobody said.
  std::optional<Eigen::Vector3d> scanner_position;
  DroppedPoints dropped;

  std::size_t size() const { return positions.size(); }
  bool empty() const { return positions.empty(); }
  bool has_intensity() const { return !intensity.empty(); }
};

/// The points of `cloud` at `indices`, in that order, with every array that it has.
Cloud subset(const Cloud& cloud, const std::vector<std::uint32_t>& indices);

}  // namespace alea
