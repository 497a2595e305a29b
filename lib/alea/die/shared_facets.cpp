#include <Eigen/Geometry>
#include <Eigen/LU>

#include "alea/core/error.hpp"
#include "alea/die/assembly.hpp"
#include "alea/die/facet_adjustment.hpp"
#include "alea/die/orthogonal_axes.hpp"
#include "alea/die/plane_match.hpp"

namespace alea {
namespace {

constexpr int shared_steps = 3;  // each squares the error of the start, which is that of the fits

/// A corner and its derivatives by a, b, c of its three planes in the order of the facets.
struct CornerByPlanes {
  Eigen::Vector3d point_m;
  Eigen::Matrix<double, 3, 9> by_planes;
};

CornerByPlanes corner_of(const ObservedDie& die) {
  const auto assembly = assemble_corner(planes_of(die));
  if (!assembly) throw usage_error("closed form: three facets have no common corner");
  CornerByPlanes corner;
  corner.point_m = assembly->corner_m;
  Eigen::Matrix3d normals;
  Eigen::Matrix<double, 3, 9> offsets = Eigen::Matrix<double, 3, 9>::Zero();
  for (int k = 0; k < 3; ++k) {
    const PlaneFit& fit = die.facets[k].fit;
    normals.row(k) = fit.plane.normal;
    const Eigen::Vector3d lever = corner.point_m - fit.centroid_m;
    offsets.block<1, 3>(k, 3 * k) << -lever.transpose() * fit.tangent, 1;
  }
  corner.by_planes = normals.inverse() * offsets;
  return corner;
}

int index_of(const ObservedDie& die, int pips) {
  return static_cast<int>(find_facet(die, pips) - die.facets.data());
}

/// Everything about a pair of scans that does not change from step to step.
struct Pair {
  const ObservedDie& master;
  const ObservedDie& slave;
  std::vector<int> shared;
  std::optional<EdgeLength> edge;
  CornerByPlanes master_corner, slave_corner;
  Eigen::Vector3d along;  ///< unit, master frame: from the master's corner to the slave's
};

Pair make_pair(const ObservedDie& master, const ObservedDie& slave,
               const std::optional<EdgeLength>& edge) {
  Pair pair{master,
            slave,
            shared_pips(master, slave),
            edge,
            corner_of(master),
            corner_of(slave),
            Eigen::Vector3d::Zero()};
  if (pair.shared.size() > 2) pair.edge.reset();
  if (pair.shared.size() < 2 || (pair.shared.size() == 2 && !edge))
    throw usage_error(
        "closed form: needs three shared facets, or two and the length of their edge");
  if (!pair.edge) return pair;
  const ObservedFacet* end = nullptr;  // the master's facet at which the edge ends
  for (const ObservedFacet& facet : master.facets)
    if (find_facet(slave, facet.pips) == nullptr) end = &facet;
  pair.along = find_facet(master, pair.shared[0])
                   ->fit.plane.normal.cross(find_facet(master, pair.shared[1])->fit.plane.normal)
                   .normalized();
  if (pair.along.dot(end->fit.plane.normal) > 0) pair.along = -pair.along;  // into the die
  return pair;
}

RigidTransform start(const Pair& pair) {
  const int first = pair.shared[0], second = pair.shared[1];
  RigidTransform t;
  t.rotation =
      edge_axes(pair.master, first, second) * edge_axes(pair.slave, first, second).transpose();
  const double length_m = pair.edge ? pair.edge->length_m : 0.0;
  t.translation =
      pair.master_corner.point_m + length_m * pair.along - t.rotation * pair.slave_corner.point_m;
  return t;
}

/// Rows: a, b, c of each shared facet, then the length. Columns of `by_planes`: the master's nine
/// plane parameters, then the slave's.
Misclosures misclosures_at(const Pair& pair, const RigidTransform& t) {
  const int shared = static_cast<int>(pair.shared.size()), rows = 3 * shared + (pair.edge ? 1 : 0);
  Misclosures m{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, 6), {}};
  Eigen::MatrixXd by_planes = Eigen::MatrixXd::Zero(rows, 18);
  for (int k = 0; k < shared; ++k) {
    const int in_master = index_of(pair.master, pair.shared[k]);
    const int in_slave = index_of(pair.slave, pair.shared[k]);
    const PlaneMatch match =
        match_planes(pair.master.facets[in_master].fit, pair.slave.facets[in_slave].fit, t);
    m.value.segment<3>(3 * k) = match.residual;
    m.by_unknowns.middleRows<3>(3 * k) = match.by_transform;
    by_planes.block<3, 3>(3 * k, 3 * in_master) = -Eigen::Matrix3d::Identity();
    by_planes.block<3, 3>(3 * k, 9 + 3 * in_slave) = match.by_source;
  }
  Eigen::MatrixXd sigma = Eigen::MatrixXd::Zero(18, 18);
  for (int k = 0; k < 3; ++k) {
    sigma.block<3, 3>(3 * k, 3 * k) = pair.master.facets[k].fit.covariance;
    sigma.block<3, 3>(9 + 3 * k, 9 + 3 * k) = pair.slave.facets[k].fit.covariance;
  }
  if (pair.edge) {
    const Eigen::Vector3d end = t * pair.slave_corner.point_m;
    const int row = rows - 1;
    m.value(row) = pair.along.dot(end - pair.master_corner.point_m) - pair.edge->length_m;
    m.by_unknowns.row(row) << end.cross(pair.along).transpose(), pair.along.transpose();
    by_planes.block<1, 9>(row, 0) = -pair.along.transpose() * pair.master_corner.by_planes;
    by_planes.block<1, 9>(row, 9) =
        pair.along.transpose() * t.rotation * pair.slave_corner.by_planes;
  }
  m.covariance = by_planes * sigma * by_planes.transpose();
  if (pair.edge) m.covariance(rows - 1, rows - 1) += pair.edge->sd_m * pair.edge->sd_m;
  return m;
}

}  // namespace

FacetAdjustment adjust_shared_facets(const ObservedDie& master, const ObservedDie& slave,
                                     const std::optional<EdgeLength>& edge) {
  const Pair pair = make_pair(master, slave, edge);
  FacetAdjustment result;
  result.master_from_slave = start(pair);
  result.translation_by_edge = pair.along;
  result.freedom = pair.edge ? 1 : 3;
  for (int step = 0; step < shared_steps; ++step) {
    const LeastSquares solution = solve_misclosures(misclosures_at(pair, result.master_from_slave));
    result.master_from_slave =
        perturb_left(result.master_from_slave, solution.correction, Eigen::Vector3d::Zero());
    result.covariance = solution.covariance;
    result.chi_square = solution.chi_square;
  }
  return result;
}

}  // namespace alea
