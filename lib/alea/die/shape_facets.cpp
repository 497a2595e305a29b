#include <Eigen/Geometry>

#include "alea/core/error.hpp"
#include "alea/die/assembly.hpp"
#include "alea/die/facet_adjustment.hpp"
#include "alea/die/ideal_observation.hpp"
#include "alea/die/plane_match.hpp"
#include "alea/transform/horn.hpp"

namespace alea {
namespace {

constexpr int steps = 3;  // each squares the error of the start, which is that of the fits

/// The facets of the shape as fits about the die's middle, in the order of pips.
std::array<PlaneFit, 6> shape_fits(const UncertainShape& shape, const ObservedDie& master,
                                   const ObservedDie& slave) {
  const double tilt = shape.tilt_sd_rad * shape.tilt_sd_rad;
  const Eigen::Vector3d variances(tilt, tilt, shape.offset_sd_m * shape.offset_sd_m);
  std::array<PlaneFit, 6> fits;
  for (const ObservedDie* die : {&master, &slave})
    for (const ObservedFacet& facet : die->facets) {
      const auto& plane = shape.shape.facet(facet.pips);
      if (!plane) throw usage_error("closed form: the given shape lacks a facet that a scan sees");
      fits[facet.pips - 1] =
          exact_fit(*plane, Eigen::Vector3d::Zero(), Eigen::Matrix3d(variances.asDiagonal()));
    }
  return fits;
}

/// From the three normals and the corner; exact without noise.
RigidTransform start(const ObservedDie& die, const std::array<PlaneFit, 6>& shape) {
  std::array<Eigen::Vector3d, 3> seen, known;
  std::array<Plane, 3> planes;
  for (int k = 0; k < 3; ++k) {
    planes[k] = shape[die.facets[k].pips - 1].plane;
    seen[k] = die.facets[k].fit.plane.normal;
    known[k] = planes[k].normal;
  }
  const auto seen_corner = assemble_corner(planes_of(die)), known_corner = assemble_corner(planes);
  if (!seen_corner || !known_corner)
    throw usage_error("closed form: three facets have no common corner");
  RigidTransform scan_from_die = horn(seen, known);
  scan_from_die.translation =
      seen_corner->corner_m - scan_from_die.rotation * known_corner->corner_m;
  return scan_from_die;
}

struct BothScans {
  const ObservedDie& master;
  const ObservedDie& slave;
  std::array<PlaneFit, 6> shape;
};

/// Unknowns: scan_from_die of the master, then of the slave, six each.
Misclosures misclosures_at(const BothScans& scans,
                           const std::array<RigidTransform, 2>& scan_from_die) {
  Misclosures m{Eigen::VectorXd::Zero(18), Eigen::MatrixXd::Zero(18, 12),
                Eigen::MatrixXd::Zero(18, 18)};
  Eigen::MatrixXd by_shape = Eigen::MatrixXd::Zero(18, 18);
  Eigen::MatrixXd shape_covariance = Eigen::MatrixXd::Zero(18, 18);
  for (int facet = 0; facet < 6; ++facet)
    shape_covariance.block<3, 3>(3 * facet, 3 * facet) = scans.shape[facet].covariance;
  for (int scan = 0; scan < 2; ++scan) {
    const ObservedDie& die = scan == 0 ? scans.master : scans.slave;
    for (int k = 0; k < 3; ++k) {
      const int row = 9 * scan + 3 * k, facet = die.facets[k].pips - 1;
      const PlaneMatch match =
          match_planes(die.facets[k].fit, scans.shape[facet], scan_from_die[scan]);
      m.value.segment<3>(row) = match.residual;
      m.by_unknowns.block<3, 6>(row, 6 * scan) = match.by_transform;
      m.covariance.block<3, 3>(row, row) = die.facets[k].fit.covariance;
      by_shape.block<3, 3>(row, 3 * facet) = match.by_source;
    }
  }
  m.covariance += by_shape * shape_covariance * by_shape.transpose();
  return m;
}

/// How a left perturbation of slave_from_die shows as one of master_from_slave, sign aside.
Matrix6d adjoint(const RigidTransform& t) {
  Matrix6d out = Matrix6d::Zero();
  out.topLeftCorner<3, 3>() = t.rotation;
  out.bottomRightCorner<3, 3>() = t.rotation;
  for (int k = 0; k < 3; ++k) out.block<3, 1>(3, k) = t.translation.cross(t.rotation.col(k));
  return out;
}

}  // namespace

FacetAdjustment adjust_to_shape(const ObservedDie& master, const ObservedDie& slave,
                                const UncertainShape& shape) {
  const BothScans scans{master, slave, shape_fits(shape, master, slave)};
  std::array<RigidTransform, 2> scan_from_die{start(master, scans.shape),
                                              start(slave, scans.shape)};
  LeastSquares solution;
  for (int step = 0; step < steps; ++step) {
    solution = solve_misclosures(misclosures_at(scans, scan_from_die));
    for (int scan = 0; scan < 2; ++scan)
      scan_from_die[scan] = perturb_left(
          scan_from_die[scan], solution.correction.segment<6>(6 * scan), Eigen::Vector3d::Zero());
  }
  FacetAdjustment result;
  result.master_from_slave = scan_from_die[0] * scan_from_die[1].inverse();
  Eigen::Matrix<double, 6, 12> by_both;
  by_both << Matrix6d::Identity(), -adjoint(result.master_from_slave);
  result.covariance = by_both * solution.covariance * by_both.transpose();
  result.chi_square = solution.chi_square;
  result.freedom = 6;
  return result;
}

}  // namespace alea
