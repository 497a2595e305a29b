#include "experiments/die/twin_estimate.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "alea/die/closed_form.hpp"
#include "alea/die/paper_registration.hpp"
#include "alea/transform/horn.hpp"

namespace alea::experiments::die {
namespace {

std::optional<LengthFamily> edge_family(const Twin& twin, const std::array<ObservedDie, 2>& dice) {
  ClosedFormOptions options;
  options.edge_m = twin.nominal_edge_m;
  options.hand = HandRule::any;
  const Result<DieRegistration> result = register_closed_form(dice[0], dice[1], options);
  if (!result) return std::nullopt;
  return LengthFamily{result->master_from_slave, result->translation_by_edge};
}

// Turns a plane about its centroid so that the normal leans towards the scanner at the origin.
void lean_to_scanner(PlaneFit& fit, double angle_rad) {
  const Eigen::Vector3d sight = -fit.centroid_m.normalized();
  const Eigen::Vector3d normal = fit.plane.normal;
  const Eigen::Vector3d across = sight - normal * normal.dot(sight);
  if (across.norm() < 1e-9) return;
  const Eigen::Vector3d leaning =
      (std::cos(angle_rad) * normal + std::sin(angle_rad) * across.normalized()).normalized();
  fit.plane = {leaning, leaning.dot(fit.centroid_m)};
}

}  // namespace

RigidTransform LengthFamily::at(const Eigen::VectorXd& change_m) const {
  return {nominal.rotation, nominal.translation + translation_by_length * change_m};
}

std::optional<LengthFamily> closed_form_family(const Twin& twin, const TwinObservation& observed) {
  return edge_family(twin, observed.along_ray);
}

std::optional<LengthFamily> paper_family(const Twin& twin, const TwinObservation& observed,
                                         FrameRule rule) {
  PaperRegistrationOptions options;
  const double edge = twin.nominal_edge_m;
  options.dimensions = {edge, edge, edge, 0};
  options.rule = rule;
  options.up_pips = twin.top;
  options.hand = HandRule::any;
  const Result<PaperRegistration> result =
      register_paper(observed.orthogonal[0], observed.orthogonal[1], options);
  if (!result) return std::nullopt;
  return LengthFamily{result->master_from_slave,
                      result->translation_by_dimensions.leftCols<3>().rowwise().sum()};
}

std::optional<LengthFamily> biased_family(const Twin& twin, const TwinObservation& observed,
                                          double bias_rad) {
  std::array<ObservedDie, 2> dice = observed.along_ray;
  for (ObservedDie& die : dice)
    for (ObservedFacet& facet : die.facets)
      lean_to_scanner(facet.fit, facet.pips == twin.top ? bias_rad : 0.35 * bias_rad);
  std::optional<LengthFamily> family = edge_family(twin, dice);
  if (!family) return std::nullopt;
  family->translation_by_length.conservativeResize(3, 2);
  family->translation_by_length.col(1) = find_facet(dice[0], twin.top)->fit.plane.normal;
  return family;
}

std::optional<Eigen::VectorXd> calibrate(const LengthFamily& family, const Twin& twin,
                                         const TwinObservation& observed, CalibrationSet set) {
  const Eigen::Index unknowns = family.translation_by_length.cols();
  Eigen::VectorXd change = Eigen::VectorXd::Zero(unknowns);
  // The smallest eigenvalue of a union changes by 2 w (n . apart) (n . shift), n the normal of the
  // union: steps of Gauss and Newton end where the sum is stationary.
  for (int iteration = 0; iteration < 10; ++iteration) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    for (std::size_t k = 0; k < twin.planes.size(); ++k) {
      if (twin.planes[k].check != (set == CalibrationSet::check)) continue;
      const PlaneMoments& master = observed.planes[k].master;
      const PlaneMoments slave = moved(observed.planes[k].slave, family.at(change));
      const PlaneMoments both = joined(master, slave);
      const Eigen::Vector3d normal = fit_normal(both);
      const double weight = master.count * slave.count / (both.count * both.count);
      const Eigen::VectorXd row = family.translation_by_length.transpose() * normal;
      matrix += weight * row * row.transpose();
      right -= weight * row * normal.dot(slave.mean_m - master.mean_m);
    }
    const Eigen::LDLT<Eigen::MatrixXd> solver(matrix);
    if (!(solver.vectorD().minCoeff() > 1e-6)) return std::nullopt;
    const Eigen::VectorXd step = solver.solve(right);
    change += step;
    if (step.norm() < 1e-10) break;
  }
  return change;
}

std::optional<RigidTransform> sphere_registration(const TwinObservation& observed,
                                                  const std::vector<int>& which) {
  std::vector<Eigen::Vector3d> master, slave;
  for (const int k : which) {
    master.push_back(observed.centres_m[0].at(k));
    slave.push_back(observed.centres_m[1].at(k));
    if (!master.back().allFinite() || !slave.back().allFinite()) return std::nullopt;
  }
  return horn(master, slave);
}

}  // namespace alea::experiments::die
