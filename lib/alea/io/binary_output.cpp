#include "alea/io/binary_output.hpp"

#include <algorithm>

#include "alea/io/atomic_file.hpp"

namespace alea {
namespace {

void append_colour(std::string& out, const Colour& colour, ColourLayout layout) {
  if (layout == ColourLayout::packed) {
    std::uint32_t packed = 0;
    for (const std::uint16_t value : colour) packed = packed << 8 | colour_byte(value);
    append_bytes(out, packed);
    return;
  }
  for (const std::uint16_t value : colour)
    layout == ColourLayout::bytes ? append_bytes(out, colour_byte(value))
                                  : append_bytes(out, value);
}

}  // namespace

bool fits_float(const Cloud& cloud) {
  return std::all_of(cloud.positions.begin(), cloud.positions.end(),
                     [](const Eigen::Vector3d& p) { return p.cast<float>().cast<double>() == p; });
}

bool fits_bytes(const std::vector<Colour>& colours) {
  return std::all_of(colours.begin(), colours.end(), [](const Colour& colour) {
    return std::all_of(colour.begin(), colour.end(),
                       [](std::uint16_t value) { return value % 257 == 0; });
  });
}

void write_records(const std::string& path, const std::string& header, const Cloud& cloud,
                   const RecordLayout& layout) {
  constexpr std::size_t block = std::size_t{1} << 20;
  AtomicFile file(path);
  std::string out = header;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (const double value : cloud.positions[i])
      layout.float_positions ? append_bytes(out, static_cast<float>(value))
                             : append_bytes(out, value);
    if (cloud.has_intensity()) append_bytes(out, cloud.intensity[i]);
    if (!cloud.colours.empty()) append_colour(out, cloud.colours[i], layout.colours);
    if (!cloud.normals.empty()) append_bytes(out, cloud.normals[i]);
    if (!cloud.rows.empty()) {
      append_bytes(out, cloud.rows[i]);
      append_bytes(out, cloud.columns[i]);
    }
    if (out.size() < block) continue;
    file.write(out);
    out.clear();
  }
  file.write(out);
  file.commit();
}

}  // namespace alea
