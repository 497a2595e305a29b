#pragma once

#include <array>
#include <vector>

#include "alea/cloud/neighbours.hpp"
#include "alea/core/cloud.hpp"

namespace alea {

/// Three histograms of 11 bins, each scaled to a sum of 100.
using Fpfh = std::array<float, 33>;

/// How the histograms of a point's neighbours are added to its own.
enum class FpfhWeights {
  inverse_distance,  ///< to its own, the mean of the others' by radius / distance: their Equation 2
  inverse_square     ///< the others' alone, by 1 / distance^2, as in the Point Cloud Library
};

/// Fast point feature histograms at the points of a cloud with normals: how the normals about a
/// point turn against its own, the same for any pose of the cloud. Rusu, Blodow, Beetz 2009, Fast
/// point feature histograms (FPFH) for 3D registration, ICRA, doi 10.1109/ROBOT.2009.5152473.
/// `index` is of the cloud's positions. Parallel, the same bits for any thread count.
std::vector<Fpfh> fpfh(const Cloud& cloud, const NeighbourIndex& index, double radius_m,
                       FpfhWeights weights = FpfhWeights::inverse_distance);

}  // namespace alea
