#pragma once

#include <string>

#include "alea/core/cloud.hpp"
#include "alea/report/drawn_die.hpp"
#include "alea/report/picture.hpp"

namespace alea {

/// The die as the scanner saw it and its three facets: which points a fit used, and which the
/// border trim, the pip masks and the gate left out.
Picture facets_picture(const Cloud& cloud, const DrawnDie& die, const std::string& scan_name);

/// Figure 6 of Chan et al. 2023 for the three facets, one row each: the stages of the published
/// chain with its count, and the reader's decision drawn over the raster.
Picture pips_picture(const Cloud& cloud, const DrawnDie& die);

}  // namespace alea
