#include "experiments/checkerboard/synthetic_trial.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "alea/checkerboard/measurement.hpp"
#include "alea/cloud/normals.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "alea/transform/icp.hpp"

namespace alea::experiments::checkerboard {
namespace {

bool is_wall(Target target) {
  return target == Target::white_wall || target == Target::grey_wall;
}

BoardSpec spec_of(const SyntheticCase& synthetic) {
  return {synthetic.squares, synthetic.squares, 1.0 / synthetic.squares};
}

/// The surface that is scanned, before it is moved.
Cloud surface(const SyntheticCase& synthetic, const Cloud& board, RandomStream& stream) {
  if (synthetic.target == Target::identical) return board;
  const BoardSpec spec = spec_of(synthetic);
  const double extent = is_wall(synthetic.target) ? 2.4 : 1.0;
  const auto points = static_cast<std::size_t>(
      std::lround(synthetic.points_along_side * synthetic.points_along_side * extent * extent));
  const float around = synthetic.target == Target::white_wall ? 1.0f : 0.5f;
  Cloud cloud;
  for (std::size_t k = 0; k < points; ++k) {
    const Eigen::Vector2d at =
        extent * Eigen::Vector2d(stream.uniform() - 0.5, stream.uniform() - 0.5);
    const bool on_board = at.cwiseAbs().maxCoeff() <= 0.5;
    cloud.positions.emplace_back(at.x(), at.y(), 0);
    cloud.intensity.push_back(!on_board ? around : pattern_sign(spec, at) > 0 ? 1.0f : 0.0f);
  }
  return cloud;
}

IcpOptions icp_options(const SyntheticCase& synthetic, IcpObjective objective) {
  IcpOptions options;
  options.objective = objective;
  options.max_distance_m = synthetic.max_distance;
  return options;
}

/// Of the two (or one) ways in which the board may lie, the one turned least from the start.
RigidTransform least_turned(const BoardMeasurement& measurement) {
  std::vector<BoardAxes> all = measurement.alternatives;
  all.push_back(measurement.axes);
  RigidTransform best;
  double least = 10;
  for (const BoardAxes& axes : all) {
    Eigen::Matrix3d rotation;
    rotation << axes, measurement.normal;
    const double angle = rotation_angle_rad(rotation);
    if (angle < least) {
      least = angle;
      best = {rotation, measurement.centre_m};
    }
  }
  return best;
}

RigidTransform estimate(const SyntheticCase& synthetic, Method method, const SyntheticPair& pair) {
  const auto align = [&](IcpObjective objective, const RigidTransform& start) {
    return icp(pair.target, pair.board, start, icp_options(synthetic, objective))
        .target_from_source;
  };
  switch (method) {
    case Method::coloured:
      return align(IcpObjective::coloured, {});
    case Method::point_to_plane:
      return align(IcpObjective::point_to_plane, {});
    case Method::point_to_point:
      return align(IcpObjective::point_to_point, {});
    case Method::plane_then_coloured:
      return align(IcpObjective::coloured, align(IcpObjective::point_to_plane, {}));
    case Method::likelihood:
      break;
  }
  BoardOptions options;
  options.board = spec_of(synthetic);
  options.scanner_position = Eigen::Vector3d(0, 0, 100);  // the side that is seen
  options.along_rays = false;
  options.search_sides = 1.6;
  const auto result = measure_by_likelihood(pair.target, Eigen::Vector3d::Zero(), options);
  if (!result) return {Eigen::Matrix3d::Identity(), {1e3, 0, 0}};
  return least_turned(*result);
}

double rmse_between(const Cloud& board, const RigidTransform& a, const RigidTransform& b) {
  double sum = 0;
  for (const Eigen::Vector3d& p : board.positions) sum += (a * p - b * p).squaredNorm();
  return std::sqrt(sum / static_cast<double>(board.size()));
}

SyntheticOutcome judged(const SyntheticCase& synthetic, const SyntheticPair& pair,
                        const RigidTransform& found) {
  const RigidTransform half_turn{rotation_exp({0, 0, std::numbers::pi}), Eigen::Vector3d::Zero()};
  SyntheticOutcome outcome;
  outcome.rmse = rmse_between(pair.board, found, pair.target_from_board);
  outcome.rmse_symmetric =
      std::min(outcome.rmse, rmse_between(pair.board, found * half_turn, pair.target_from_board));
  Cloud placed = pair.board;
  for (Eigen::Vector3d& p : placed.positions) p = found * p;
  // Points at random places leave larger gaps than a grid.
  const double gate =
      (synthetic.target == Target::identical ? 1.5 : 2.5) / synthetic.points_along_side +
      2 * synthetic.noise;
  outcome.score = colour_score(placed, pair.target, is_wall(synthetic.target) ? 0.25 : 0.5, gate);
  outcome.strict = outcome.rmse < 0.15 && outcome.score > 0.5;
  outcome.symmetric = outcome.rmse_symmetric < 0.15 && outcome.score > 0.5;
  return outcome;
}

}  // namespace

const char* to_string(Target target) {
  switch (target) {
    case Target::identical:
      return "identical";
    case Target::independent:
      return "independent";
    case Target::white_wall:
      return "white_wall";
    case Target::grey_wall:
      return "grey_wall";
  }
  return "unknown";
}

const char* to_string(Method method) {
  switch (method) {
    case Method::coloured:
      return "coloured";
    case Method::point_to_plane:
      return "point_to_plane";
    case Method::point_to_point:
      return "point_to_point";
    case Method::plane_then_coloured:
      return "plane_then_coloured";
    case Method::likelihood:
      return "likelihood";
  }
  return "unknown";
}

SyntheticPair make_pair(const SyntheticCase& synthetic, std::uint64_t seed, std::uint64_t trial) {
  constexpr std::uint32_t experiment = 500;
  RandomStream layout({seed, experiment, trial, 0, Purpose::scene_layout});
  RandomStream sampling({seed, experiment, trial, 0, Purpose::sampling});
  const RandomStream noise({seed, experiment, trial, 0, Purpose::range_noise});
  SyntheticPair pair;
  pair.board = board_template(spec_of(synthetic), synthetic.points_along_side);
  const double direction = 2 * std::numbers::pi * layout.uniform();
  const double axis = 2 * std::numbers::pi * layout.uniform();
  const double sign = layout.uniform() < 0.5 ? -1 : 1;
  pair.target_from_board.rotation =
      rotation_exp(synthetic.rotation_rad * Eigen::Vector3d(std::cos(axis), std::sin(axis), 0)) *
      rotation_exp({0, 0, sign * synthetic.rotation_rad});
  pair.target_from_board.translation =
      synthetic.shift * Eigen::Vector3d(std::cos(direction), std::sin(direction), 0);
  pair.target = surface(synthetic, pair.board, sampling);
  for (std::size_t i = 0; i < pair.target.size(); ++i) {
    const auto xy = noise.normal2_at(2 * i);
    const Eigen::Vector3d off(xy[0], xy[1], noise.normal_at(2 * i + 1));
    pair.target.positions[i] =
        pair.target_from_board * pair.target.positions[i] + synthetic.noise * off;
  }
  pair.target.normals.clear();
  NormalOptions normals;
  normals.neighbours = 30;
  normals.toward = Eigen::Vector3d(0, 0, 100);
  for (const Eigen::Vector3d& n : estimate_normals(pair.target, normals))
    pair.target.normals.push_back(n.cast<float>());
  return pair;
}

SyntheticOutcome run_trial(const SyntheticCase& synthetic, Method method, std::uint64_t seed,
                           std::uint64_t trial) {
  const SyntheticPair pair = make_pair(synthetic, seed, trial);
  return judged(synthetic, pair, estimate(synthetic, method, pair));
}

std::vector<SyntheticOutcome> run_trials(const SyntheticCase& synthetic, Method method,
                                         std::uint64_t seed, std::uint64_t trials) {
  std::vector<SyntheticOutcome> outcomes(trials);
  parallel_chunks(trials, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t trial = begin; trial < end; ++trial)
      outcomes[trial] = run_trial(synthetic, method, seed, trial);
  });
  return outcomes;
}

}  // namespace alea::experiments::checkerboard
