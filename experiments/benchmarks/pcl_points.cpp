#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

// pcl_points FILE OUT: what PCL reads of a PCD or PLY file, for scripts/compare-readers. OUT gets a
// line with the number of points and the names of the fields, then the values as doubles, point by
// point; a packed colour is the integer that its bytes make.

namespace {

double value_of(const std::uint8_t* at, const pcl::PCLPointField& field) {
  const auto load = [&]<typename T>(T value) {
    std::memcpy(&value, at + field.offset, sizeof(T));
    return static_cast<double>(value);
  };
  if (field.name == "rgb" || field.name == "rgba") return load(std::uint32_t{});
  switch (field.datatype) {
    case pcl::PCLPointField::INT8:
      return load(std::int8_t{});
    case pcl::PCLPointField::UINT8:
      return load(std::uint8_t{});
    case pcl::PCLPointField::INT16:
      return load(std::int16_t{});
    case pcl::PCLPointField::UINT16:
      return load(std::uint16_t{});
    case pcl::PCLPointField::INT32:
      return load(std::int32_t{});
    case pcl::PCLPointField::UINT32:
      return load(std::uint32_t{});
    case pcl::PCLPointField::FLOAT64:
      return load(double{});
    default:
      return load(float{});
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: pcl_points FILE OUT\n");
    return 2;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const std::string path = argv[1];
  pcl::PCLPointCloud2 cloud;
  const int code = path.ends_with(".ply") ? pcl::io::loadPLYFile(path, cloud)
                                          : pcl::io::loadPCDFile(path, cloud);
  if (code < 0) return 3;
  std::vector<pcl::PCLPointField> fields;
  for (const pcl::PCLPointField& field : cloud.fields)
    if (field.name != "_") fields.push_back(field);
  std::ofstream out(argv[2], std::ios::binary);
  const std::size_t points = static_cast<std::size_t>(cloud.width) * cloud.height;
  out << points;
  for (const pcl::PCLPointField& field : fields) out << ' ' << field.name;
  out << '\n';
  for (std::size_t i = 0; i < points; ++i) {
    for (const pcl::PCLPointField& field : fields) {
      const double value = value_of(cloud.data.data() + i * cloud.point_step, field);
      out.write(reinterpret_cast<const char*>(&value), sizeof(value));
    }
  }
  return out.good() ? 0 : 1;
}
