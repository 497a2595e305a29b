#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/facet/facet_fit.hpp"

namespace alea {

/// All points inside the borders of fitted facets whose distance from the facet's plane is at most
/// `depth_m`: also those in pips that are deeper than the gate of the fit. Indices into the cloud,
/// ascending, facets in the order of the fits.
std::array<std::vector<std::uint32_t>, 3> facet_surface(const Cloud& cloud, const FacetFits& facets,
                                                        const FacetFitOptions& options,
                                                        double depth_m);

}  // namespace alea
