#include "alea/pipeline/die_orientations.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>

#include "alea/die/assembly.hpp"

namespace alea {
namespace {

using Key = std::array<int, 9>;

/// The rotation group of the cube works on these: columns are the outward normals, in a frame of
/// the die, of facets with the given pips.
Eigen::Matrix3i die_normals(const std::array<int, 3>& pips, Chirality hand) {
  const DieShape die = cube(1, hand);
  Eigen::Matrix3i normals;
  for (int k = 0; k < 3; ++k)
    normals.col(k) = die.facet(pips[k])->normal.array().round().matrix().cast<int>();
  return normals;
}

/// A corner as its scan shows it, facets in the order of the candidate.
struct SeenCorner {
  Eigen::Matrix3d normals;                             ///< columns
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< of the die, if it is a cube
};

SeenCorner seen_corner(const DieSighting& sighting) {
  SeenCorner out;
  std::array<Plane, 3> planes;
  for (int k = 0; k < 3; ++k) {
    planes[k] = find_facet(sighting.die, sighting.reading.pips[k])->fit.plane;
    out.normals.col(k) = planes[k].normal;
  }
  const double edge_m = (sighting.edges_m[0] + sighting.edges_m[1] + sighting.edges_m[2]) / 3;
  out.centre_m = assemble_corner(planes)->corner_m - edge_m / 2 * out.normals.rowwise().sum();
  return out;
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

RigidTransform rough_transform(const SeenCorner& master, const SeenCorner& slave, const Key& key) {
  const Eigen::Matrix3i between = Eigen::Map<const Eigen::Matrix3i>(key.data());
  RigidTransform out;
  out.rotation =
      nearest_rotation(master.normals * between.cast<double>() * slave.normals.transpose());
  out.translation = master.centre_m - out.rotation * slave.centre_m;
  return out;
}

/// A reading with the normals that it gives the facets.
struct PlacedReading {
  WeighedReading reading;
  Eigen::Matrix3i normals;
};

/// The readings of a sighting; one that was settled has itself only.
std::vector<PlacedReading> readings_of(const PipReading& reading) {
  std::vector<PlacedReading> out;
  for (const WeighedReading& each : reading.readings)
    out.push_back({each, die_normals(each.pips, each.hand)});
  if (out.empty())
    out.push_back({{reading.pips, reading.hand, 0}, die_normals(reading.pips, reading.hand)});
  return out;
}

}  // namespace

std::vector<DieOrientation> die_orientations(const DieSighting& master, const DieSighting& slave,
                                             bool levelled) {
  std::map<Key, DieOrientation> by_key;
  const std::vector<PlacedReading> of_slave = readings_of(slave.reading);
  for (const auto& [a, normals_a] : readings_of(master.reading))
    for (const auto& [b, normals_b] : of_slave) {
      if (a.hand != b.hand) continue;
      const Eigen::Matrix3i between = normals_a.transpose() * normals_b;
      Key key;
      Eigen::Map<Eigen::Matrix3i>(key.data()) = between;
      const double margin = a.margin + b.margin;
      const auto [known, is_new] = by_key.try_emplace(key);
      if (is_new || margin < known->second.margin)
        known->second = {a.pips, b.pips,      margin, std::max(a.needed_margin, b.needed_margin),
                         {},     std::nullopt};
    }
  const SeenCorner in_master = seen_corner(master), in_slave = seen_corner(slave);
  std::vector<DieOrientation> out;
  for (auto& [key, orientation] : by_key) {
    orientation.master_from_slave = rough_transform(in_master, in_slave, key);
    const double cosine = orientation.master_from_slave.rotation(2, 2);
    if (!levelled || cosine > std::cos(levelled_within_rad)) out.push_back(orientation);
  }
  std::stable_sort(out.begin(), out.end(), [](const DieOrientation& a, const DieOrientation& b) {
    return a.margin < b.margin;
  });
  return out;
}

std::size_t supported_orientations(const std::vector<DieOrientation>& orientations) {
  const auto last =
      std::find_if(orientations.rbegin(), orientations.rend(), [](const DieOrientation& each) {
        return each.margin <= 0 || each.margin < each.needed_margin;
      });
  return static_cast<std::size_t>(orientations.rend() - last);
}

DieSighting relabelled(const DieSighting& sighting, const std::array<int, 3>& pips) {
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return pips[a] < pips[b]; });
  const std::array<int, 3>& before = sighting.reading.pips;
  DieSighting out = sighting;
  for (int k = 0; k < 3; ++k) {
    const int from = order[k];
    const auto old = static_cast<std::size_t>(
        std::count_if(before.begin(), before.end(), [&](int each) { return each < before[from]; }));
    out.die.facets[k] = sighting.die.facets[old];
    out.die.facets[k].pips = pips[from];
    out.edges_m[k] = sighting.edges_m[old];
    out.edges_sd_m[k] = sighting.edges_sd_m[old];
    out.regions[k] = sighting.regions[old];
  }
  out.reading.pips = pips;
  out.reading.readings = {{pips, sighting.reading.hand, 0}};
  return out;
}

}  // namespace alea
