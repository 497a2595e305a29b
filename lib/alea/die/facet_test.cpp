#include "alea/die/facet_test.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>

namespace alea {
namespace {

/// A direction of a facet that the others check by less than this share of its own variance is not
/// tested: its residual would be the rounding of the rest.
constexpr double least_redundancy = 1e-6;
/// Facets whose statistics differ by less cannot be told apart: a log-likelihood of 6, or what the
/// linearisation leaves out at a gross error (2 deg of tilt: 3 % of the statistic).
constexpr double same_statistic = 12, same_share = 0.05;

FacetTest test_facet(const AdjustmentObservation& o, const Eigen::MatrixXd& covariance) {
  FacetTest test;
  test.scan = o.scan;
  (o.group == ObservationGroup::facets ? test.pips : test.plane) = o.label;
  test.residual = o.misclosure;
  // In units of the observation's own standard deviations its residuals have a covariance of one
  // less what the unknowns took: eigenvalues from 0 (nothing checks) to 1.
  const Eigen::Matrix3d root = o.weight.llt().matrixL().transpose();
  const Eigen::MatrixXd by = root * o.by_unknowns;
  const Eigen::Matrix3d redundancy = Eigen::Matrix3d::Identity() - by * covariance * by.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spectrum(redundancy);
  const Eigen::Vector3d misclosure = root * o.misclosure;
  for (int k = 0; k < 3; ++k) {
    if (spectrum.eigenvalues()[k] < least_redundancy) continue;
    ++test.freedom;
    test.statistic +=
        std::pow(spectrum.eigenvectors().col(k).dot(misclosure), 2) / spectrum.eigenvalues()[k];
  }
  test.p_value = test.freedom > 0 ? chi_square_tail(test.statistic, test.freedom) : 1;
  const Eigen::Matrix3d back = root.inverse();
  const Eigen::Vector3d variance = (back * redundancy * back.transpose()).diagonal();
  const Eigen::Vector3d own = (back * back.transpose()).diagonal();
  for (int k = 0; k < 3; ++k)
    if (variance[k] > least_redundancy * own[k])
      test.standardised[k] = o.misclosure[k] / std::sqrt(variance[k]);
  return test;
}

/// Of tests with the same freedom the larger statistic, else the less probable one. Probabilities
/// underflow, so their logarithm to leading order decides.
double strangeness(const FacetTest& test) {
  return test.statistic - (test.freedom - 2) * std::log(std::max(1.0, test.statistic / 2));
}

}  // namespace

double chi_square_tail(double statistic, double freedom) {
  if (!(freedom > 0)) return 1;
  return boost::math::gamma_q(freedom / 2, std::max(0.0, statistic) / 2);
}

std::vector<FacetTest> test_facets(const LinearisedAdjustment& linearised,
                                   const Eigen::MatrixXd& covariance, double alarm_level) {
  std::vector<FacetTest> tests;
  int tested = 0;
  double strangest = -std::numeric_limits<double>::infinity();
  for (const AdjustmentObservation& o : linearised.observations) {
    if (o.group != ObservationGroup::facets && o.group != ObservationGroup::planes) continue;
    tests.push_back(test_facet(o, covariance));
    if (tests.back().freedom == 0) continue;
    ++tested;
    strangest = std::max(strangest, strangeness(tests.back()));
  }
  std::stable_partition(tests.begin(), tests.end(), [](const auto& test) { return test.pips > 0; });
  // One facet that does not belong shows in its neighbours too: only the strangest is
  // suspect, and what is not clearly less strange.
  for (FacetTest& test : tests)
    test.suspect =
        test.freedom > 0 && test.p_value < alarm_level / tested &&
        strangeness(test) >= strangest - std::max(same_statistic, same_share * strangest);
  return tests;
}

int rank_of(const AdjustmentObservation& observation) {
  if (observation.group != ObservationGroup::shape)
    return static_cast<int>(observation.misclosure.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(observation.weight,
                                                                Eigen::EigenvaluesOnly);
  const double least = 1e-11 * spectrum.eigenvalues().tail<1>()[0];
  return static_cast<int>((spectrum.eigenvalues().array() > least).count());
}

std::vector<VarianceComponent> variance_components(const LinearisedAdjustment& linearised,
                                                   const Eigen::MatrixXd& covariance) {
  const std::pair<ObservationGroup, const char*> groups[] = {
      {ObservationGroup::facets, "facets"},
      {ObservationGroup::shape, "shape prior"},
      {ObservationGroup::edges, "edges"},
      {ObservationGroup::planes, "scene planes"},
      {ObservationGroup::levels, "levelling"}};
  std::vector<VarianceComponent> components;
  for (const auto& [group, name] : groups) {
    double squares = 0, freedom = 0;
    for (const AdjustmentObservation& o : linearised.observations) {
      if (o.group != group) continue;
      squares += o.misclosure.dot(o.weight * o.misclosure);
      freedom +=
          rank_of(o) - (o.weight * o.by_unknowns * covariance * o.by_unknowns.transpose()).trace();
    }
    if (freedom > 1e-6) components.push_back({name, {}, squares / freedom, freedom});
  }
  return components;
}

}  // namespace alea
