#include "experiments/die/twin_scenery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alea::experiments::die {
namespace {

using std::numbers::pi;

double between(RandomStream& stream, const std::array<double, 2>& bounds) {
  return std::lerp(bounds[0], bounds[1], stream.uniform());
}

// A square about `centre_m`, seen from both sides.
Patch square(const std::string& name, const Eigen::Vector3d& centre_m,
             const Eigen::Vector3d& normal, double side_m, PatchRole role) {
  const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(normal);
  Patch patch;
  patch.id = name;
  patch.side_u_m = side_m * tangent.col(0);
  patch.side_v_m = side_m * tangent.col(1);
  patch.corner_m = centre_m - 0.5 * (patch.side_u_m + patch.side_v_m);
  patch.role = role;
  return patch;
}

double largest_incidence_rad(const Twin& twin, const Eigen::Vector3d& centre_m,
                             const Eigen::Vector3d& normal) {
  double least_cosine = 1;
  for (const RigidTransform& scan : twin.scene_from_scan)
    least_cosine =
        std::min(least_cosine, std::abs(normal.dot((scan.translation - centre_m).normalized())));
  // Both stations must see the same side.
  const double sides = normal.dot(twin.scene_from_scan[0].translation - centre_m) *
                       normal.dot(twin.scene_from_scan[1].translation - centre_m);
  return sides > 0 ? std::acos(least_cosine) : pi;
}

// A horizontal normal that both stations see well, within `half_range_rad` of `heading_rad`; after
// 200 draws the best one.
Eigen::Vector3d wall_normal(const Twin& twin, const Eigen::Vector3d& centre_m, double heading_rad,
                            double half_range_rad, double max_incidence_rad, RandomStream& stream) {
  Eigen::Vector3d best = Eigen::Vector3d::UnitX();
  double least = 10;
  for (int i = 0; i < 200 && least > max_incidence_rad; ++i) {
    const double heading = heading_rad + half_range_rad * (2 * stream.uniform() - 1);
    const Eigen::Vector3d normal(std::cos(heading), std::sin(heading), 0);
    const double incidence = largest_incidence_rad(twin, centre_m, normal);
    if (incidence < least) {
      least = incidence;
      best = normal;
    }
  }
  return best;
}

// The point at these distances from the die's centre and from the master, at height z: two circles
// meet on either side of the line master-die. Where the printed distances cannot meet, the point
// lies on that line at the distance from the die.
Eigen::Vector3d place_by_distances(const Twin& twin, double die_m, double station_m, double z,
                                   bool left) {
  const Eigen::Vector3d master = twin.scene_from_scan[0].translation;
  const auto on_floor = [](double slant, double rise) {
    return std::sqrt(std::max(0.0, slant * slant - rise * rise));
  };
  const double a = on_floor(die_m, z - twin.true_edge_m / 2),
               b = on_floor(station_m, z - master.z());
  const double c = master.head<2>().norm();
  const double cosine = a > 0 ? std::clamp((a * a + c * c - b * b) / (2 * a * c), -1.0, 1.0) : 1.0;
  const double angle = std::atan2(master.y(), master.x()) + (left ? 1 : -1) * std::acos(cosine);
  return {a * std::cos(angle), a * std::sin(angle), z};
}

TwinPlane make_plane(const Twin& twin, const TwinPrior& prior, RandomStream& stream,
                     const std::string& name, bool check, const Eigen::Vector3d& centre_m,
                     const Eigen::Vector3d& normal) {
  TwinPlane plane;
  plane.name = name;
  plane.check = check;
  plane.vertical = std::abs(normal.z()) < 0.5;
  plane.patch = square(name, centre_m, normal, between(stream, prior.patch_side_m),
                       check ? PatchRole::check : PatchRole::calibration);
  plane.noise_scale = between(stream, prior.noise_scale);
  plane.along_edge = std::abs(normal.dot(twin.edge_direction));
  return plane;
}

void place_check_planes(const PublishedTables& tables, const TwinPrior& prior, RandomStream& stream,
                        Twin& twin) {
  double die_m = 2, station_m = 5;
  for (const PublishedCheckPlane& row : tables.check_planes) {
    if (row.dataset != twin.dataset) continue;
    double scale = 1;
    if (row.distance_die_m) {
      die_m = *row.distance_die_m;
      station_m = *row.distance_station1_m;
    } else {
      scale = between(stream, prior.unprinted_distance);
    }
    const double z = row.vertical ? between(stream, prior.wall_height_m) : 0;
    const Eigen::Vector3d centre =
        place_by_distances(twin, scale * die_m, scale * station_m, z, stream.uniform() < 0.5);
    const Eigen::Vector3d normal =
        row.vertical ? wall_normal(twin, centre, 0, pi, prior.max_incidence_rad, stream)
                     : Eigen::Vector3d::UnitZ();
    twin.planes.push_back(make_plane(twin, prior, stream, row.plane, true, centre, normal));
  }
}

// The first wall stands across the shared edge, within 30 deg, so that the length can be seen.
void place_calibration_planes(const TwinPrior& prior, RandomStream& stream, Twin& twin) {
  const double edge_heading = std::atan2(twin.edge_direction.y(), twin.edge_direction.x());
  for (int i = 0; i < 4; ++i) {
    const bool wall = i < 3;
    const double direction = 2 * pi * stream.uniform(), distance = 1.5 + 2.5 * stream.uniform();
    const Eigen::Vector3d centre(distance * std::cos(direction), distance * std::sin(direction),
                                 wall ? between(stream, prior.wall_height_m) : 0);
    const Eigen::Vector3d normal =
        wall ? wall_normal(twin, centre, edge_heading, i == 0 ? pi / 6 : pi,
                           prior.max_incidence_rad, stream)
             : Eigen::Vector3d::UnitZ();
    twin.planes.push_back(make_plane(twin, prior, stream, fmt::format("calibration {}", i + 1),
                                     false, centre, normal));
  }
}

void place_spheres(const TwinPrior& prior, RandomStream& stream, Twin& twin) {
  const double start = 2 * pi * stream.uniform();
  for (int i = 0; i < 6; ++i) {
    const double direction = start + (i + 0.4 * (stream.uniform() - 0.5)) * pi / 3;
    Sphere sphere;
    sphere.id = fmt::format("sphere {}", i + 1);
    sphere.centre_m = {prior.sphere_ring_m * std::cos(direction),
                       prior.sphere_ring_m * std::sin(direction), 0.3 + 1.5 * stream.uniform()};
    twin.spheres.push_back(sphere);
  }
}

}  // namespace

void place_scenery(const PublishedTables& tables, const TwinPrior& prior, RandomStream& stream,
                   Twin& twin) {
  place_check_planes(tables, prior, stream, twin);
  place_calibration_planes(prior, stream, twin);
  place_spheres(prior, stream, twin);
}

}  // namespace alea::experiments::die
