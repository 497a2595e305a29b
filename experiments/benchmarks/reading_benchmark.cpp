#include <fcntl.h>
#include <fmt/format.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "alea/core/seed.hpp"
#include "alea/io/cloud_file.hpp"

// The C++ half of reading_benchmark.py: it writes a PLY and a PCD file, binary and ascii, and an
// XYZ file (x y z as floats, four decimals in text), and reads them for Alea, PCL and a plain read
// of the same bytes.

namespace {

using Clock = std::chrono::steady_clock;

alea::Cloud random_cloud(std::size_t points) {
  alea::RandomStream random({1, 0, 0, 0, alea::Purpose::test});
  alea::Cloud cloud;
  cloud.positions.resize(points);
  for (Eigen::Vector3d& p : cloud.positions)
    for (double& value : p) value = std::round((random.uniform() * 100 - 50) * 1e4) / 1e4;
  return cloud;
}

void write_files(const std::string& folder, std::size_t points) {
  alea::Cloud cloud = random_cloud(points);
  std::string text;
  for (const Eigen::Vector3d& p : cloud.positions)
    fmt::format_to(std::back_inserter(text), "{:.4f} {:.4f} {:.4f}\n", p.x(), p.y(), p.z());
  const std::string header = fmt::format(
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {}\n"
      "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA ascii\n",
      points, points);
  std::ofstream(folder + "/t.xyz") << text;
  std::ofstream(folder + "/ascii.ply")
      << fmt::format(
             "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
             "property float z\nend_header\n",
             points)
      << text;
  std::ofstream(folder + "/ascii.pcd") << header << text;
  for (Eigen::Vector3d& p : cloud.positions) p = p.cast<float>().cast<double>();
  alea::write_cloud(folder + "/t.ply", cloud);
  alea::write_cloud(folder + "/t.pcd", cloud);
}

std::size_t plain_read(const std::string& path) {
  static std::vector<char> buffer(1 << 20);
  const int descriptor = ::open(path.c_str(), O_RDONLY);
  std::size_t bytes = 0;
  for (ssize_t got = 0; (got = ::read(descriptor, buffer.data(), buffer.size())) > 0;)
    bytes += static_cast<std::size_t>(got);
  ::close(descriptor);
  return bytes;
}

std::size_t pcl_read(const std::string& path) {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  if (path.ends_with(".pcd")) pcl::io::loadPCDFile(path, cloud);
  if (path.ends_with(".ply")) pcl::io::loadPLYFile(path, cloud);
  return cloud.size();
}

double seconds(const std::function<std::size_t(const std::string&)>& read,
               const std::string& path) {
  const auto start = Clock::now();
  if (read(path) == 0) std::exit(1);
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

// Writes the files (unless POINTS is 0: those of an earlier run), says so, and then answers each
// line "READER PATH" with the seconds that took.
int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: benchmark_reading FOLDER POINTS, driven by reading_benchmark.py\n");
    return 2;
  }
  const std::map<std::string, std::function<std::size_t(const std::string&)>> readers{
      {"plain", plain_read}, {"pcl", pcl_read}, {"alea", [](const std::string& path) {
                                                   return alea::read_cloud(path).size();
                                                 }}};
  if (const std::size_t points = std::stoul(argv[2]); points > 0) write_files(argv[1], points);
  fmt::print("ready\n");
  std::fflush(stdout);
  for (std::string reader, path; std::cin >> reader >> path;) {
    fmt::print("{:.6f}\n", seconds(readers.at(reader), path));
    std::fflush(stdout);
  }
  return 0;
}
