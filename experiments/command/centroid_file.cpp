#include "experiments/command/centroid_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "alea/core/error.hpp"

namespace alea::command {

std::vector<Eigen::Vector3d> read_centroid_file(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw input_error(
        fmt::format("{}: cannot read; --check-planes needs a file of centroids", path));
  std::vector<Eigen::Vector3d> centroids;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
    std::istringstream words(line);
    Eigen::Vector3d c;
    std::string rest;
    if (!(words >> c.x() >> c.y() >> c.z()) || words >> rest || !c.allFinite())
      throw input_error(
          fmt::format("{}: line {}: '{}' is not a centroid; write x y z in metres, master frame",
                      path, number, line));
    centroids.push_back(c);
  }
  if (centroids.empty())
    throw input_error(fmt::format("{}: no centroid; write one x y z a line, in metres", path));
  return centroids;
}

}  // namespace alea::command
