#include "alea/io/binary_output.hpp"

#include <algorithm>

namespace alea {

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

}  // namespace alea
