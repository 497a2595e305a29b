#include "alea/simulate/board_sensor.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "alea/simulate/primitive_ray.hpp"

namespace alea {
namespace {

constexpr double arc_second = std::numbers::pi / 180 / 3600;

/// Where an edge across x appears to a least-squares fit of a Gaussian blur: the L and b with the
/// least integral of (F(x) - Phi((x - L) / b))^2, F the share of the beam below x.
double edge_shift_m(const std::vector<Eigen::Vector2d>& offsets) {
  double mean = 0, square = 0;
  for (const Eigen::Vector2d& offset : offsets) {
    mean += offset.x() / static_cast<double>(offsets.size());
    square += offset.x() * offset.x() / static_cast<double>(offsets.size());
  }
  double shift = mean, blur = std::sqrt(std::max(square - mean * mean, 1e-12));
  const double step = blur / 20;
  for (int round = 0; round < 8; ++round) {
    Eigen::Matrix2d normal_matrix = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (int k = -120; k <= 120; ++k) {
      const double x = mean + k * step, u = (x - shift) / blur;
      double below = 0;
      for (const Eigen::Vector2d& offset : offsets) below += offset.x() < x;
      const double residual =
          below / static_cast<double>(offsets.size()) - 0.5 * std::erfc(-u / std::numbers::sqrt2);
      const double density = std::exp(-0.5 * u * u) / (std::sqrt(2 * std::numbers::pi) * blur);
      const Eigen::Vector2d row(-density, -density * u);
      normal_matrix += row * row.transpose();
      right += residual * row;
    }
    const Eigen::Vector2d delta = normal_matrix.inverse() * right;
    shift += delta.x();
    blur += delta.y();
  }
  return shift;
}

/// Offsets across the beam, each as likely as the other: what a beam averages over.
std::vector<Eigen::Vector2d> beam_offsets(const BoardSensor& sensor) {
  // A lattice of golden sections mapped to normals (Box and Muller), each with its opposite, times
  // quantiles of the exponential.
  constexpr int pairs = 18, quantiles = 12;
  const int tails = sensor.cross_talk_m > 0 ? quantiles : 1;
  std::vector<Eigen::Vector2d> offsets;
  for (int k = 0; k < 2 * pairs; ++k) {
    const double radius = std::sqrt(-2 * std::log((k / 2 + 0.5) / pairs));
    const double angle = 2 * std::numbers::pi * std::fmod((k / 2) * 0.6180339887498949, 1.0);
    const double sign = k % 2 == 0 ? 1 : -1;
    for (int t = 0; t < tails; ++t)
      offsets.emplace_back(sign * sensor.footprint_x_m * radius * std::cos(angle) -
                               sensor.cross_talk_m * std::log((t + 0.5) / tails),
                           sign * sensor.footprint_y_m * radius * std::sin(angle));
  }
  const double shift = edge_shift_m(offsets);
  for (Eigen::Vector2d& offset : offsets) offset.x() -= shift;
  return offsets;
}

/// The reported directions: a window around the plate, with a phase of its own for each scan.
std::vector<Eigen::Vector2d> directions(const Checkerboard& board, const RigidTransform& pose,
                                        const BoardSensor& sensor, RandomStream& layout) {
  const double distance = pose.translation.norm(), step = sensor.spacing_m / distance;
  const double half = std::asin(std::min(1.0, half_plate_m(board).norm() / distance)) + 2 * step;
  const double azimuth = std::atan2(pose.translation.y(), pose.translation.x());
  const double elevation = std::asin(pose.translation.z() / distance);
  const int side = static_cast<int>(std::ceil(2 * half / step));
  std::vector<Eigen::Vector2d> angles;
  const double phase_x = layout.uniform(), phase_y = layout.uniform();
  for (int k = 0; k < side * side; ++k) {
    Eigen::Vector2d at(k % side + phase_x, k / side + phase_y);
    if (!sensor.raster) at = side * Eigen::Vector2d(layout.uniform(), layout.uniform());
    angles.emplace_back(azimuth - half + at.x() * step, elevation - half + at.y() * step);
  }
  return angles;
}

Eigen::Vector3d direction(const Eigen::Vector2d& angles) {
  return {std::cos(angles.y()) * std::cos(angles.x()), std::cos(angles.y()) * std::sin(angles.x()),
          std::sin(angles.y())};
}

}  // namespace

BoardSensor survey_sensor() {
  BoardSensor sensor;
  sensor.name = "survey";
  sensor.direction_sd_rad = 18 * arc_second;
  sensor.footprint_x_m = sensor.footprint_y_m = 0.0027;
  return sensor;
}

BoardSensor low_cost_sensor() {
  BoardSensor sensor;
  sensor.name = "low_cost";
  sensor.board_side_m = 0.30;
  sensor.range_m = 3;
  sensor.raster = false;
  sensor.spacing_m = 0.30 / std::sqrt(3500.0);
  sensor.range_sd_light_m = 0.020;
  sensor.range_sd_dark_m = 0.035;
  sensor.outlier_share_dark = 0.08;
  sensor.outlier_sd_m = 0.120;
  sensor.direction_sd_rad = 0.26e-3;
  sensor.footprint_x_m = 0.008;
  sensor.footprint_y_m = 0.003;
  sensor.cross_talk_m = 0.006;
  sensor.intensity_sd = 0.08;
  return sensor;
}

Cloud scan_board(const Checkerboard& board, const RigidTransform& scanner_from_board,
                 const BoardSensor& sensor, const StreamKey& key) {
  const auto stream = [&key](Purpose purpose) {
    StreamKey own = key;
    own.purpose = purpose;
    return RandomStream(own);
  };
  RandomStream layout = stream(Purpose::scene_layout);
  const RandomStream jitter = stream(Purpose::angular_noise), range = stream(Purpose::range_noise);
  const RandomStream shade = stream(Purpose::intensity_noise), stray = stream(Purpose::mixed_pixel);
  Checkerboard placed = board;
  placed.scene_from_board = scanner_from_board;
  const double distance = scanner_from_board.translation.norm();
  const std::vector<Eigen::Vector2d> beam = beam_offsets(sensor);
  const std::vector<Eigen::Vector2d> angles = directions(board, scanner_from_board, sensor, layout);
  Cloud cloud;
  cloud.scanner_position = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const auto off = jitter.normal2_at(k);
    const Eigen::Vector2d pointed =
        angles[k] + sensor.direction_sd_rad * Eigen::Vector2d(off[0], off[1]);
    Hit hit;
    intersect(placed, 0, {Eigen::Vector3d::Zero(), direction(pointed)}, hit);
    if (!std::isfinite(hit.range_m)) continue;
    double sum = 0, returns = 0;
    for (const Eigen::Vector2d& offset : beam) {
      Hit part;
      intersect(placed, 0, {Eigen::Vector3d::Zero(), direction(pointed + offset / distance)}, part);
      if (!std::isfinite(part.range_m)) continue;
      sum += part.intensity;
      returns += 1;
    }
    const bool is_dark = hit.intensity < (board.dark_intensity + board.light_intensity) / 2;
    const double sd = is_dark ? sensor.range_sd_dark_m : sensor.range_sd_light_m;
    double error = sd * range.normal_at(k);
    if (is_dark && stray.uniform_at(2 * k) < sensor.outlier_share_dark)
      error += sensor.outlier_sd_m * stray.normal_at(2 * k + 1);
    cloud.positions.push_back((hit.range_m + error) * direction(angles[k]));
    const double intensity = returns > 0 ? sum / returns : hit.intensity;
    cloud.intensity.push_back(
        static_cast<float>(intensity + sensor.intensity_sd * shade.normal_at(k)));
  }
  return cloud;
}

}  // namespace alea
