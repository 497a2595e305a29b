#include <fmt/format.h>

#include "alea/io/binary_output.hpp"
#include "alea/io/formats.hpp"
#include "alea/io/ply_header.hpp"

namespace alea {

void write_ply(const std::string& path, const Cloud& cloud) {
  const bool as_float = fits_float(cloud);
  const bool as_bytes = fits_bytes(cloud.colours);
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  if (const auto& at = cloud.scanner_position)
    out += fmt::format("comment {} {} {} {}\n", ply_position_comment, at->x(), at->y(), at->z());
  out += fmt::format("element vertex {}\n", cloud.size());
  const auto declare = [&](const char* type, std::initializer_list<const char*> names) {
    for (const char* name : names) out += fmt::format("property {} {}\n", type, name);
  };
  declare(as_float ? "float" : "double", {"x", "y", "z"});
  if (cloud.has_intensity()) declare("float", {"intensity"});
  if (!cloud.colours.empty()) declare(as_bytes ? "uchar" : "ushort", {"red", "green", "blue"});
  if (!cloud.normals.empty()) declare("float", {"nx", "ny", "nz"});
  if (!cloud.rows.empty()) declare("int", {"row", "column"});
  out += "end_header\n";
  write_records(path, out, cloud, {as_float, as_bytes ? ColourLayout::bytes : ColourLayout::words});
}

}  // namespace alea
