#include "experiments/die/skewed_die.hpp"

#include <cmath>
#include <numbers>

#include "alea/die/ideal_observation.hpp"
#include "alea/simulate/die_model.hpp"
#include "alea/simulate/scene.hpp"

namespace alea::experiments::die {
namespace {

constexpr std::uint32_t skewed_die_number = 20;

RigidTransform station(double distance_m, double azimuth_rad, double height_m) {
  const Eigen::Vector3d position(distance_m * std::cos(azimuth_rad),
                                 distance_m * std::sin(azimuth_rad), height_m);
  return levelled_pose(position, azimuth_rad + std::numbers::pi);
}

}  // namespace

SkewedDie draw_skewed_die(const SkewedDieOptions& options, std::uint64_t seed,
                          std::uint64_t trial) {
  DieModel model;
  model.size_m.setConstant(options.edge_m);
  model.chirality = options.chirality;
  model = with_random_shape(model, {options.tilt_sd_rad, 0, options.size_sd_share}, seed,
                            skewed_die_number, trial);
  SkewedDie die;
  const auto planes = die_planes(model);
  for (int f = 0; f < 6; ++f) die.shape.facets[f] = planes[f];

  const double azimuth = std::numbers::pi / 4;
  const RigidTransform die_from_master = station(options.distance_m[0], azimuth, options.height_m);
  const RigidTransform die_from_slave =
      station(options.distance_m[1], azimuth - options.separation_rad, options.height_m);
  die.master_from_slave = die_from_master.inverse() * die_from_slave;
  die.centre_in_master_m = die_from_master.inverse().translation;
  die.master = observe_exactly(die.shape, facing_pips(die.shape, die_from_master.translation),
                               die_from_master.inverse());
  die.slave = observe_exactly(die.shape, facing_pips(die.shape, die_from_slave.translation),
                              die_from_slave.inverse());
  const auto shared = shared_pips(die.master, die.slave);
  if (shared.size() == 2) die.shared_edge_m = edge_length_m(die.shape, shared[0], shared[1]);
  return die;
}

PoseError pose_error(const RigidTransform& estimate, const SkewedDie& die) {
  const RigidTransform error = estimate * die.master_from_slave.inverse();
  PoseError out;
  out.rotation_rad = rotation_angle_rad(error.rotation);
  out.at_die_m = (error * die.centre_in_master_m - die.centre_in_master_m).norm();
  const int count = 36;
  double sum = 0;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    const Eigen::Vector3d p =
        die.centre_in_master_m + 5 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    sum += (error * p - p).squaredNorm();
  }
  out.ring5_m = std::sqrt(sum / count);
  return out;
}

}  // namespace alea::experiments::die
