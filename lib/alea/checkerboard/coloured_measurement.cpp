#include "alea/checkerboard/coloured_measurement.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "alea/checkerboard/rough_plane.hpp"
#include "alea/cloud/normals.hpp"
#include "alea/core/error.hpp"

namespace alea {
namespace {

Cloud near_place(const Cloud& cloud, const Eigen::Vector3d& near_m, double radius_m) {
  std::vector<std::uint32_t> inside;
  for (std::uint32_t i = 0; i < cloud.size(); ++i)
    if ((cloud.positions[i] - near_m).norm() <= radius_m) inside.push_back(i);
  Cloud crop = subset(cloud, inside);
  crop.scanner_position = cloud.scanner_position;
  return crop;
}

/// Facing the scanner, rows as far upward as that allows.
RigidTransform facing_start(const Eigen::Vector3d& near_m, const Eigen::Vector3d& scanner) {
  Eigen::Vector3d normal = scanner - near_m;
  normal = normal.norm() > 0 ? Eigen::Vector3d(normal.normalized()) : Eigen::Vector3d::UnitZ();
  Eigen::Vector3d columns = Eigen::Vector3d::UnitZ().cross(normal);
  if (columns.norm() < 1e-6) columns = Eigen::Vector3d::UnitX();
  columns = (columns - columns.dot(normal) * normal).normalized();
  RigidTransform start;
  start.rotation << columns, normal.cross(columns), normal;
  start.translation = near_m;
  return start;
}

/// x_scaled = scale * (x - centre): lengths in sides, about the target.
struct Scaling {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double scale = 1;

  Cloud operator()(const Cloud& cloud) const {
    Cloud scaled = cloud;
    for (Eigen::Vector3d& p : scaled.positions) p = scale * (p - centre);
    if (scaled.scanner_position)
      *scaled.scanner_position = scale * (*scaled.scanner_position - centre);
    return scaled;
  }
  /// Scan from board to scaled scan from scaled board, and back.
  RigidTransform into(const RigidTransform& pose) const {
    return {pose.rotation, scale * (pose.translation - centre)};
  }
  RigidTransform back(const RigidTransform& pose) const {
    return {pose.rotation, pose.translation / scale + centre};
  }
};

Eigen::Vector3d mean_of(const Cloud& cloud) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : cloud.positions) sum += p;
  return sum / static_cast<double>(cloud.size());
}

void remove_outliers(Cloud& cloud, double side_m) {
  BoardPoints points;
  points.origin = mean_of(cloud);
  for (const Eigen::Vector3d& p : cloud.positions) points.positions.push_back(p - points.origin);
  points.intensity = cloud.intensity;
  if (const auto plane = find_rough_plane(points, side_m)) {
    Cloud kept = subset(cloud, plane->members);
    kept.scanner_position = cloud.scanner_position;
    cloud = std::move(kept);
  }
}

void binarise(Cloud& cloud) {
  const double threshold = otsu_threshold(cloud.intensity);
  for (float& value : cloud.intensity) value = value > threshold ? 1.0f : 0.0f;
}

IcpOptions icp_options(const ColouredBoardOptions& coloured, double side_m,
                       IcpObjective objective) {
  IcpOptions options;
  options.objective = objective;
  options.max_distance_m = coloured.max_distance_sides * side_m;
  options.gradient_radius_m = 2 * options.max_distance_m;
  options.lambda = coloured.lambda;
  options.max_iterations = coloured.max_iterations;
  options.translation_tolerance_m = 1e-7 * side_m;
  return options;
}

double rmse_about(const Cloud& cloud, const RigidTransform& scan_from_board,
                  const BoardSpec& board) {
  const RigidTransform board_from_scan = scan_from_board.inverse();
  double sum = 0, n = 0;
  for (const Eigen::Vector3d& p : cloud.positions) {
    const Eigen::Vector3d at = board_from_scan * p;
    if (std::abs(at.x()) > board.side_m() / 2 || std::abs(at.y()) > board.height_m() / 2) continue;
    sum += at.z() * at.z();
    ++n;
  }
  return n > 0 ? std::sqrt(sum / n) : 0;
}

double score_of(const Cloud& board_points, const Cloud& binary, double threshold,
                const RigidTransform& scan_from_board, const BoardSpec& board,
                int template_points) {
  Cloud placed = board_points;
  for (Eigen::Vector3d& p : placed.positions) p = scan_from_board * p;
  const double radius = 0.5 * std::hypot(board.side_m(), board.height_m());
  double near = 1;
  for (const Eigen::Vector3d& p : binary.positions)
    near += (p - scan_from_board.translation).norm() < radius;
  const double spacing = std::sqrt(3.14 * radius * radius / near);
  return colour_score(placed, binary, threshold,
                      1.5 * std::max(board.side_m() / template_points, spacing));
}

BoardMeasurement measurement_at(const RigidTransform& pose, const Eigen::Vector3d& scanner,
                                const BoardSpec& board) {
  BoardMeasurement result;
  result.centre_m = pose.translation;
  result.normal = pose.rotation.col(2);
  result.axes = pose.rotation.leftCols<2>();
  if (result.normal.dot(scanner - pose.translation) < 0) {  // seen from behind: turned about rows
    result.normal = -result.normal;
    result.axes.col(0) = -result.axes.col(0);
  }
  result.cell_m = board.cell_m;
  if (board.half_turn_symmetric()) result.alternatives.push_back(-result.axes);
  return result;
}

/// Scan from board after the two alignments; empty where one found no pairs. `note` hears of the
/// pose before and after each.
template <typename Note>
std::optional<RigidTransform> aligned_template(const Cloud& target, const Cloud& board_points,
                                               const RigidTransform& start, double side_m,
                                               const ColouredBoardOptions& coloured,
                                               const Note& note) {
  Scaling scaling, from_board;
  if (coloured.centred) scaling = {mean_of(target), 1 / side_m};
  from_board.scale = scaling.scale;
  Cloud scaled_target = scaling(target);
  NormalOptions normals;
  normals.neighbours = static_cast<int>(coloured.normal_neighbours);
  for (const Eigen::Vector3d& n : estimate_normals(scaled_target, normals))
    scaled_target.normals.push_back(n.cast<float>());
  const Cloud scaled_board = from_board(board_points);
  RigidTransform pose = scaling.into(start);
  note("start", start);
  bool found_pairs = true;
  const auto align = [&](const char* name, IcpObjective objective) {
    const IcpResult result = icp(scaled_target, scaled_board, pose,
                                 icp_options(coloured, scaling.scale * side_m, objective));
    pose = result.target_from_source;
    found_pairs = result.stop != IcpStop::too_few_pairs && result.stop != IcpStop::undetermined;
    note(name, scaling.back(pose));
  };
  if (coloured.point_to_plane) align("point_to_plane", IcpObjective::point_to_plane);
  if (coloured.coloured) align("coloured", IcpObjective::coloured);
  const RigidTransform scan_from_board = scaling.back(pose);
  if (!found_pairs || !scan_from_board.translation.allFinite()) return std::nullopt;
  return scan_from_board;
}

}  // namespace

Result<BoardMeasurement> measure_by_coloured_icp(const Cloud& cloud, const Eigen::Vector3d& near_m,
                                                 const BoardOptions& options,
                                                 const ColouredBoardOptions& coloured,
                                                 ColouredBoardStages* stages) {
  const BoardSpec& board = options.board;
  require_valid(board);
  if (!cloud.has_intensity())
    throw input_error(
        "the cloud has no intensity or colour; a checkerboard cannot be read from it");
  const Eigen::Vector3d scanner = scanner_of(cloud, options);
  Cloud target = near_place(cloud, near_m, coloured.crop_sides * board.side_m());
  target.scanner_position = scanner;
  if (stages) stages->cropped = target;
  if (coloured.remove_outliers && target.size() >= 8) remove_outliers(target, board.side_m());
  if (stages) stages->without_outliers = target;
  if (target.size() < 24)
    return Refusal{RefusalCode::too_few_points,
                   fmt::format("{} points within {:.3f} m of the place; at least 24 are needed",
                               target.size(), coloured.crop_sides * board.side_m())};
  const double threshold = coloured.binarise ? 0.5 : otsu_threshold(target.intensity);
  if (coloured.binarise) binarise(target);
  if (stages) stages->binarised = target;

  const Cloud board_points = board_template(board, coloured.template_points);
  const auto scan_from_board =
      aligned_template(target, board_points, coloured.start.value_or(facing_start(near_m, scanner)),
                       board.side_m(), coloured, [&](const char* name, const RigidTransform& pose) {
                         if (stages) stages->poses.emplace_back(name, pose);
                       });
  if (!scan_from_board)
    return Refusal{RefusalCode::no_convergence, "the template found no pairs; check --near"};
  BoardMeasurement result = measurement_at(*scan_from_board, scanner, board);
  result.points = target.size();
  result.rmse_m = rmse_about(target, *scan_from_board, board);
  result.colour_score =
      score_of(board_points, target, threshold, *scan_from_board, board, coloured.template_points);
  if (coloured.coloured && !(result.colour_score > 0.5))
    return Refusal{RefusalCode::no_pattern,
                   fmt::format("colour score {:.2f} is not above 0.5", result.colour_score)};
  return result;
}

}  // namespace alea
