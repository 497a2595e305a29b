#include "alea/die/adjustment.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "alea/core/error.hpp"
#include "alea/die/adjustment_model.hpp"
#include "alea/die/facet_adjustment.hpp"
#include "alea/die/facet_test.hpp"
#include "alea/die/observability.hpp"
#include "alea/die/plane_match.hpp"
#include "alea/transform/reference_point.hpp"

namespace alea {
namespace {

constexpr int max_iterations = 30;
constexpr double settled = 1e-4;         // step over the standard deviation, all else being known
constexpr double doubtful_level = 1e-3;  // of the global test

bool all_exact(const std::vector<AdjustmentScan>& scans) {
  std::size_t exact = 0, all = 0;
  for (const AdjustmentScan& scan : scans)
    for (const ObservedFacet& facet : scan.die.facets) {
      ++all;
      exact += facet.fit.covariance.isZero(0) ? 1 : 0;
    }
  if (exact > 0 && exact < all)
    throw usage_error("die adjustment: some facets have a covariance of zero, others have not");
  return exact > 0;
}

AdjustmentProblem near_problem(const std::vector<AdjustmentScan>& scans,
                               const AdjustmentOptions& options,
                               const std::vector<Eigen::Vector3d>& origins) {
  AdjustmentProblem problem;
  for (std::size_t s = 0; s < scans.size(); ++s) {
    AdjustmentScan near{recentred(scans[s].die, origins[s]), scans[s].planes};
    for (ScenePlane& plane : near.planes) plane.fit = recentred(plane.fit, origins[s]);
    problem.scans.push_back(std::move(near));
  }
  problem.shape = options.shape;
  problem.edges = options.edges;
  problem.level_sd_rad = options.level_sd_rad;
  problem.without_noise = all_exact(scans);
  return problem;
}

struct Solved {
  AdjustmentState state;
  LinearisedAdjustment linearised;  ///< at the state
  NormalSolution solution;
  int iterations = 0;
  bool converged = false;
};

Solved solve(const AdjustmentProblem& problem, const AdjustmentLayout& layout) {
  Solved out;
  out.state = starting_state(problem);
  for (; out.iterations < max_iterations; ++out.iterations) {
    out.linearised = linearise(problem, layout, out.state);
    out.solution = solve_normal(normal_system(out.linearised, layout.size));
    const double step = out.solution.correction.cwiseQuotient(out.solution.unit).norm();
    if (!std::isfinite(step)) break;
    out.converged = step < settled;
    if (out.converged) break;
    out.state = corrected(out.state, layout, out.solution.correction);
  }
  return out;
}

/// Departures about the adjusted facets by those about the nominal ones.
Eigen::Matrix3d rebased(const DepartedFacet& facet) {
  const Eigen::Vector3d foot = facet.fit.plane.offset_m * facet.fit.plane.normal;
  Eigen::Matrix3d at_foot = Eigen::Matrix3d::Identity();
  at_foot.block<1, 2>(2, 0) = -(foot - facet.fit.centroid_m).transpose() * facet.fit.tangent;
  return at_foot * facet.by_departure;
}

/// Covariance of the departures about the adjusted shape, with the die's motions and all that is
/// open projected out.
ShapeMatrix inner_covariance(const std::array<DepartedFacet, 6>& facets,
                             const AdjustmentLayout& layout, const Solved& solved) {
  std::vector<int> departures;
  ShapePrior adjusted;
  Eigen::MatrixXd by_unknowns = Eigen::MatrixXd::Zero(18, layout.size);
  for (int f = 0; f < 6; ++f) {
    adjusted.nominal[f] = facets[f].fit.plane;
    if (layout.facet[f] < 0) continue;
    for (int k = 0; k < 3; ++k) departures.push_back(3 * f + k);
    by_unknowns.block<3, 3>(3 * f, layout.facet[f]) = rebased(facets[f]);
  }
  ShapeMatrix out = ShapeMatrix::Zero();
  if (departures.empty()) return out;
  const Eigen::MatrixXd rows = by_unknowns(departures, Eigen::all);
  const Eigen::MatrixXd motions = rigid_departures(adjusted)(departures, Eigen::all);
  const Eigen::MatrixXd open = rows * solved.solution.open;
  Eigen::MatrixXd away(motions.rows(), motions.cols() + open.cols());
  away << motions, open;
  for (Eigen::Index k = 0; k < away.cols(); ++k)
    if (away.col(k).norm() > 0) away.col(k).normalize();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(away);
  const Eigen::MatrixXd q = qr.householderQ();
  const Eigen::MatrixXd kept = q.rightCols(away.rows() - qr.rank());
  const Eigen::MatrixXd keep = kept * kept.transpose() * rows;
  const Eigen::MatrixXd inner = keep * solved.solution.covariance * keep.transpose();
  out(departures, departures) = (inner + inner.transpose()) / 2;
  return out;
}

void add_shape(const AdjustmentProblem& problem, const AdjustmentLayout& layout,
               const Solved& solved, DieAdjustment& out) {
  const auto facets = departed_facets(problem.shape, solved.state.departure);
  for (int f = 0; f < 6; ++f)
    if (layout.facet[f] >= 0 || problem.shape.exact[f]) out.shape.facets[f] = facets[f].fit.plane;
  out.shape_covariance = out.covariance_factor * inner_covariance(facets, layout, solved);
  for (int axis = 0; axis < 3; ++axis)
    out.length_determined[axis] = out.shape.facet(axis + 1) &&
                                  out.shape.facet(opposite_pips(axis + 1)) &&
                                  is_determined(solved.solution, length_by_unknowns(layout, axis));
  const auto sd = [&](const Eigen::RowVectorXd& row) {
    return std::sqrt(out.covariance_factor *
                     (row * solved.solution.covariance * row.transpose())(0, 0));
  };
  for (int first = 1; first <= 5; ++first)
    for (int second = first + 1; second <= 6; ++second) {
      const EdgeName name{first, second};
      if (second == opposite_pips(first) || !out.shape.facet(first) || !out.shape.facet(second))
        continue;
      AdjustedAngle angle{name, {}, {}};
      const Eigen::RowVectorXd by_angle = angle_by_unknowns(layout, facets, first, second);
      if (is_determined(solved.solution, by_angle)) {
        angle.angle_rad =
            std::acos(-out.shape.facet(first)->normal.dot(out.shape.facet(second)->normal));
        angle.sd_rad = sd(by_angle);
      }
      out.angles.push_back(angle);
      if (!edge_length_m(out.shape, first, second)) continue;
      const EdgeByShape edge = edge_of(facets, name);
      Eigen::RowVectorXd by_edge = Eigen::RowVectorXd::Zero(layout.size);
      for (int f = 0; f < 6; ++f)
        if (layout.facet[f] >= 0)
          by_edge.segment<3>(layout.facet[f]) = edge.by_departure.segment<3>(3 * f);
      AdjustedEdge adjusted{name, {}, {}};
      if (is_determined(solved.solution, by_edge)) {
        adjusted.length_m = edge.length_m;
        adjusted.sd_m = sd(by_edge);
      }
      out.edges.push_back(adjusted);
    }
}

/// The global test: squared misclosures over what they should be.
void add_tests(const AdjustmentProblem& problem, const AdjustmentOptions& options,
               const Solved& solved, DieAdjustment& out) {
  int observed = 0;
  for (const AdjustmentObservation& o : solved.linearised.observations) {
    observed += rank_of(o);
    out.chi_square += o.misclosure.dot(o.weight * o.misclosure);
  }
  out.freedom = observed - solved.solution.rank;
  if (problem.without_noise) {
    out.chi_square = 0;
    out.covariance_factor = 0;
    return;
  }
  out.p_value = chi_square_tail(out.chi_square, out.freedom);
  if (out.freedom > 0 && out.p_value < doubtful_level)
    out.covariance_factor = out.chi_square / out.freedom;
  for (std::size_t s = 0; s < problem.scans.size(); ++s) {
    VarianceComponent points{"points", s, 0, 0};
    for (const ObservedFacet& facet : problem.scans[s].die.facets) {
      const double freedom = static_cast<double>(facet.fit.points) - 3;
      if (freedom <= 0) continue;
      points.factor += freedom * facet.fit.variance_factor;
      points.freedom += freedom;
    }
    if (points.freedom <= 0) continue;
    points.factor /= points.freedom;
    out.components.push_back(points);
  }
  const auto groups = variance_components(solved.linearised, solved.solution.covariance);
  out.components.insert(out.components.end(), groups.begin(), groups.end());
  out.tests = test_facets(solved.linearised, solved.solution.covariance, options.alarm_level);
}

void add_poses(const AdjustmentLayout& layout, const AdjustmentOptions& options,
               const Solved& solved, const std::vector<Eigen::Vector3d>& origins,
               DieAdjustment& out) {
  const Eigen::Vector3d about = options.covariance_about_m.value_or(reference_point(origins[0]));
  for (std::size_t s = 0; s < origins.size(); ++s) {
    const RigidTransform& near = solved.state.master_from_scan[s];
    AdjustedPose pose;
    pose.covariance.about_m = about;
    if (s > 0) {
      pose.master_from_scan.rotation = near.rotation;
      pose.master_from_scan.translation =
          origins[0] + near.translation - near.rotation * origins[s];
      const Eigen::MatrixXd block =
          solved.solution.covariance.block<6, 6>(layout.scan(s), layout.scan(s));
      pose.covariance = moved_to({out.covariance_factor * block, origins[0]}, about);
      for (int k = 0; k < 6; ++k) {
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(layout.size);
        row[layout.scan(s) + k] = 1;
        pose.determined = pose.determined && is_determined(solved.solution, row);
      }
    }
    out.poses.push_back(pose);
  }
  out.master_from_die = solved.state.master_from_die;
  out.master_from_die.translation += origins[0];
}

}  // namespace

Result<DieAdjustment> adjust_die(const std::vector<AdjustmentScan>& scans,
                                 const AdjustmentOptions& options) {
  if (scans.empty()) throw usage_error("die adjustment: no scans");
  std::vector<Eigen::Vector3d> origins;
  for (const AdjustmentScan& scan : scans) {
    if (auto refusal = check_pair(scans[0].die, scan.die, options.hand)) return *refusal;
    origins.push_back(approximate_centre(scan.die));
  }
  const AdjustmentProblem problem = near_problem(scans, options, origins);
  const AdjustmentLayout layout = layout_of(problem);
  const Solved solved = solve(problem, layout);
  if (!solved.converged)
    return Refusal{RefusalCode::no_convergence,
                   fmt::format("the die's adjustment did not settle in {} steps; are the facets "
                               "those of one die?",
                               max_iterations)};
  DieAdjustment out;
  out.iterations = solved.iterations;
  out.defect = static_cast<int>(solved.solution.open.cols());
  out.open = name_open_directions(problem, layout, solved.state, solved.solution);
  add_tests(problem, options, solved, out);
  add_poses(layout, options, solved, origins, out);
  add_shape(problem, layout, solved, out);
  return out;
}

}  // namespace alea
