#include "alea/evaluate/fisher_normal.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "alea/evaluate/fisher_information.hpp"

namespace alea {
namespace {

using Rows6 = Eigen::Matrix<double, 3, 6>;

/// Where the parameters of one body stand.
struct BodyLayout {
  int place = 0;                              ///< first of six
  std::vector<std::array<int, 3>> deviation;  ///< tilt, tilt, offset of each facet; -1: fixed
  std::vector<bool> seen;
};

struct Layout {
  std::vector<BodyLayout> bodies;
  std::vector<int> spheres;
  int size = 0;
};

Layout layout_of(const FisherScene& scene) {
  Layout layout;
  layout.size = 6 * static_cast<int>(scene.stations.size());
  for (const FisherBody& body : scene.bodies) {
    BodyLayout place{layout.size, {}, {}};
    layout.size += 6;
    for (const FisherFacet& facet : body.facets) {
      bool seen = false;
      for (const FisherStation& station : scene.stations) seen = seen || faces(facet, station);
      const bool tilts = seen && body.tilt_sd_rad > 0, offset = seen && body.offset_sd_m > 0;
      std::array<int, 3> columns{-1, -1, -1};
      if (tilts) columns[0] = layout.size++;
      if (tilts) columns[1] = layout.size++;
      if (offset) columns[2] = layout.size++;
      place.deviation.push_back(columns);
      place.seen.push_back(seen);
    }
    layout.bodies.push_back(place);
  }
  for (const FisherSphere& sphere : scene.spheres) {
    layout.spheres.push_back(layout.size);
    layout.size += sphere.radius_known ? 3 : 4;
  }
  return layout;
}

Eigen::Vector3d mean_of_targets(const FisherScene& scene) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (const FisherBody& body : scene.bodies) {
    for (const FisherFacet& facet : body.facets) {
      sum += facet_centre(facet);
      ++count;
    }
  }
  for (const FisherSphere& sphere : scene.spheres) {
    sum += sphere.centre_m;
    ++count;
  }
  return sum / count;
}

/// Displacement along the normal of the points of a facet, in the units of facet_information, by a
/// rigid motion (rotation about `about`, translation).
Rows6 rigid_rows(const FisherFacet& facet, const Eigen::Vector3d& about) {
  const Eigen::Vector3d& n = facet.plane.normal;
  const auto basis = tangent_basis(n);
  Rows6 rows = Rows6::Zero();
  rows.row(0) << (facet_centre(facet) - about).cross(n).transpose(), n.transpose();
  rows.row(1).head<3>() = -basis.col(1);
  rows.row(2).head<3>() = basis.col(0);
  return rows;
}

/// The same as tilts about e1 and e2's directions and offset: normal + a e1 + b e2, shift c.
Rows6 rigid_as_deviation(const Rows6& rows) {
  Rows6 deviation;
  deviation << -rows.row(1), -rows.row(2), rows.row(0);
  return deviation;
}

/// A corner of three facets and its velocity for a unit of each parameter (columns).
struct Corner {
  Eigen::Vector3d position;
  Eigen::MatrixXd velocity;
};

Corner corner_of(const FisherBody& body, const BodyLayout& place, const std::array<int, 3>& facets,
                 int size) {
  Eigen::Matrix3d normals;
  Eigen::Vector3d offsets;
  for (int k = 0; k < 3; ++k) {
    normals.row(k) = body.facets.at(facets[k]).plane.normal.transpose();
    offsets[k] = body.facets[facets[k]].plane.offset_m;
  }
  const Eigen::PartialPivLU<Eigen::Matrix3d> solver(normals);
  const Eigen::Vector3d position = solver.solve(offsets);
  Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(3, size);
  for (int k = 0; k < 3; ++k) {
    const FisherFacet& facet = body.facets[facets[k]];
    const auto basis = tangent_basis(facet.plane.normal);
    const Eigen::Vector3d lever = position - facet_centre(facet);
    const auto& column = place.deviation[facets[k]];
    for (int t = 0; t < 2; ++t)
      if (column[t] >= 0) shift(k, column[t]) = -lever.dot(basis.col(t));
    if (column[2] >= 0) shift(k, column[2]) = 1;
  }
  return {position, solver.solve(shift)};
}

/// Derivative of an edge's length by all parameters. A known shape leaves a zero row.
Eigen::RowVectorXd edge_row(const FisherBody& body, const BodyLayout& place, const FisherEdge& edge,
                            int size) {
  const Corner from = corner_of(body, place, {edge.first, edge.second, edge.from}, size);
  const Corner to = corner_of(body, place, {edge.first, edge.second, edge.to}, size);
  return (to.position - from.position).normalized().transpose() * (to.velocity - from.velocity);
}

void add_facet(FisherNormal& system, const FisherScene& scene, const FisherBody& body,
               const BodyLayout& place, std::size_t index) {
  const FisherFacet& facet = body.facets[index];
  const Rows6 rigid = rigid_rows(facet, system.about_m);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, system.normal.cols());
  rows.middleCols<6>(place.place) = -rigid;
  const auto& column = place.deviation[index];
  if (column[0] >= 0) rows(1, column[0]) = rows(2, column[1]) = 1;
  if (column[2] >= 0) rows(0, column[2]) = -1;
  for (std::size_t s = 0; s < scene.stations.size(); ++s) {
    const int first = 6 * static_cast<int>(s);
    rows.middleCols<6>(first) = rigid;
    const FisherStation& station = scene.stations[s];
    system.normal += rows.transpose() *
                     facet_information(facet, station, station.noise.value_or(scene.noise)) * rows;
    rows.middleCols<6>(first).setZero();
  }
  const std::array<double, 3> sd{body.tilt_sd_rad, body.tilt_sd_rad, body.offset_sd_m};
  for (int k = 0; k < 3; ++k)
    if (column[k] >= 0 && std::isfinite(sd[k]))
      system.normal(column[k], column[k]) += 1 / (sd[k] * sd[k]);
}

/// Motions of the body's place that change none of its facets' components of limited freedom.
int redundant_motions(const FisherBody& body, const BodyLayout& place,
                      const Eigen::Vector3d& about) {
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t f = 0; f < body.facets.size(); ++f) {
    if (!place.seen[f]) continue;
    const Rows6 rows = rigid_as_deviation(rigid_rows(body.facets[f], about));
    if (std::isfinite(body.tilt_sd_rad)) gram += rows.topRows<2>().transpose() * rows.topRows<2>();
    if (std::isfinite(body.offset_sd_m)) gram += rows.row(2).transpose() * rows.row(2);
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6d> spectrum(gram, Eigen::EigenvaluesOnly);
  return static_cast<int>((spectrum.eigenvalues().array() < 1e-9).count());
}

void add_body(FisherNormal& system, const FisherScene& scene, const FisherBody& body,
              const BodyLayout& place) {
  for (std::size_t f = 0; f < body.facets.size(); ++f)
    if (place.seen[f]) add_facet(system, scene, body, place, f);
  system.redundant += redundant_motions(body, place, system.about_m);
  system.world.middleRows<6>(place.place).setIdentity();
  for (const FisherEdge& edge : body.edges) {
    const Eigen::RowVectorXd row =
        edge_row(body, place, edge, static_cast<int>(system.normal.cols()));
    if (row.isZero()) continue;
    if (edge.sd_m > 0) {
      system.normal += row.transpose() * row / (edge.sd_m * edge.sd_m);
    } else {
      system.constraints.conservativeResize(system.constraints.rows() + 1, row.size());
      system.constraints.bottomRows<1>() = row;
    }
  }
}

void add_sphere(FisherNormal& system, const FisherScene& scene, const FisherSphere& sphere,
                int first) {
  const Eigen::Matrix3d lever = -skew(sphere.centre_m - system.about_m);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(4, system.normal.cols());
  rows.block<3, 3>(0, first) = -Eigen::Matrix3d::Identity();
  if (!sphere.radius_known) rows(3, first + 3) = -1;
  system.world.block<3, 3>(first, 0) = lever;
  system.world.block<3, 3>(first, 3).setIdentity();
  for (std::size_t s = 0; s < scene.stations.size(); ++s) {
    auto station = rows.block<3, 6>(0, 6 * static_cast<int>(s));
    station << lever, Eigen::Matrix3d::Identity();
    const NoiseModel& noise = scene.stations[s].noise ? *scene.stations[s].noise : scene.noise;
    system.normal += rows.transpose() * sphere_information(sphere, scene.stations[s], noise) * rows;
    station.setZero();
  }
}

}  // namespace

FisherNormal fisher_normal(const FisherScene& scene) {
  const Layout layout = layout_of(scene);
  FisherNormal system;
  system.normal = Eigen::MatrixXd::Zero(layout.size, layout.size);
  system.constraints = Eigen::MatrixXd::Zero(0, layout.size);
  system.world = Eigen::MatrixXd::Zero(layout.size, 6);
  system.about_m = mean_of_targets(scene);
  for (std::size_t s = 0; s < scene.stations.size(); ++s) {
    const int first = 6 * static_cast<int>(s);
    system.world.middleRows<6>(first).setIdentity();
    const double level = scene.stations[s].level_sd_rad;
    for (int axis = 0; axis < 2; ++axis)
      system.normal(first + axis, first + axis) += 1 / (level * level);
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    add_body(system, scene, scene.bodies[b], layout.bodies[b]);
  for (std::size_t k = 0; k < scene.spheres.size(); ++k)
    add_sphere(system, scene, scene.spheres[k], layout.spheres[k]);
  return system;
}

}  // namespace alea
