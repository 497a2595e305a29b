#pragma once

#include <vector>

namespace alea {

/// The median of at least one number; of an even count the upper of the two in the middle.
double median(std::vector<double> values);

}  // namespace alea
