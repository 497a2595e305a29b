#include <fcntl.h>
#include <fmt/format.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "alea/core/seed.hpp"
#include "alea/io/cloud_file.hpp"

// reading_benchmark FOLDER [POINTS [ROUNDS]]: seconds to read a PLY, a PCD and an ascii file
// of POINTS points (x y z as floats, four decimals in text), for Alea, PCL and a plain read of the
// same bytes, interleaved, medians. Open3D: reading_open3d.py on the same files.

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

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void compare(const std::string& path, std::size_t points, int rounds) {
  const bool has_pcl = !path.ends_with(".xyz");
  const auto alea_read = [](const std::string& p) { return alea::read_cloud(p).size(); };
  std::vector<double> plain, ours, theirs;
  for (int i = 0; i < rounds; ++i) {
    plain.push_back(seconds(plain_read, path));
    ours.push_back(seconds(alea_read, path));
    if (has_pcl) theirs.push_back(seconds(pcl_read, path));
  }
  const double megapoints = static_cast<double>(points) / 1e6;
  fmt::print("{:<10} alea {:.3f} s ({:.1f} Mpts/s), {:.1f} times a plain read ({:.3f} s)",
             std::filesystem::path(path).filename().string(), median(ours),
             megapoints / median(ours), median(ours) / median(plain), median(plain));
  if (has_pcl)
    fmt::print("; PCL {:.3f} s: factor {:.1f}", median(theirs), median(theirs) / median(ours));
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: reading_benchmark FOLDER [POINTS [ROUNDS]]\n");
    return 2;
  }
  const std::string folder = argv[1];
  const std::size_t points = argc > 2 ? std::stoul(argv[2]) : 10000000;
  const int rounds = argc > 3 ? std::stoi(argv[3]) : 5;
  write_files(folder, points);
  for (const char* name : {"t.ply", "t.pcd", "ascii.pcd", "t.xyz"})
    compare(folder + "/" + name, points, rounds);
  return 0;
}
