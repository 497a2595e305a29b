#include "alea/sphere/sphere_registration.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "alea/transform/horn.hpp"

namespace alea {
namespace {

constexpr int refinement_steps = 4;
constexpr double far_origin_m = 1000;
constexpr double least_spread = 0.01, least_spread_sd = 20;

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // about the first point: far origins cost nothing
  for (const Eigen::Vector3d& point : points) sum += point - points[0];
  return points[0] + sum / static_cast<double>(points.size());
}

bool on_one_line(const std::vector<Eigen::Vector3d>& centres, double centre_sd_m) {
  const Eigen::Vector3d mean = mean_of(centres);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& centre : centres)
    scatter += (centre - mean) * (centre - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spectrum(scatter, Eigen::EigenvaluesOnly);
  const double along = std::sqrt(spectrum.eigenvalues()[2]);
  const double across = std::sqrt(std::max(0.0, spectrum.eigenvalues()[1]));
  return across < least_spread * along || across < least_spread_sd * centre_sd_m;
}

/// The pairs' centres and covariances, in the order of the pairs.
struct Centres {
  std::vector<Eigen::Vector3d> master, slave;
  std::vector<Eigen::Matrix3d> master_covariance, slave_covariance;
};

struct Normal {
  Matrix6d information = Matrix6d::Zero();
  Vector6d right = Vector6d::Zero();
  double chi_squared = 0;
};

Normal normal_of(const Centres& centres, const RigidTransform& master_from_slave,
                 const Eigen::Vector3d& about_m) {
  Normal normal;
  for (std::size_t k = 0; k < centres.master.size(); ++k) {
    const Eigen::Vector3d predicted = master_from_slave * centres.slave[k];
    const Eigen::Vector3d residual = centres.master[k] - predicted;
    const Eigen::Matrix3d weight =
        (centres.master_covariance[k] + master_from_slave.rotation * centres.slave_covariance[k] *
                                            master_from_slave.rotation.transpose())
            .inverse();
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian << -skew(predicted - about_m), Eigen::Matrix3d::Identity();
    normal.information += jacobian.transpose() * weight * jacobian;
    normal.right += jacobian.transpose() * weight * residual;
    normal.chi_squared += residual.dot(weight * residual);
  }
  return normal;
}

}  // namespace

Result<SphereRegistration> register_sphere_pairs(std::span<const SphereFit> master,
                                                 std::span<const SphereFit> slave,
                                                 const std::vector<SpherePair>& pairs) {
  if (pairs.size() < 3)
    return Refusal{RefusalCode::too_few_points,
                   std::to_string(pairs.size()) +
                       " spheres in both scans, three are needed; place more of them"};
  Centres centres;
  std::vector<double> weights;
  double largest_variance = 0;
  for (const SpherePair& pair : pairs) {
    const SphereFit &m = master[pair.master], &s = slave[pair.slave];
    centres.master.push_back(m.centre_m);
    centres.slave.push_back(s.centre_m);
    centres.master_covariance.push_back(m.covariance);
    centres.slave_covariance.push_back(s.covariance);
    const double variance = (m.covariance.trace() + s.covariance.trace()) / 3;
    weights.push_back(1 / variance);
    largest_variance = std::max(largest_variance, variance);
  }
  if (on_one_line(centres.master, std::sqrt(largest_variance)))
    return Refusal{RefusalCode::collinear,
                   "the centres of the spheres lie on one line; move one of them off it"};
  SphereRegistration result;
  result.pairs = pairs;
  result.master_from_slave = horn(centres.master, centres.slave, weights);
  const Eigen::Vector3d about = mean_of(centres.master);
  for (int step = 0; step < refinement_steps; ++step) {
    const Normal normal = normal_of(centres, result.master_from_slave, about);
    result.master_from_slave = perturb_left(result.master_from_slave,
                                            normal.information.ldlt().solve(normal.right), about);
  }
  const Normal normal = normal_of(centres, result.master_from_slave, about);
  const Matrix6d covariance = normal.information.ldlt().solve(Matrix6d::Identity());
  result.chi_squared = normal.chi_squared;
  result.covariance = {(covariance + covariance.transpose()) / 2, about};
  if (about.norm() < far_origin_m)
    result.covariance = moved_to(result.covariance, Eigen::Vector3d::Zero());
  for (std::size_t k = 0; k < pairs.size(); ++k)
    result.residual_m.push_back(
        (centres.master[k] - result.master_from_slave * centres.slave[k]).norm());
  return result;
}

}  // namespace alea
