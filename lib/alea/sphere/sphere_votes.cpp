#include "alea/sphere/sphere_votes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "alea/core/parallel.hpp"

namespace alea {
namespace {

constexpr double least_points = 6;     // in a window, for a normal
constexpr double least_width = 0.05;   // middle over largest variance: below, a line
constexpr double most_depth = 0.25;    // smallest over middle variance: above, no surface
constexpr double mean_sagitta = 0.08;  // of a window of one radius, in radii

/// Count, sum and second moments about the grid's origin plus a cell centre.
struct CellMoments {
  double count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();

  void add(const CellMoments& other, const Eigen::Vector3d& shift) {
    count += other.count;
    const Eigen::Vector3d moved = other.sum + other.count * shift;
    squares += other.squares + other.sum * shift.transpose() + shift * moved.transpose();
    sum += moved;
  }
};

/// Moments of each cell about its first point.
std::vector<CellMoments> moments_of(const SurfaceCells& cells,
                                    std::span<const Eigen::Vector3d> points) {
  std::vector<CellMoments> moments(cells.size());
  parallel_chunks(cells.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const Eigen::Vector3d& about = points[cells.order[cells.first[c]]];
      for (std::uint32_t k = cells.first[c]; k < cells.first[c + 1]; ++k) {
        const Eigen::Vector3d d = points[cells.order[k]] - about;
        moments[c].sum += d;
        moments[c].squares += d * d.transpose();
        moments[c].count += 1;
      }
    }
  });
  return moments;
}

struct Vote {
  bool valid = false;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
};

/// `about` is the point that the moments refer to, relative to the scanner.
Vote vote_of(const CellMoments& window, const Eigen::Vector3d& about, double radius_m) {
  if (window.count < least_points) return {};
  const Eigen::Vector3d mean = window.sum / window.count;
  const Eigen::Matrix3d covariance = window.squares / window.count - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Eigen::Vector3d variance = solver.eigenvalues();
  if (variance[1] < least_width * variance[2] || variance[0] > most_depth * variance[1]) return {};
  const Eigen::Vector3d place = about + mean;
  Eigen::Vector3d inward = solver.eigenvectors().col(0);
  if (inward.dot(place) < 0) inward = -inward;  // away from the scanner
  return {true, place + (1 - mean_sagitta) * radius_m * inward};
}

/// Votes relative to the scanner, in the order of the cells.
std::vector<Eigen::Vector3d> votes_of(const SurfaceCells& cells,
                                      std::span<const Eigen::Vector3d> points,
                                      const Eigen::Vector3d& scanner_position_m, double radius_m) {
  const std::vector<CellMoments> moments = moments_of(cells, points);
  std::vector<Vote> votes(cells.size());
  parallel_chunks(cells.size(), 4096, [&](std::size_t begin, std::size_t end) {
    WindowWalk walk(cells.keys, begin);
    for (std::size_t c = begin; c < end; ++c) {
      const Eigen::Vector3d& about = points[cells.order[cells.first[c]]];
      CellMoments window;
      for (const CellRun& run : walk.next())
        for (std::size_t other = run.begin; other < run.end; ++other)
          window.add(moments[other], points[cells.order[cells.first[other]]] - about);
      votes[c] = vote_of(window, about - scanner_position_m, radius_m);
    }
  });
  std::vector<Eigen::Vector3d> centres;
  for (const Vote& vote : votes)
    if (vote.valid) centres.push_back(vote.centre_m);
  return centres;
}

}  // namespace

std::vector<CentreCandidate> vote_for_centres(const SurfaceCells& cells,
                                              std::span<const Eigen::Vector3d> points,
                                              const Eigen::Vector3d& scanner_position_m,
                                              double radius_m, int min_votes) {
  const std::vector<Eigen::Vector3d> votes = votes_of(cells, points, scanner_position_m, radius_m);
  const SurfaceCells bins = surface_cells(votes, Eigen::Vector3d::Zero(), radius_m / 3);
  std::vector<int> in_window(bins.size());
  std::vector<CentreCandidate> candidates;
  WindowWalk counting(bins.keys, 0);
  for (int& count : in_window)
    for (const CellRun& run : counting.next())
      count += static_cast<int>(bins.first[run.end] - bins.first[run.begin]);
  WindowWalk judging(bins.keys, 0);
  for (std::size_t b = 0; b < bins.size(); ++b) {
    const CellWindow window = judging.next();
    if (in_window[b] < min_votes) continue;
    bool highest = true;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const CellRun& run : window) {
      for (std::size_t other = run.begin; other < run.end; ++other)
        highest = highest && (in_window[other] < in_window[b] ||
                              (in_window[other] == in_window[b] && other >= b));
      for (std::uint32_t k = bins.first[run.begin]; k < bins.first[run.end]; ++k)
        sum += votes[bins.order[k]];
    }
    if (highest) candidates.push_back({scanner_position_m + sum / in_window[b], in_window[b]});
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const CentreCandidate& a, const CentreCandidate& b) { return a.votes > b.votes; });
  return candidates;
}

}  // namespace alea
