#include <Eigen/Geometry>

#include "alea/core/error.hpp"
#include "alea/die/assembly.hpp"
#include "alea/die/facet_adjustment.hpp"
#include "alea/die/ideal_observation.hpp"
#include "alea/die/plane_match.hpp"
#include "alea/transform/horn.hpp"

namespace alea {
namespace {

// Each step squares the error of the start where the shape is exact; against a prior the error
// falls by the size of the tilts.
constexpr int shape_steps = 6;
constexpr int poses = 12;   ///< unknowns of the two poses
constexpr int shapes = 18;  ///< unknowns of the shape, where it is uncertain

/// The facets of the shape as fits about the die's middle, in the order of pips.
std::array<PlaneFit, 6> nominal_fits(const DieShape& shape, const ObservedDie& master,
                                     const ObservedDie& slave) {
  std::array<PlaneFit, 6> fits;
  for (const ObservedDie* die : {&master, &slave})
    for (const ObservedFacet& facet : die->facets) {
      const auto& plane = shape.facet(facet.pips);
      if (!plane) throw usage_error("closed form: the given shape lacks a facet that a scan sees");
      fits[facet.pips - 1] = exact_fit(*plane, Eigen::Vector3d::Zero());
    }
  return fits;
}

/// A nominal facet after its tilts a, b (rad) and its offset c (m).
PlaneFit changed(const PlaneFit& nominal, const Eigen::Vector3d& abc) {
  PlaneFit fit = nominal;
  fit.plane.normal = (nominal.plane.normal + nominal.tangent * abc.head<2>()).normalized();
  fit.centroid_m += abc(2) * fit.plane.normal;
  fit.plane.offset_m = fit.plane.normal.dot(fit.centroid_m);
  fit.tangent -= fit.plane.normal * (fit.plane.normal.transpose() * nominal.tangent);
  return fit;
}

std::array<Plane, 6> planes_of(const std::array<PlaneFit, 6>& fits) {
  std::array<Plane, 6> planes;
  for (int f = 0; f < 6; ++f) planes[f] = fits[f].plane;
  return planes;
}

/// The state of the adjustment: both poses and the shape's departure from its nominal planes.
struct State {
  std::array<RigidTransform, 2> scan_from_die;
  Eigen::VectorXd shape = Eigen::VectorXd::Zero(shapes);  ///< a, b, c of each facet
};

struct Problem {
  std::array<const ObservedDie*, 2> scans;
  std::array<PlaneFit, 6> nominal;
  Eigen::VectorXd prior_variance;  ///< of State::shape; all zero: the shape is exact
  bool shape_exact() const { return prior_variance.isZero(0); }
};

/// Rows: a, b, c of the master's three facets, of the slave's, then the shape against its prior.
/// Unknowns: scan_from_die of the master and of the slave, six each, then the shape.
Misclosures misclosures_at(const Problem& problem, const State& state) {
  const int extra = problem.shape_exact() ? 0 : shapes, rows = 18 + extra;
  Misclosures m{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, poses + extra),
                Eigen::MatrixXd::Zero(rows, rows)};
  for (int scan = 0; scan < 2; ++scan)
    for (int k = 0; k < 3; ++k) {
      const ObservedFacet& seen = problem.scans[scan]->facets[k];
      const int row = 9 * scan + 3 * k, facet = seen.pips - 1;
      const PlaneFit known = changed(problem.nominal[facet], state.shape.segment<3>(3 * facet));
      const PlaneMatch match = match_planes(seen.fit, known, state.scan_from_die[scan]);
      m.value.segment<3>(row) = match.residual;
      m.by_unknowns.block<3, 6>(row, 6 * scan) = match.by_transform;
      if (extra > 0) m.by_unknowns.block<3, 3>(row, poses + 3 * facet) = match.by_source;
      m.covariance.block<3, 3>(row, row) = seen.fit.covariance;
    }
  if (extra > 0) {
    m.value.tail(shapes) = state.shape;
    m.by_unknowns.bottomRightCorner(shapes, shapes).setIdentity();
    m.covariance.bottomRightCorner(shapes, shapes) = problem.prior_variance.asDiagonal();
  }
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

RigidTransform place_shape(const ObservedDie& die, const std::array<Plane, 6>& shape) {
  std::array<Eigen::Vector3d, 3> seen, known;
  std::array<Plane, 3> planes;
  for (int k = 0; k < 3; ++k) {
    planes[k] = shape[die.facets[k].pips - 1];
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

FacetAdjustment adjust_to_shape(const ObservedDie& master, const ObservedDie& slave,
                                const UncertainShape& shape) {
  const Eigen::Vector3d sd(shape.tilt_sd_rad, shape.tilt_sd_rad, shape.offset_sd_m);
  const Problem problem{{&master, &slave},
                        nominal_fits(shape.shape, master, slave),
                        sd.cwiseAbs2().replicate<6, 1>()};
  State state;
  const std::array<Plane, 6> planes = planes_of(problem.nominal);
  state.scan_from_die = {place_shape(master, planes), place_shape(slave, planes)};
  LeastSquares solution;
  for (int step = 0; step < shape_steps; ++step) {
    solution = solve_misclosures(misclosures_at(problem, state));
    for (int scan = 0; scan < 2; ++scan)
      state.scan_from_die[scan] =
          perturb_left(state.scan_from_die[scan], solution.correction.segment<6>(6 * scan),
                       Eigen::Vector3d::Zero());
    if (!problem.shape_exact()) state.shape += solution.correction.tail(shapes);
  }
  FacetAdjustment result;
  result.master_from_slave = state.scan_from_die[0] * state.scan_from_die[1].inverse();
  Eigen::Matrix<double, 6, poses> by_both;
  by_both << Matrix6d::Identity(), -adjoint(result.master_from_slave);
  result.covariance =
      by_both * solution.covariance.topLeftCorner<poses, poses>() * by_both.transpose();
  result.chi_square = solution.chi_square;
  result.freedom = 6;
  return result;
}

}  // namespace alea
