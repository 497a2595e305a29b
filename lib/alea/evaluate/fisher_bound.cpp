#include "alea/evaluate/fisher_bound.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/core/error.hpp"
#include "alea/evaluate/fisher_normal.hpp"

namespace alea {
namespace {

/// Eigenvalues of the normal matrix, scaled to a unit diagonal, below this share of the largest
/// count as zero: rounding leaves 1e-15, the weakest real geometry of the die study 1e-7.
constexpr double rank_tolerance = 1e-11;

/// Orthonormal directions that keep the constraints.
Eigen::MatrixXd kernel_of(const Eigen::MatrixXd& constraints) {
  const auto size = constraints.cols();
  if (constraints.rows() == 0) return Eigen::MatrixXd::Identity(size, size);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(constraints.transpose());
  const Eigen::MatrixXd q = qr.householderQ();
  return q.rightCols(size - qr.rank());
}

int nullity(const Eigen::MatrixXd& information, double tolerance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(information,
                                                                Eigen::EigenvaluesOnly);
  return static_cast<int>((spectrum.eigenvalues().array() < tolerance).count());
}

/// Common motions of everything that the data leave open: six less what levelling fixes.
int free_world_motions(const FisherNormal& system, const Eigen::VectorXd& unit, double tolerance) {
  Eigen::MatrixXd motions = unit.cwiseInverse().asDiagonal() * system.world;
  motions.colwise().normalize();
  const Eigen::MatrixXd scaled = unit.asDiagonal() * system.normal * unit.asDiagonal();
  return nullity(motions.transpose() * scaled * motions, tolerance);
}

}  // namespace

FisherBound fisher_bound(const FisherScene& scene) {
  if (scene.stations.size() < 2 || (scene.bodies.empty() && scene.spheres.empty()))
    throw usage_error("Fisher bound: give at least two stations and one target");
  const FisherNormal system = fisher_normal(scene);
  // A parameter that no ray touches keeps the unit 1; it stays open.
  const Eigen::VectorXd unit = system.normal.diagonal().unaryExpr(
      [](double information) { return information > 0 ? 1 / std::sqrt(information) : 1.0; });
  const Eigen::MatrixXd kernel = kernel_of(system.constraints * unit.asDiagonal());
  const Eigen::MatrixXd scaled =
      kernel.transpose() * (unit.asDiagonal() * system.normal * unit.asDiagonal()) * kernel;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(scaled);
  // The diagonal is one where there is any information at all.
  const double tolerance = rank_tolerance * std::max(1.0, spectrum.eigenvalues().tail<1>()[0]);
  const auto open = static_cast<Eigen::Index>((spectrum.eigenvalues().array() < tolerance).count());
  const auto known = scaled.rows() - open;
  const auto stations = static_cast<Eigen::Index>(6 * scene.stations.size());
  const Eigen::MatrixXd directions =
      (unit.asDiagonal() * kernel * spectrum.eigenvectors()).topRows(stations);
  FisherBound bound;
  bound.open = directions.leftCols(open);
  bound.station_covariance = directions.rightCols(known) *
                             spectrum.eigenvalues().tail(known).cwiseInverse().asDiagonal() *
                             directions.rightCols(known).transpose();
  bound.unit = unit.head(stations);
  bound.about_m = system.about_m;
  bound.defect =
      static_cast<int>(open) - system.redundant - free_world_motions(system, unit, tolerance);
  for (const FisherStation& station : scene.stations)
    bound.scene_from_scan.push_back(station.scene_from_scan);
  return bound;
}

Result<TransformCovariance> relative_covariance(const FisherBound& bound, std::size_t master,
                                                std::size_t slave,
                                                const Eigen::Vector3d& about_scene_m) {
  const auto count = bound.station_covariance.rows();
  Eigen::MatrixXd difference = Eigen::MatrixXd::Zero(6, count);
  difference.middleCols<6>(static_cast<Eigen::Index>(6 * slave)).setIdentity();
  difference.middleCols<6>(static_cast<Eigen::Index>(6 * master)) = -Matrix6d::Identity();
  const Eigen::VectorXd unit = difference.cwiseAbs() * bound.unit;
  const Eigen::VectorXd leak = (difference * bound.open).rowwise().norm();
  if ((leak.array() > 1e-4 * unit.array()).any())
    return Refusal{RefusalCode::unobservable,
                   "these targets leave the pose of one station against the other open; give an "
                   "edge length, a known shape or a common plane"};
  const RigidTransform master_from_scene = bound.scene_from_scan.at(master).inverse();
  const TransformCovariance in_scene =
      moved_to({difference * bound.station_covariance * difference.transpose(), bound.about_m},
               about_scene_m);
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = master_from_scene.rotation;
  return TransformCovariance{turn * in_scene.covariance * turn.transpose(),
                             master_from_scene * about_scene_m};
}

double ring_error_m(const TransformCovariance& covariance, double radius_m,
                    const Eigen::Vector3d& up) {
  const Eigen::Matrix3d rotation = covariance.covariance.topLeftCorner<3, 3>();
  const Eigen::Matrix3d translation = covariance.covariance.bottomRightCorner<3, 3>();
  // Over the ring the mean of |w x p|^2 is radius^2 (w'w - w' <p p'> w / radius^2), <p p'> being
  // half the projector on the ring's plane; the mixed term has zero mean.
  const Eigen::Vector3d axis = up.normalized();
  const double lever = (rotation.trace() + axis.dot(rotation * axis)) / 2;
  return std::sqrt(radius_m * radius_m * lever + translation.trace());
}

PoseAccuracy pose_accuracy(const TransformCovariance& covariance, const Eigen::Vector3d& up) {
  return {std::sqrt(covariance.covariance.topLeftCorner<3, 3>().trace()),
          ring_error_m(covariance, 0, up), ring_error_m(covariance, 5, up),
          ring_error_m(covariance, 10, up)};
}

FisherScene die_bound_scene(const DieBoundCase& geometry) {
  FisherScene scene;
  scene.noise = geometry.noise;
  const std::vector<Plane> planes = cube_on_floor(geometry.edge_m);
  const double first = std::numbers::pi / 4;
  const double above_m = geometry.scanner_height_m - geometry.edge_m / 2;
  if (geometry.range_m <= std::abs(above_m))
    throw usage_error(
        "die bound: the range from the scanner to the die's centre must exceed their "
        "difference in height");
  const double distance_m = std::sqrt(geometry.range_m * geometry.range_m - above_m * above_m);
  for (const double azimuth : {first, first + geometry.separation_rad})
    scene.stations.push_back(
        station_at(distance_m, azimuth, geometry.scanner_height_m, geometry.step_rad));
  scene.bodies = {geometry.shape_known ? known_body(planes) : free_body(planes)};
  if (!geometry.shape_known)
    scene.bodies[0].edges = {shared_edge(scene.bodies[0], scene.stations[0], scene.stations[1])};
  return scene;
}

PoseAccuracy die_bound(const DieBoundCase& geometry) {
  const Eigen::Vector3d centre(0, 0, geometry.edge_m / 2);
  return pose_accuracy(*relative_covariance(fisher_bound(die_bound_scene(geometry)), 0, 1, centre));
}

}  // namespace alea
