#pragma once

#include <span>
#include <vector>

#include "alea/checkerboard/board_expectation.hpp"

namespace alea {

struct BoardSample {
  Eigen::Vector2d place;
  double intensity;
};

/// Fills covariance and bound of a fit for the parameters in `which`. Covariance: Huber's sandwich
/// S^-1 (sum psi^2 J J') S^-1 with S = mean(psi') sum J J' / variance (Huber 1967); every psi^2 is
/// divided by one minus its point's leverage, since a fit bends towards the points that it hangs on
/// (MacKinnon and White 1985, HC2, doi 10.1016/0304-4076(85)90158-7).
void add_precision(const BoardExpectation& expectation, std::span<const BoardSample> samples,
                   const std::vector<int>& which, BoardFit& fit);

}  // namespace alea
