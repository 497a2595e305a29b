#pragma once

#include "alea/pipeline/die_pair.hpp"
#include "alea/pipeline/registration.hpp"

namespace alea {

/// What a result says of the die.
DieReport die_report(const DiePair& pair, const DieTransform& transform, bool calibrated,
                     const DieRegistrationOptions& options);

/// Warnings about the size that the options give, against what the facets' extents show.
std::vector<std::string> size_warnings(const DiePair& pair, const DieRegistrationOptions& options);

}  // namespace alea
