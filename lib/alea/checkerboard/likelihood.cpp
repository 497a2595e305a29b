#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "alea/checkerboard/board_checks.hpp"
#include "alea/checkerboard/board_crop.hpp"
#include "alea/checkerboard/board_sighting.hpp"
#include "alea/checkerboard/fitted_board.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"

namespace alea {
namespace {

double spacing_on(const BoardSpec& board, const std::vector<Eigen::Vector2d>& places,
                  const BoardPose2& pose) {
  std::size_t inside = 0;
  const OnBoard on_board(pose);
  for (const Eigen::Vector2d& place : places) inside += in_outline(board, on_board(place));
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

/// The candidate's edges, roughly, on the plane of the sighting.
FittedBoard fit_roughly(const Sighting& sighting, const BoardCandidate& candidate,
                        const BoardSpec& board) {
  FittedBoard fitted{sighting.points, sighting.plane, sighting.places, {}, 0};
  fitted.spacing_m = spacing_on(board, fitted.places, candidate.pose);
  BoardFitOptions options = fit_options(board, fitted.spacing_m);
  options.precise = false;
  fitted.fit = fit_board(board, fitted.places, fitted.points.intensity, candidate.pose, options);
  return fitted;
}

/// Every k-th, so that about `most` remain.
void thin_out(std::size_t most, std::vector<std::uint32_t>& on, std::vector<std::uint8_t>& light) {
  const std::size_t stride = std::max<std::size_t>(1, on.size() / most);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < on.size(); i += stride, ++kept) {
    on[kept] = on[i];
    light[kept] = light[i];
  }
  on.resize(kept);
  light.resize(kept);
}

/// The plane through the board's points alone, the places on it and the pose among them.
BoardPose2 renew_plane(const BoardSpec& board, const BoardPose2& pose, bool precise,
                       FittedBoard& fitted) {
  std::vector<std::uint32_t> on;
  std::vector<std::uint8_t> light;
  const double margin_m = 0.02 * board.side_m();  // a beam there measures what lies behind it too
  const OnBoard on_board(pose);
  for (std::uint32_t i = 0; i < fitted.places.size(); ++i) {
    const Eigen::Vector2d at = on_board(fitted.places[i]);
    if (!in_outline(board, at, margin_m)) continue;
    on.push_back(i);
    light.push_back(pattern_sign(board, at) > 0);
  }
  if (on.size() < 12) return pose;
  if (!precise) thin_out(1500, on, light);
  const BoardPlane before = fitted.plane;
  fitted.plane = fit_board_plane(subset(fitted.points, on), light, before.plane);
  // The pose goes on to the new plane's coordinates.
  const Eigen::Vector3d centre = before.anchor + before.axes * pose.centre_m;
  const Eigen::Vector3d along =
      before.axes * Eigen::Vector2d(std::cos(pose.angle_rad), std::sin(pose.angle_rad));
  const Eigen::Vector2d turned = fitted.plane.axes.transpose() * along;
  fitted.places = places_on(fitted.plane, fitted.points);
  return {fitted.plane.axes.transpose() * (centre - fitted.plane.anchor),
          std::atan2(turned.y(), turned.x())};
}

/// From a rough fit: plane and edges in turn, since each helps the other, then the precise fit.
void fit_precisely(const BoardSpec& board, FittedBoard& fitted) {
  const auto& intensity = fitted.points.intensity;
  for (int round = 0; round < 2; ++round) {
    BoardPose2 pose = fitted.fit.pose;
    if (board.columns > 2) pose = best_of_shifts(board, fitted.places, intensity, pose);
    pose = renew_plane(board, pose, round == 1, fitted);
    fitted.spacing_m = spacing_on(board, fitted.places, pose);
    BoardFitOptions options = fit_options(board, fitted.spacing_m);
    options.precise = round == 1;
    fitted.fit = improve_fit(board, fitted.places, intensity, fitted.fit, pose, options);
  }
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

/// One candidate on its sighting.
struct Attempt {
  const Sighting& sighting;
  const BoardCandidate& candidate;
};

Result<BoardMeasurement> measure_candidate(const Attempt& attempt, const BoardSpec& board) {
  FittedBoard fitted = fit_roughly(attempt.sighting, attempt.candidate, board);
  if (auto rough = check_roughly(board, fitted.places, fitted.points.intensity, fitted.fit))
    return *rough;
  fit_precisely(board, fitted);
  // Few that come so far are refused, and each takes about as long as the other.
  std::optional<Refusal> refusal;
  BoardMeasurement measurement;
  parallel_pair([&] { refusal = check(fitted, board); },
                [&] { measurement = described(fitted, board); });
  if (refusal) return *refusal;
  return measurement;
}

/// Each candidate by itself; in their order, whichever thread is the first.
std::vector<Result<BoardMeasurement>> measure_candidates(const std::vector<Sighting>& planes,
                                                         const BoardSpec& board) {
  const double least_gain = BoardSearchOptions::least_gain_share * planes[0].candidates[0].gain;
  std::vector<Attempt> attempts;
  for (const Sighting& sighting : planes)
    for (const BoardCandidate& candidate : sighting.candidates)
      if (candidate.gain >= least_gain) attempts.push_back({sighting, candidate});
  std::vector<Result<BoardMeasurement>> results(attempts.size(), Refusal{});
  parallel_chunks(attempts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) results[k] = measure_candidate(attempts[k], board);
  });
  return results;
}

/// The nearer of two boards if it is nearer by far, nothing if neither is.
std::optional<BoardMeasurement> nearer_by_far(const BoardMeasurement& a, const BoardMeasurement& b,
                                              const Eigen::Vector3d& place) {
  const double to_a = (a.centre_m - place).norm(), to_b = (b.centre_m - place).norm();
  if (to_b < 0.5 * to_a) return b;
  if (to_a < 0.5 * to_b) return a;
  return std::nullopt;
}

}  // namespace

Result<BoardMeasurement> measure_points(const BoardPoints& points, const Eigen::Vector3d& facing,
                                        const BoardOptions& options) {
  const std::vector<Sighting> planes = sightings(points, options, facing);
  if (points.size() < 24 || planes.empty())
    return nothing_there(points, !planes.empty(), options.board);
  std::optional<Refusal> first_refusal;
  std::optional<BoardMeasurement> found;
  for (const Result<BoardMeasurement>& one : measure_candidates(planes, options.board)) {
    if (!one) {
      // A pattern of another size says more than a place without one.
      if (!first_refusal || (first_refusal->code == RefusalCode::no_pattern &&
                             one.refusal().code != RefusalCode::no_pattern))
        first_refusal = one.refusal();
      continue;
    }
    if (!found) {
      found = *one;
      continue;
    }
    const double apart_m = (one->centre_m - found->centre_m).norm();
    if (apart_m < 0.5 * options.board.side_m()) continue;
    found = nearer_by_far(*found, *one, points.origin);
    if (!found)
      return Refusal{RefusalCode::ambiguous_target,
                     fmt::format("two boards about as near, {:.3f} m apart; give --near more "
                                 "closely",
                                 apart_m)};
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
