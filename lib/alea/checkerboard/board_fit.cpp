#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "alea/checkerboard/board_precision.hpp"
#include "alea/core/median.hpp"

namespace alea {
namespace {

using Row = BoardRow;
using Matrix = BoardFit::Covariance;

using Sample = BoardSample;

class Fitter {
 public:
  Fitter(const BoardSpec& board, const BoardFitOptions& options)
      : board_(board), options_(options) {}

  BoardFit run(std::span<const Eigen::Vector2d> places, std::span<const float> intensity,
               const BoardPose2& start) {
    begin(places, intensity, start);
    return rounds(places, intensity);
  }

  BoardFit improve(std::span<const Eigen::Vector2d> places, std::span<const float> intensity,
                   const BoardFit& earlier, const BoardPose2& start) {
    fit_ = earlier;
    fit_.pose = start;
    return rounds(places, intensity);
  }

 private:
  BoardFit rounds(std::span<const Eigen::Vector2d> places, std::span<const float> intensity) {
    for (int round = 0; round < 2; ++round) {
      select(places, intensity);
      if (!options_.precise) thin_out();
      if (samples_.size() < 12) return fit_;
      update_noise();
      iterate(round == 1 && options_.precise);
    }
    if (!options_.precise) return fit_;
    update_noise();
    add_precision(BoardExpectation(board_, fit_, options_), samples_, estimated(), fit_);
    return fit_;
  }

  void begin(std::span<const Eigen::Vector2d> places, std::span<const float> intensity,
             const BoardPose2& start) {
    fit_.pose = start;
    fit_.cell_m = board_.cell_m;
    fit_.blur_m = Eigen::Vector2d::Constant(std::max(0.1 * board_.cell_m, least_blur()));
    std::array<double, 2> sum{}, count{};
    const BoardExpectation expectation(board_, fit_, options_);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector2d at = expectation.on_board(places[i]);
      if (!in_outline(board_, at)) continue;
      const int light = pattern_sign(board_, at) > 0 ? 1 : 0;
      sum[light] += intensity[i];
      count[light] += 1;
    }
    const double dark = sum[0] / std::max(count[0], 1.0);
    const double light = sum[1] / std::max(count[1], 1.0);
    fit_.mean = (dark + light) / 2;
    fit_.half_contrast = (light - dark) / 2;
  }

  double least_blur() const { return std::max(0.25 * options_.spacing_m, 1e-3 * board_.cell_m); }

  void select(std::span<const Eigen::Vector2d> places, std::span<const float> intensity) {
    const double margin_m = std::clamp(2.5 * fit_.blur_m.maxCoeff(),
                                       options_.margin_cells * board_.cell_m, 0.3 * board_.cell_m);
    const BoardExpectation expectation(board_, fit_, options_);
    samples_.clear();
    for (std::size_t i = 0; i < places.size(); ++i)
      if (in_outline(board_, expectation.on_board(places[i]), margin_m))
        samples_.push_back({places[i], intensity[i]});
    fit_.points = samples_.size();
  }

  /// Every k-th point: as many as a hundredth of a cell needs.
  void thin_out() {
    const std::size_t most =
        std::max<std::size_t>(600, 25 * static_cast<std::size_t>(board_.cells()));
    const std::size_t stride = samples_.size() / most;
    if (stride < 2) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < samples_.size(); i += stride) samples_[kept++] = samples_[i];
    samples_.resize(kept);
  }

  /// Intensity noise from points away from edges, jitter from what is left near them.
  void update_noise() {
    const BoardExpectation expectation(board_, fit_, options_);
    std::vector<double> sizes;  // of the residuals away from edges
    sizes.reserve(samples_.size());
    std::vector<std::pair<double, double>> near_edges;  // squared residual, jitter factor
    const double steep = 1e-3 * fit_.half_contrast / board_.cell_m;
    for (const Sample& sample : samples_) {
      const ExpectedIntensity model = expectation.at(expectation.on_board(sample.place));
      const double residual = sample.intensity - model.value;
      if (model.jitter_factor <= steep * steep)
        sizes.push_back(std::abs(residual));
      else
        near_edges.emplace_back(residual * residual, model.jitter_factor);
    }
    const double floor = 1e-4 * std::abs(fit_.half_contrast) + 1e-12;
    const bool few_flat = sizes.size() < 20;
    if (few_flat)
      for (const auto& [squared, factor] : near_edges) sizes.push_back(std::sqrt(squared));
    const double spread = sizes.empty() ? 0 : median(std::move(sizes));
    fit_.intensity_sd = std::max(1.4826 * spread, floor);
    fit_.place_sd_m = 0;
    if (few_flat) return;
    const double noise = fit_.intensity_sd * fit_.intensity_sd;
    for (int round = 0; round < 3; ++round) {  // clipped at three standard deviations
      const double jitter = fit_.place_sd_m * fit_.place_sd_m;
      double top = 0, bottom = 0;
      for (const auto& [squared, factor] : near_edges) {
        const double expected = noise + jitter * factor;
        const double clipped = round == 0 ? squared : std::min(squared, 9 * expected);
        top += (clipped - noise) * factor / (expected * expected);
        bottom += factor * factor / (expected * expected);
      }
      fit_.place_sd_m = bottom > 0 ? std::sqrt(std::max(top / bottom, 0.0)) : 0;
    }
  }

  struct Sums {
    Matrix normal_matrix = Matrix::Zero();
    Row right = Row::Zero();
    double cost = 0;
  };

  /// Huber's weight over the variance; adds the point's part to the cost.
  static double weigh(double residual, double variance, double& cost) {
    const double squared = residual * residual / variance;
    if (squared <= board_huber * board_huber) {
      cost += squared;
      return 1 / variance;
    }
    const double size = std::sqrt(squared);
    cost += board_huber * (2 * size - board_huber);
    return board_huber / (size * variance);
  }

  Sums sums() const {
    return options_.free_cell || options_.free_slope ? sums_over<BoardFit::parameters>()
                                                     : sums_over<7>();
  }

  /// `count`: parameters that are not fixed at most, the first ones.
  template <int count>
  Sums sums_over() const {
    const BoardExpectation expectation(board_, fit_, options_);
    const double flat_variance = fit_.intensity_sd * fit_.intensity_sd;
    Sums total;
    for (const Sample& sample : samples_) {
      const Eigen::Vector2d at = expectation.on_board(sample.place);
      const BlurredPattern::Value pattern = expectation.pattern(at);
      // Points far from every edge touch mean and contrast only.
      if (pattern.flat && !options_.free_slope) {
        const double residual = sample.intensity - expectation.value(at, pattern.value);
        const double weight = weigh(residual, flat_variance, total.cost);
        total.normal_matrix(5, 5) += weight;
        total.normal_matrix(5, 6) += weight * pattern.value;
        total.normal_matrix(6, 6) += weight * pattern.value * pattern.value;
        total.right[5] += weight * residual;
        total.right[6] += weight * residual * pattern.value;
        continue;
      }
      const ExpectedIntensity model = expectation.at(at, pattern);
      const double residual = sample.intensity - model.value;
      const double weight = weigh(residual, intensity_variance(fit_, model), total.cost);
      add_square<count>(model.row, weight, total.normal_matrix);
      total.right.head<count>() += (weight * residual) * model.row.head<count>();
    }
    total.normal_matrix.triangularView<Eigen::StrictlyLower>() = total.normal_matrix.transpose();
    return total;
  }

  /// factor * row * row' of the first parameters, added to the upper triangle.
  template <int count>
  static void add_square(const Row& row, double factor, Matrix& matrix) {
    for (int column = 0; column < count; ++column) {
      const double weighed = factor * row[column];
      for (int k = 0; k <= column; ++k) matrix(k, column) += weighed * row[k];
    }
  }

  std::vector<int> estimated() const {
    std::vector<int> which{0, 1, 2, 3, 4, 5, 6};
    if (options_.free_cell) which.push_back(7);
    if (options_.free_slope) which.insert(which.end(), {8, 9});
    return which;
  }

  BoardFit moved(const Row& step) const {
    BoardFit next = fit_;
    next.pose.centre_m += step.head<2>();
    next.pose.angle_rad += step[2];
    for (int k = 0; k < 2; ++k)
      next.blur_m[k] = std::clamp(fit_.blur_m[k] + step[3 + k], least_blur(), 0.6 * board_.cell_m);
    next.mean += step[5];
    next.half_contrast += step[6];
    next.cell_m = std::clamp(fit_.cell_m + step[7], 0.8 * board_.cell_m, 1.2 * board_.cell_m);
    next.slope += step.tail<2>();
    return next;
  }

  void iterate(bool to_the_end) {
    const int most = to_the_end ? 20 : 4;
    const double least_m = (to_the_end ? 1e-5 : 1e-2) * board_.cell_m;
    const std::vector<int> which = estimated();
    double damping = 1e-4;
    fit_.converged = false;
    Sums now = sums();
    for (int k = 0; k < most; ++k) {
      Eigen::MatrixXd matrix = now.normal_matrix(which, which);
      matrix.diagonal() *= 1 + damping;
      matrix.diagonal().array() += 1e-300;
      Row step = Row::Zero();
      const Eigen::VectorXd right = now.right(which);
      const Eigen::VectorXd solved = matrix.ldlt().solve(right);
      step(which) = solved;
      if (!step.allFinite()) return;
      // Never more than a quarter of a cell at once, so as not to hop to the next edge.
      const double stride = step.head<2>().norm() / (0.25 * board_.cell_m);
      if (stride > 1) step /= stride;
      const BoardFit before = fit_;
      fit_ = moved(step);
      const Sums next = sums();
      // In standard deviations, squared. The variances move with the parameters, so that near the
      // solution of the normal equations the cost decides nothing.
      const double size = step.dot(now.normal_matrix * step);
      const bool settled = size < 1e-5 || (step.head<2>().norm() < least_m &&
                                           std::abs(step[2]) * board_.side_m() < least_m);
      if (next.cost > now.cost && size > 0.01) {
        fit_ = before;
        fit_.converged = settled;
        damping *= 10;
        if (settled || damping > 1e6) return;
        continue;
      }
      damping = std::max(damping * 0.2, 1e-9);
      now = next;
      if (settled) {
        fit_.converged = true;
        return;
      }
    }
  }

  const BoardSpec& board_;
  const BoardFitOptions& options_;
  BoardFit fit_;
  std::vector<Sample> samples_;
};

}  // namespace

BoardFit fit_board(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                   std::span<const float> intensity, const BoardPose2& start,
                   const BoardFitOptions& options) {
  return Fitter(board, options).run(places_m, intensity, start);
}

BoardFit improve_fit(const BoardSpec& board, std::span<const Eigen::Vector2d> places_m,
                     std::span<const float> intensity, const BoardFit& earlier,
                     const BoardPose2& start, const BoardFitOptions& options) {
  return Fitter(board, options).improve(places_m, intensity, earlier, start);
}

}  // namespace alea
