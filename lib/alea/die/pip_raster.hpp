#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "alea/die/facet_image.hpp"
#include "alea/die/pip_layout.hpp"

namespace alea {

/// The intensity of one facet in square cells, freed of its level and its slope along both edges.
struct PipRaster {
  int cells = 0;                         ///< along each edge
  std::vector<std::int32_t> cell_index;  ///< of the full grid, row by row: -1 where no point fell
  /// Per cell that holds points: place as a share of the edges, weight, residual of the mean level.
  std::vector<Eigen::Vector2d> place;
  Eigen::VectorXd weight;
  Eigen::VectorXd residual;
  /// Level and slopes, orthonormal under the weights: 3 x cells.
  Eigen::Matrix<double, 3, Eigen::Dynamic> basis;
  double residual_square_sum = 0;  ///< weighted
};

struct PipRasterOptions {
  int cells = 48;        ///< along each edge
  double border = 0.06;  ///< share of the edge left out at each side: mixed pixels, rounded edges
  double weight_cap = 8.0;  ///< points from which on a cell's weight no longer grows: texture and
                            ///< template error then outweigh the noise of a point
};

/// Bins the points; the result does not depend on their order. Fewer than 12 cells with points, or
/// no variation of intensity, give an empty raster, which carries no evidence.
PipRaster rasterise_pips(const FacetImageInput& image, const PipRasterOptions& options = {});

/// What the blurred pips of one lattice look like.
struct PipTemplateShape {
  double offset = 0.25;                               ///< share of the edge
  double radius = 0.09;                               ///< share of the shorter edge
  double blur_m = 0;                                  ///< one sd, all round
  Eigen::Vector2d smear_m = Eigen::Vector2d::Zero();  ///< one sd, along a direction in the facet
  /// Of an oblong facet: the same spacing both ways, a share of the shorter edge; else a share of
  /// each.
  bool square = false;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< of the lattice, share of the edges
};

/// The evidence of the nine places: normal equations of their amplitudes, level and slopes
/// eliminated.
struct PipPlaces {
  Eigen::Matrix<double, pip_places, pip_places> gram;
  Eigen::Matrix<double, pip_places, 1> projection;
};

PipPlaces correlate_places(const PipRaster& raster, const FacetImageInput& image,
                           const PipTemplateShape& shape);

/// How much of a facet's structure (the covariance of neighbouring cells, which point noise does
/// not share) is left when the pips are taken away.
struct PipLackOfFit {
  double before = 0;  ///< mean product of neighbouring residuals, level and slopes eliminated
  double after = 0;   ///< the same with the best-fitting pips of the pattern subtracted
  double noise = 0;   ///< standard error of `after` for independent cells
};

/// Where the lattice really sits: the shift within 4 % of the edges, in steps of 1 %, that explains
/// most of the facet with this pattern. Corners and printed pips are both a little off.
Eigen::Vector2d fit_shift(const PipRaster& raster, const FacetImageInput& image,
                          PipTemplateShape shape, const PipPattern& pattern);

PipLackOfFit lack_of_fit(const PipRaster& raster, const FacetImageInput& image,
                         const PipTemplateShape& shape, const PipPattern& pattern);

}  // namespace alea
