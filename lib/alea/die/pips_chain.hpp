#pragma once

#include <Eigen/Core>
#include <vector>

#include "alea/die/facet_image.hpp"

namespace alea {

/// A picture, row by row from the facet's corner: columns along the facet's first edge.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<float> pixels;  ///< NaN where nothing was measured
  double metres_per_pixel = 0;
};

struct PipChainOptions {
  double pixel_m = 0;             ///< 0: from the facet's size and the spacing of its points
  double low_pass_sd_pixels = 1;  ///< Gaussian
  double border = 0.05;           ///< share of the edge left out at each side
  double smallest_pip = 0.08;     ///< diameter of a cluster that counts, share of the edge
  double largest_pip = 0.32;
};

/// The stages of the paper's Figure 6 for one facet.
struct PipChainStages {
  GreyImage raster;    ///< mean intensity of the points in each pixel
  GreyImage smoothed;  ///< low-passed, gaps filled
  GreyImage binary;    ///< 1 on the rarer side of Otsu's threshold
  GreyImage edges;     ///< 1 on Canny's edges of the binary picture
  GreyImage clusters;  ///< 1, 2, ... on the clusters that count, 0 on others, NaN off the edges
};

struct PipChainResult {
  int count = 0;                           ///< pips, 0 where nothing or more than six were found
  std::vector<Eigen::Vector2d> centres_m;  ///< of the clusters that count, as uv_m
  PipChainStages stages;
};

/// Counts the pips of one facet as the paper does (section 2.2, Figure 6): project to the facet,
/// rasterise, low-pass, binarise, detect edges, cluster. The paper names no threshold; ours: pixels
/// of at least 1.1 mean point spacings, Otsu's threshold (Otsu 1979) within the border, the rarer
/// class as pips, Canny (1986) on the binary picture, DBSCAN with a radius of 1.5 pixels and 3
/// points, and clusters as wide as a pip may be. Fewer than 30 points or equal intensities give a
/// count of 0 and empty stages. The result does not depend on the order of the points. Throws
/// Error(usage) where the edges are not positive.
PipChainResult count_pips(const FacetImageInput& image, const PipChainOptions& options = {});

}  // namespace alea
