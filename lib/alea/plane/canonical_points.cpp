#include "alea/plane/canonical_points.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "alea/plane/cell_grid.hpp"

namespace alea {
namespace {

// Far more than any scanner's reach in tolerances; keeps what follows free of overflow.
constexpr double farthest = 1e9;

struct Keyed {
  std::array<double, 3> cell;
  Eigen::Vector3d position;
  std::uint32_t index;
};

bool before(const Keyed& a, const Keyed& b) {
  return std::tie(a.cell, a.position.x(), a.position.y(), a.position.z()) <
         std::tie(b.cell, b.position.x(), b.position.y(), b.position.z());
}

}  // namespace

CanonicalPoints canonical_points(const Cloud& cloud, double tolerance_m) {
  CanonicalPoints out;
  out.per_unit = 6 / tolerance_m;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  for (const Eigen::Vector3d& p : cloud.positions)
    if (p.allFinite()) low = low.cwiseMin(p);
  std::vector<Keyed> keyed;
  keyed.reserve(cloud.size());
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = (cloud.positions[i] - low) * out.per_unit;
    if (!p.allFinite() || p.maxCoeff() > farthest) continue;
    const Eigen::Vector3d cell = (p / (64 * 6)).array().floor();
    keyed.push_back({{cell.x(), cell.y(), cell.z()}, p, i});
  }
  std::sort(keyed.begin(), keyed.end(), before);
  out.positions.reserve(keyed.size());
  out.index.reserve(keyed.size());
  for (const Keyed& k : keyed) {
    if (!out.positions.empty() && out.positions.back() == k.position) continue;
    out.positions.push_back(k.position);
    out.index.push_back(k.index);
  }
  return out;
}

double connection_length_m(const Cloud& cloud, const PlaneDetectionOptions& options,
                           double least_tolerances) {
  if (options.cell_m > 0) return options.cell_m;
  return make_cell_grid(cloud.positions, least_tolerances * options.tolerance_m, 12).cell;
}

}  // namespace alea
