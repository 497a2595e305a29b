#include <fmt/format.h>

#include "alea/io/binary_output.hpp"
#include "alea/io/formats.hpp"

namespace alea {
namespace {

std::string header_of(const Cloud& cloud, bool as_float) {
  std::string names, sizes, types, counts;
  const auto declare = [&](char type, int size, std::initializer_list<const char*> fields) {
    for (const char* field : fields) {
      names += fmt::format(" {}", field);
      sizes += fmt::format(" {}", size);
      types += fmt::format(" {}", type);
      counts += " 1";
    }
  };
  declare('F', as_float ? 4 : 8, {"x", "y", "z"});
  if (cloud.has_intensity()) declare('F', 4, {"intensity"});
  if (!cloud.colours.empty()) declare('U', 4, {"rgb"});
  if (!cloud.normals.empty()) declare('F', 4, {"normal_x", "normal_y", "normal_z"});
  if (!cloud.rows.empty()) declare('I', 4, {"row", "column"});
  const Eigen::Vector3d at = cloud.scanner_position.value_or(Eigen::Vector3d::Zero());
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS{}\nSIZE{}\nTYPE{}\n"
      "COUNT{}\nWIDTH {}\nHEIGHT 1\nVIEWPOINT {} {} {} 1 0 0 0\nPOINTS {}\nDATA binary\n",
      names, sizes, types, counts, cloud.size(), at.x(), at.y(), at.z(), cloud.size());
}

}  // namespace

void write_pcd(const std::string& path, const Cloud& cloud) {
  const bool as_float = fits_float(cloud);
  write_records(path, header_of(cloud, as_float), cloud, {as_float, ColourLayout::packed});
}

}  // namespace alea
