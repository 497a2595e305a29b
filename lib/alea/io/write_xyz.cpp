#include <fmt/format.h>

#include <iterator>

#include "alea/io/atomic_file.hpp"
#include "alea/io/binary_output.hpp"
#include "alea/io/formats.hpp"

namespace alea {

void write_xyz(const std::string& path, const Cloud& cloud, char separator) {
  const bool as_bytes = fits_bytes(cloud.colours);
  std::string out = separator == ',' ? "x,y,z" : fmt::format("# x{0}y{0}z", separator);
  const auto declare = [&](std::initializer_list<const char*> names) {
    for (const char* name : names) out += fmt::format("{}{}", separator, name);
  };
  if (cloud.has_intensity()) declare({"intensity"});
  if (!cloud.colours.empty()) declare({"red", "green", "blue"});
  if (!cloud.normals.empty()) declare({"nx", "ny", "nz"});
  if (!cloud.rows.empty()) declare({"row", "column"});
  AtomicFile file(path);
  const auto add = [&](auto value) {
    fmt::format_to(std::back_inserter(out), "{}{}", separator, value);
  };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    // The shortest digits that read back to the same bits.
    fmt::format_to(std::back_inserter(out), "\n{}", cloud.positions[i].x());
    add(cloud.positions[i].y());
    add(cloud.positions[i].z());
    if (cloud.has_intensity()) add(cloud.intensity[i]);
    if (!cloud.colours.empty())
      for (const std::uint16_t value : cloud.colours[i]) add(as_bytes ? value / 257 : value);
    if (!cloud.normals.empty())
      for (const float value : cloud.normals[i]) add(value);
    if (!cloud.rows.empty()) {
      add(cloud.rows[i]);
      add(cloud.columns[i]);
    }
    if (out.size() < (1 << 20)) continue;
    file.write(out);
    out.clear();
  }
  out += '\n';
  file.write(out);
  file.commit();
}

}  // namespace alea
