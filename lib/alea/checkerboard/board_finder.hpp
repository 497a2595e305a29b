#pragma once

#include <vector>

#include "alea/checkerboard/measurement.hpp"

namespace alea {

/// All boards of the given size in a scan, best first: by colour score times the points that the
/// fit used. A saddle of intensities - two opposite quadrants dark, two light, about a point of a
/// surface - is what every inner corner of a checkerboard shows from any side: places where the
/// second harmonic of the intensities around them is strong are measured by likelihood, strongest
/// first. Refuses as no_target; throws as measure_by_likelihood.
Result<std::vector<BoardMeasurement>> find_boards(const Cloud& cloud, const BoardOptions& options);

}  // namespace alea
