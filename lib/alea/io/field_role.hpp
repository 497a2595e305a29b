#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "alea/core/cloud.hpp"

namespace alea {

/// What a column of a file means to a Cloud.
enum class FieldRole { x, y, z, intensity, red, green, blue, rgb, nx, ny, nz, row, column };

/// The role of a field by any of its common names, without regard to case and to a unit "[m]" or
/// "(m)" behind it; empty for an unknown one.
std::optional<FieldRole> role_of(std::string_view name);

/// The roles of the columns of a table. Of two names for one thing ("intensity" and "reflectance")
/// the first counts; a packed colour beside red, green and blue does not.
std::vector<std::optional<FieldRole>> roles_of(const std::vector<std::string>& names);

/// Throws Error(input) where a name that has a role occurs twice: `place` and the name.
void check_names(const std::string& place, const std::vector<std::string>& names);

/// Which arrays of a Cloud a set of fields fills. Colours and normals need all three components.
struct Channels {
  bool positions = false;
  bool intensity = false;
  bool normals = false;
  bool colours = false;
  bool grid = false;  ///< row and column
};
/// Needs x, y and z for `positions`.
Channels channels_of(const std::vector<std::string>& names);

/// Red, green and blue of a packed 0x00RRGGBB.
inline Colour unpacked_colour(std::uint32_t bits) {
  return {static_cast<std::uint16_t>((bits >> 16 & 255) * 257),
          static_cast<std::uint16_t>((bits >> 8 & 255) * 257),
          static_cast<std::uint16_t>((bits & 255) * 257)};
}

}  // namespace alea
