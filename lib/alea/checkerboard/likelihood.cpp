#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "alea/checkerboard/board_checks.hpp"
#include "alea/checkerboard/board_crop.hpp"
#include "alea/checkerboard/fitted_board.hpp"
#include "alea/core/error.hpp"

namespace alea {
namespace {

/// A plane of the crop with the best places of the board on it.
struct Sighting {
  BoardPoints points;  ///< of the plane
  BoardPlane plane;
  std::vector<Eigen::Vector2d> places;
  std::vector<BoardCandidate> candidates;
};

std::vector<std::uint8_t> classes_by_otsu(const std::vector<float>& intensity) {
  const double threshold = otsu_threshold(intensity);
  std::vector<std::uint8_t> light(intensity.size());
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = intensity[i] > threshold;
  return light;
}

/// Points whose ray passes the plane within six standard deviations of their class.
BoardPoints near_plane(const BoardPoints& points, const BoardPlane& plane) {
  const double reach_m = 6 * std::max(plane.range_sd_m[0], plane.range_sd_m[1]);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const double off = std::abs(plane.plane.signed_distance(points.positions[i]));
    const double cosine =
        points.rays.empty() ? 1 : std::abs(plane.plane.normal.dot(points.rays[i]));
    if (off <= reach_m * std::max(cosine, 0.03)) kept.push_back(i);
  }
  return subset(points, kept);
}

Sighting sight(const BoardPoints& points, const RoughPlane& rough, const BoardOptions& options,
               const Eigen::Vector3d& facing) {
  Sighting sighting;
  const BoardPoints members = subset(points, rough.members);
  const Plane start = rough.plane.signed_distance(facing) < 0 ? rough.plane.flipped() : rough.plane;
  sighting.plane = fit_board_plane(members, classes_by_otsu(members.intensity), start);
  sighting.points = near_plane(points, sighting.plane);
  sighting.places = places_on(sighting.plane, sighting.points);
  BoardSearchOptions search;
  search.about_m = -(sighting.plane.axes.transpose() * sighting.plane.anchor);
  search.radius_m = options.search_sides * options.board.side_m();
  sighting.candidates =
      search_board(options.board, sighting.places, sighting.points.intensity, search);
  return sighting;
}

/// Planes one after the other, each without the points of those before; best pattern first.
std::vector<Sighting> sightings(const BoardPoints& points, const BoardOptions& options,
                                const Eigen::Vector3d& facing) {
  constexpr int most_planes = 4;
  std::vector<Sighting> found;
  BoardPoints rest = points;
  for (int k = 0; k < most_planes; ++k) {
    const auto rough = find_rough_plane(rest, options.board.side_m());
    if (!rough || rough->members.size() < 12) break;
    Sighting sighting = sight(rest, *rough, options, facing);
    if (!sighting.candidates.empty()) found.push_back(std::move(sighting));
    std::vector<std::uint32_t> left;
    for (std::uint32_t i = 0, m = 0; i < rest.size(); ++i) {
      if (m < rough->members.size() && rough->members[m] == i)
        ++m;
      else
        left.push_back(i);
    }
    if (left.size() < 30 || left.size() < points.size() / 20) break;
    rest = subset(rest, left);
  }
  std::stable_sort(found.begin(), found.end(), [](const Sighting& a, const Sighting& b) {
    return a.candidates[0].gain > b.candidates[0].gain;
  });
  return found;
}

double spacing_on(const BoardSpec& board, const std::vector<Eigen::Vector2d>& places,
                  const BoardPose2& pose) {
  std::size_t inside = 0;
  for (const Eigen::Vector2d& place : places) {
    const Eigen::Vector2d at = on_board(pose, place);
    inside += std::abs(at.x()) <= board.side_m() / 2 && std::abs(at.y()) <= board.height_m() / 2;
  }
  return std::sqrt(board.side_m() * board.height_m() / std::max<double>(1, inside));
}

BoardFitOptions fit_options(const BoardSpec& board, double spacing_m) {
  BoardFitOptions options;
  options.free_cell = board.columns > 2;
  options.free_slope = board.columns > 2;
  options.spacing_m = spacing_m;
  return options;
}

/// The pose among those a cell or two away that the points support best: on a board of many cells
/// a shift by two cells, or one each way, costs one row of cells only.
BoardPose2 best_of_shifts(const BoardSpec& board, const std::vector<Eigen::Vector2d>& places,
                          const std::vector<float>& intensity, const BoardPose2& pose) {
  BoardCandidate best = correlate(board, places, intensity, pose);
  const double c = std::cos(pose.angle_rad), s = std::sin(pose.angle_rad);
  const int turns = board.square() ? 4 : 2;
  for (int dx = -2; dx <= 2; ++dx) {
    for (int dy = -2; dy <= 2; ++dy) {
      for (int turn = 0; turn < turns; ++turn) {
        const Eigen::Vector2d shift =
            board.cell_m * Eigen::Vector2d(c * dx - s * dy, s * dx + c * dy);
        const BoardPose2 other{pose.centre_m + shift,
                               pose.angle_rad + 2 * std::numbers::pi * turn / turns};
        const BoardCandidate candidate = correlate(board, places, intensity, other);
        if (candidate.correlation > 0 && candidate.gain > best.gain * (1 + 1e-9)) best = candidate;
      }
    }
  }
  return best.pose;
}

/// The plane through the board's points alone, and the edges on it; twice, since each helps the
/// other.
FittedBoard fit_on_plane(const Sighting& sighting, const BoardCandidate& candidate,
                         const BoardSpec& board) {
  FittedBoard fitted;
  fitted.points = sighting.points;
  fitted.plane = sighting.plane;
  fitted.places = sighting.places;
  BoardPose2 pose = candidate.pose;
  for (int round = 0; round < 2; ++round) {
    fitted.spacing_m = spacing_on(board, fitted.places, pose);
    BoardFitOptions options = fit_options(board, fitted.spacing_m);
    options.precise = false;
    const auto& intensity = fitted.points.intensity;
    fitted.fit = round == 0
                     ? fit_board(board, fitted.places, intensity, pose, options)
                     : improve_fit(board, fitted.places, intensity, fitted.fit, pose, options);
    pose = fitted.fit.pose;
    if (board.columns > 2)
      pose = best_of_shifts(board, fitted.places, fitted.points.intensity, pose);
    std::vector<std::uint32_t> on;
    std::vector<std::uint8_t> light;
    const double inside = 1 - 0.04;  // a beam on the outline measures what lies behind it too
    for (std::uint32_t i = 0; i < fitted.places.size(); ++i) {
      const Eigen::Vector2d at = on_board(pose, fitted.places[i]);
      if (std::abs(at.x()) > inside * board.side_m() / 2 ||
          std::abs(at.y()) > inside * board.height_m() / 2)
        continue;
      on.push_back(i);
      light.push_back(pattern_sign(board, at) > 0);
    }
    if (on.size() < 12) return fitted;
    const BoardPlane before = fitted.plane;
    fitted.plane = fit_board_plane(subset(fitted.points, on), light, before.plane);
    // The pose goes on to the new plane's coordinates.
    const Eigen::Vector3d centre = before.anchor + before.axes * pose.centre_m;
    const Eigen::Vector3d along =
        before.axes * Eigen::Vector2d(std::cos(pose.angle_rad), std::sin(pose.angle_rad));
    const Eigen::Vector2d turned = fitted.plane.axes.transpose() * along;
    pose = {fitted.plane.axes.transpose() * (centre - fitted.plane.anchor),
            std::atan2(turned.y(), turned.x())};
    fitted.places = places_on(fitted.plane, fitted.points);
  }
  fitted.fit = improve_fit(board, fitted.places, fitted.points.intensity, fitted.fit, pose,
                           fit_options(board, fitted.spacing_m));
  return fitted;
}

std::optional<Refusal> check(const FittedBoard& fitted, const BoardSpec& board) {
  constexpr std::size_t least_points = 24;
  if (fitted.fit.points < least_points)
    return Refusal{RefusalCode::too_few_points,
                   fmt::format("{} points on the board; at least {} are needed", fitted.fit.points,
                               least_points)};
  if (auto refusal = check_pattern(board, fitted.places, fitted.points.intensity, fitted.fit))
    return refusal;
  if (auto refusal =
          check_size(board, fitted.places, fitted.points.intensity, fitted.fit, fitted.spacing_m))
    return refusal;
  const double sd_m = std::sqrt(fitted.fit.covariance.topLeftCorner<2, 2>().trace());
  if (!(sd_m < 0.25 * board.cell_m))
    return Refusal{RefusalCode::unobservable,
                   fmt::format("the centre is uncertain by {:.4f} m; scan more densely", sd_m)};
  return std::nullopt;
}

Refusal nothing_there(const BoardPoints& points, bool any_plane, const BoardSpec& board) {
  if (points.size() < 24)
    return {RefusalCode::too_few_points,
            fmt::format("{} points within reach of the place; at least 24 are needed: check --near "
                        "and --side",
                        points.size())};
  if (!any_plane)
    return {RefusalCode::no_plane, "no plane in the points near the place; check --near"};
  return {RefusalCode::no_pattern,
          fmt::format("no {} x {} checkerboard on any plane near the place", board.columns,
                      board.rows)};
}

}  // namespace

Result<BoardMeasurement> measure_points(const BoardPoints& points, const Eigen::Vector3d& facing,
                                        const BoardOptions& options) {
  const std::vector<Sighting> planes = sightings(points, options, facing);
  if (points.size() < 24 || planes.empty())
    return nothing_there(points, !planes.empty(), options.board);
  std::optional<Refusal> first_refusal;
  std::optional<BoardMeasurement> found;
  const double side_m = options.board.side_m();
  for (const Sighting& sighting : planes) {
    for (const BoardCandidate& candidate : sighting.candidates) {
      if (candidate.gain < 0.3 * planes[0].candidates[0].gain) break;
      const FittedBoard fitted = fit_on_plane(sighting, candidate, options.board);
      if (auto refusal = check(fitted, options.board)) {
        if (!first_refusal) first_refusal = refusal;
        continue;
      }
      const BoardMeasurement one = described(fitted, options.board);
      if (!found) {
        found = one;
        continue;
      }
      if ((one.centre_m - found->centre_m).norm() < 0.5 * side_m) continue;
      const double here = (found->centre_m - points.origin).norm();
      const double there = (one.centre_m - points.origin).norm();
      if (there < 0.5 * here)
        found = one;
      else if (here >= 0.5 * there)
        return Refusal{RefusalCode::ambiguous_target,
                       fmt::format("two boards about as near, {:.3f} m apart; give --near more "
                                   "closely",
                                   (one.centre_m - found->centre_m).norm())};
    }
  }
  if (found) return *found;
  return first_refusal ? *first_refusal : nothing_there(points, true, options.board);
}

Eigen::Vector3d scanner_of(const Cloud& cloud, const BoardOptions& options) {
  if (options.scanner_position) return *options.scanner_position;
  return cloud.scanner_position.value_or(Eigen::Vector3d::Zero());
}

Result<BoardMeasurement> measure_by_likelihood(const Cloud& cloud, const Eigen::Vector3d& near_m,
                                               const BoardOptions& options) {
  require_valid(options.board);
  if (!cloud.has_intensity())
    throw input_error(
        "the cloud has no intensity or colour; a checkerboard cannot be read from it");
  const Eigen::Vector3d scanner = scanner_of(cloud, options);
  std::optional<Eigen::Vector3d> ray_origin;
  if (options.along_rays) ray_origin = scanner;
  const double reach_m = (options.search_sides + 1) * options.board.side_m();
  const BoardPoints points = board_points(cloud, near_m, reach_m, ray_origin);
  return measure_points(points, scanner - near_m, options);
}

}  // namespace alea
