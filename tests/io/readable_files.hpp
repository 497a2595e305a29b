#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "alea/io/atomic_file.hpp"
#include "tests/io/scans.hpp"
#include "tests/support/program.hpp"

namespace alea::testing {

/// The values of a scan with coordinates that need a double: 5e5 m and 5e6 m from the origin, to a
/// tenth of a millimetre. Colours have 8 bits.
inline Cloud far_cloud() {
  Cloud cloud = full_cloud(40, false);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.positions[i] = {500000 + static_cast<double>(i) / 1e4, 5000000.0001, -0.1234};
  return cloud;
}

/// Text lines of x y z intensity r g b nx ny nz, as many of them as asked for.
inline std::string text_rows(const Cloud& cloud, bool colours, bool normals) {
  std::string out;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    out += fmt::format("{} {} {} {}", cloud.positions[i].x(), cloud.positions[i].y(),
                       cloud.positions[i].z(), cloud.intensity[i]);
    for (const std::uint16_t value : cloud.colours[i])
      if (colours) out += fmt::format(" {}", value / 257);
    for (const float value : cloud.normals[i])
      if (normals) out += fmt::format(" {}", value);
    out += '\n';
  }
  return out;
}

template <typename T>
std::string bytes_of(T value, bool big_endian) {
  std::string out(sizeof(T), '\0');
  std::memcpy(out.data(), &value, sizeof(T));
  return big_endian ? std::string(out.rbegin(), out.rend()) : out;
}

inline std::string big_endian_ply(const Cloud& cloud) {
  std::string out = fmt::format(
      "ply\nformat binary_big_endian 1.0\nelement vertex {}\nproperty float intensity\n"
      "property double z\nproperty double y\nproperty double x\nend_header\n",
      cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    out += bytes_of(cloud.intensity[i], true);
    for (int axis = 2; axis >= 0; --axis) out += bytes_of(cloud.positions[i][axis], true);
  }
  return out;
}

inline std::string pcd_header(const Cloud& cloud, const char* data) {
  return fmt::format(
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z intensity\nSIZE 8 8 8 4\nTYPE F F F F\nCOUNT 1 1 1 "
      "1\n"
      "WIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA {}\n",
      cloud.size(), cloud.size(), data);
}

/// Field after field, in LZF blocks of literals.
inline std::string compressed_pcd(const Cloud& cloud) {
  std::string planes;
  for (int axis = 0; axis < 3; ++axis)
    for (const Eigen::Vector3d& p : cloud.positions) planes += bytes_of(p[axis], false);
  for (const float value : cloud.intensity) planes += bytes_of(value, false);
  std::string packed;
  for (std::size_t at = 0; at < planes.size(); at += 32) {
    const std::string block = planes.substr(at, 32);
    packed += static_cast<char>(block.size() - 1);
    packed += block;
  }
  return pcd_header(cloud, "binary_compressed") +
         bytes_of(static_cast<std::uint32_t>(packed.size()), false) +
         bytes_of(static_cast<std::uint32_t>(planes.size()), false) + packed;
}

/// LAS 1.2, point format 2, in steps of 0.1 mm about an offset.
inline std::string las_file(const Cloud& cloud) {
  std::string out(227 + 26 * cloud.size(), '\0');
  const auto put = [&](std::size_t at, auto value) {
    std::memcpy(&out[at], &value, sizeof(value));
  };
  out.replace(0, 4, "LASF");
  out[24] = 1;
  out[25] = 2;
  put(94, std::uint16_t{227});
  put(96, std::uint32_t{227});
  out[104] = 2;
  put(105, std::uint16_t{26});
  put(107, static_cast<std::uint32_t>(cloud.size()));
  for (std::size_t axis = 0; axis < 3; ++axis) put(131 + 8 * axis, 1e-4);
  put(155, 5e5);
  put(163, 5e6);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::size_t at = 227 + 26 * i;
    put(at, static_cast<std::int32_t>(i));
    put(at + 4, std::int32_t{1});
    put(at + 8, std::int32_t{-1234});
    put(at + 12, static_cast<std::uint16_t>(i * 1000));
    for (std::size_t k = 0; k < 3; ++k)
      put(at + 20 + 2 * k, static_cast<std::uint16_t>(cloud.colours[i][k] / 257));
  }
  return out;
}

/// far_cloud() in every format and encoding that is read; returns the files' names.
inline std::vector<std::string> write_readable_files(const TemporaryFolder& folder) {
  const Cloud cloud = far_cloud();
  std::vector<std::string> names;
  const auto add = [&](const std::string& name, const std::string& contents) {
    if (!contents.empty()) write_file_atomically(folder.file(name), contents);
    names.push_back(name);
  };
  for (const std::string name : {"binary.ply", "binary.pcd", "a.xyz", "a.csv", "a.ptx", "a.e57"}) {
    write_cloud(folder.file(name), cloud);
    add(name, "");
  }
  const std::string count = std::to_string(cloud.size());
  add("ascii.ply", "ply\nformat ascii 1.0\nelement vertex " + count +
                       "\nproperty double x\nproperty double y\nproperty double z\n"
                       "property float intensity\nproperty uchar red\nproperty uchar green\n"
                       "property uchar blue\nproperty float nx\nproperty float ny\n"
                       "property float nz\nend_header\n" +
                       text_rows(cloud, true, true));
  add("big_endian.ply", big_endian_ply(cloud));
  add("ascii.pcd", pcd_header(cloud, "ascii") + text_rows(cloud, false, false));
  add("compressed.pcd", compressed_pcd(cloud));
  add("a.pts", count + "\n" + text_rows(cloud, true, false));
  add("a.las", las_file(cloud));
  return names;
}

}  // namespace alea::testing
