#include "alea/die/pip_raster.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace alea {
namespace {

constexpr int levels = 4096;  // of intensity, within its range

struct CellSums {
  std::vector<std::uint32_t> count;
  std::vector<std::uint64_t> level_sum;  // integers, so that the order of points does not matter
};

CellSums bin_points(const FacetImageInput& image, const PipRasterOptions& options,
                    IntensityRange range) {
  const auto cells = static_cast<std::size_t>(options.cells);
  CellSums sums{std::vector<std::uint32_t>(cells * cells, 0),
                std::vector<std::uint64_t>(cells * cells, 0)};
  const double scale = (levels - 1) / (range.high - range.low);
  const double from = options.border, to = 1 - options.border;
  for (std::size_t i = 0; i < image.uv_m.size(); ++i) {
    const double x = image.uv_m[i].x() / image.edge_u_m, y = image.uv_m[i].y() / image.edge_v_m;
    const float value = image.intensity[i];
    if (!(x > from && x < to && y > from && y < to) || !std::isfinite(value)) continue;
    const double level = std::clamp((value - range.low) * scale, 0.0, levels - 1.0);
    const std::size_t cell = static_cast<std::size_t>(y * options.cells) * cells +
                             static_cast<std::size_t>(x * options.cells);
    ++sums.count[cell];
    sums.level_sum[cell] += static_cast<std::uint64_t>(level + 0.5);
  }
  return sums;
}

/// Level and slopes along both edges, orthonormal under the weights, and what they leave.
bool eliminate_level_and_slopes(PipRaster& raster, const Eigen::VectorXd& mean) {
  const Eigen::Index cells = raster.weight.size();
  Eigen::Matrix<double, 3, Eigen::Dynamic> trend(3, cells);
  for (Eigen::Index i = 0; i < cells; ++i)
    trend.col(i) << 1, raster.place[i].x() - 0.5, raster.place[i].y() - 0.5;
  Eigen::Matrix3d normal = trend * raster.weight.asDiagonal() * trend.transpose();
  normal.diagonal().array() += 1e-9 * normal(0, 0);  // a single row of cells has no second slope
  raster.basis = Eigen::LLT<Eigen::Matrix3d>(normal).matrixL().solve(trend);
  const Eigen::Vector3d fit = raster.basis * raster.weight.cwiseProduct(mean);
  raster.residual = mean - raster.basis.transpose() * fit;
  raster.residual_square_sum = raster.weight.dot(raster.residual.cwiseAbs2());
  return raster.residual_square_sum > 1e-9 * raster.weight.sum();
}

/// Probability that a blurred disc covers a point, at z blur widths inside its rim: the logistic
/// curve that follows the normal distribution within 0.01.
double coverage(double z) {
  return 1 / (1 + std::exp(-1.702 * z));
}

/// The five nodes of Gauss-Hermite quadrature for a standard normal.
constexpr std::array<double, 5> node_at{0, 1.355626179974266, -1.355626179974266, 2.856970013872806,
                                        -2.856970013872806};
constexpr std::array<double, 5> node_weight{8.0 / 15, 0.2220759220056126, 0.2220759220056126,
                                            0.01125741132772068, 0.01125741132772068};

/// One blurred pip: its value in the cells that it reaches.
struct BlurredPip {
  std::vector<double> value;          // of every cell with points, zero out of reach
  std::vector<Eigen::Index> touched;  // ascending within each node
};

/// Adds a disc about `centre_m` (metres from the corner) blurred all round, times `share`.
void add_disc(const PipRaster& raster, const Eigen::Vector2d& centre_m,
              const Eigen::Vector2d& edges_m, const PipTemplateShape& shape, double share,
              BlurredPip& pip) {
  const double radius_m = shape.radius * edges_m.minCoeff();
  const double reach_m = radius_m + 4 * shape.blur_m;
  const Eigen::Vector2d per_cell = edges_m / raster.cells;
  const auto cell_of = [&](double at_m, Eigen::Index axis) {
    return std::clamp(static_cast<int>(std::floor(at_m / per_cell[axis])), 0, raster.cells - 1);
  };
  const int column_end = cell_of(centre_m.x() + reach_m, 0);
  const int row_end = cell_of(centre_m.y() + reach_m, 1);
  for (int row = cell_of(centre_m.y() - reach_m, 1); row <= row_end; ++row)
    for (int column = cell_of(centre_m.x() - reach_m, 0); column <= column_end; ++column) {
      const Eigen::Index i = raster.cell_index[row * raster.cells + column];
      if (i < 0) continue;
      const double distance = (raster.place[i].cwiseProduct(edges_m) - centre_m).norm();
      if (distance >= reach_m) continue;
      if (pip.value[i] == 0) pip.touched.push_back(i);
      pip.value[i] += share * coverage((radius_m - distance) / shape.blur_m);
    }
}

BlurredPip blurred_pip(const PipRaster& raster, const Eigen::Vector2d& place,
                       const Eigen::Vector2d& edges_m, const PipTemplateShape& shape) {
  BlurredPip pip{std::vector<double>(raster.place.size(), 0.0), {}};
  const Eigen::Vector2d centre_m = place.cwiseProduct(edges_m);
  if (shape.smear_m.norm() <= shape.blur_m) {
    add_disc(raster, centre_m, edges_m, shape, 1, pip);
    return pip;
  }
  for (std::size_t node = 0; node < node_at.size(); ++node)
    add_disc(raster, centre_m + node_at[node] * shape.smear_m, edges_m, shape, node_weight[node],
             pip);
  return pip;
}

Eigen::Vector2d lattice_place(int place, const PipTemplateShape& shape,
                              const Eigen::Vector2d& edges_m) {
  Eigen::Vector2d offset(shape.offset, shape.offset);
  if (shape.square) offset = shape.offset * edges_m.minCoeff() * edges_m.cwiseInverse();
  return pip_place(place, offset) + shape.shift;
}

/// The pips of a pattern, level and slopes eliminated, one value for each cell.
Eigen::VectorXd pattern_values(const PipRaster& raster, const FacetImageInput& image,
                               const PipTemplateShape& shape, const PipPattern& pattern) {
  const Eigen::Vector2d edges_m(image.edge_u_m, image.edge_v_m);
  Eigen::VectorXd pips = Eigen::VectorXd::Zero(raster.weight.size());
  for (int place = 0; place < pip_places; ++place) {
    if (!pattern.has(place)) continue;
    const BlurredPip pip =
        blurred_pip(raster, lattice_place(place, shape, edges_m), edges_m, shape);
    for (const Eigen::Index i : pip.touched) pips[i] += pip.value[i];
  }
  return pips - raster.basis.transpose() * (raster.basis * raster.weight.cwiseProduct(pips));
}

}  // namespace

PipRaster rasterise_pips(const FacetImageInput& image, const PipRasterOptions& options) {
  constexpr std::size_t fewest_cells = 12;
  const IntensityRange range = intensity_range(image.intensity);
  if (!(range.high > range.low)) return {};
  const CellSums sums = bin_points(image, options, range);

  PipRaster raster;
  raster.cells = options.cells;
  raster.cell_index.assign(sums.count.size(), -1);
  std::vector<double> weights, means;
  for (std::size_t cell = 0; cell < sums.count.size(); ++cell) {
    if (sums.count[cell] == 0) continue;
    const auto cells = static_cast<std::size_t>(options.cells);
    raster.cell_index[cell] = static_cast<std::int32_t>(raster.place.size());
    raster.place.emplace_back((cell % cells + 0.5) / options.cells,
                              (cell / cells + 0.5) / options.cells);
    weights.push_back(std::min<double>(sums.count[cell], options.weight_cap));
    means.push_back(static_cast<double>(sums.level_sum[cell]) / sums.count[cell] / (levels - 1));
  }
  if (raster.place.size() < fewest_cells) return {};
  raster.weight = Eigen::Map<const Eigen::VectorXd>(weights.data(), weights.size());
  const Eigen::VectorXd mean = Eigen::Map<const Eigen::VectorXd>(means.data(), means.size());
  if (!eliminate_level_and_slopes(raster, mean)) return {};
  return raster;
}

PipPlaces correlate_places(const PipRaster& raster, const FacetImageInput& image,
                           const PipTemplateShape& shape) {
  const Eigen::Vector2d edges_m(image.edge_u_m, image.edge_v_m);
  std::vector<BlurredPip> pips;
  for (int place = 0; place < pip_places; ++place)
    pips.push_back(blurred_pip(raster, lattice_place(place, shape, edges_m), edges_m, shape));
  PipPlaces places;
  places.gram.setZero();
  places.projection.setZero();
  Eigen::Matrix<double, 3, pip_places> trend = Eigen::Matrix<double, 3, pip_places>::Zero();
  for (int a = 0; a < pip_places; ++a)
    for (const Eigen::Index i : pips[a].touched) {
      const double weighted = raster.weight[i] * pips[a].value[i];
      places.projection[a] += weighted * raster.residual[i];
      trend.col(a) += weighted * raster.basis.col(i);
      for (int b = 0; b < pip_places; ++b) places.gram(a, b) += weighted * pips[b].value[i];
    }
  places.gram -= trend.transpose() * trend;
  return places;
}

Eigen::Vector2d fit_shift(const PipRaster& raster, const FacetImageInput& image,
                          PipTemplateShape shape, const PipPattern& pattern) {
  constexpr int steps = 4;
  constexpr double step = 0.01;
  for (int axis = 0; axis < 2; ++axis) {
    double best = 0, best_explained = -1;
    for (int i = -steps; i <= steps; ++i) {
      shape.shift[axis] = i * step;
      const Eigen::VectorXd pips = pattern_values(raster, image, shape, pattern);
      const Eigen::VectorXd weighted = raster.weight.cwiseProduct(pips);
      const double projection = weighted.dot(raster.residual), square = weighted.dot(pips);
      const double explained = square > 0 ? projection * projection / square : 0;
      if (explained <= best_explained) continue;
      best = shape.shift[axis];
      best_explained = explained;
    }
    shape.shift[axis] = best;
  }
  return shape.shift;
}

PipLackOfFit lack_of_fit(const PipRaster& raster, const FacetImageInput& image,
                         const PipTemplateShape& shape, const PipPattern& pattern) {
  const Eigen::VectorXd pips = pattern_values(raster, image, shape, pattern);
  const Eigen::VectorXd weighted = raster.weight.cwiseProduct(pips);
  const Eigen::VectorXd left =
      raster.residual - pips * (weighted.dot(raster.residual) / weighted.dot(pips));

  PipLackOfFit fit;
  int pairs = 0;
  for (int row = 0; row + 1 < raster.cells; ++row)
    for (int column = 0; column + 1 < raster.cells; ++column) {
      const int cell = row * raster.cells + column;
      const Eigen::Index i = raster.cell_index[cell];
      for (const int step : {1, raster.cells}) {
        const Eigen::Index j = raster.cell_index[cell + step];
        if (i < 0 || j < 0) continue;
        fit.before += raster.residual[i] * raster.residual[j];
        fit.after += left[i] * left[j];
        ++pairs;
      }
    }
  if (pairs == 0) return fit;
  fit.before /= pairs;
  fit.after /= pairs;
  fit.noise = left.squaredNorm() / static_cast<double>(left.size()) / std::sqrt(pairs);
  return fit;
}

}  // namespace alea
