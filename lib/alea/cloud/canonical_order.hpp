#pragma once

#include "alea/core/cloud.hpp"

namespace alea {

/// The same cloud with its points sorted by x, y, z, then every other field. Whatever is computed
/// from the sorted cloud cannot depend on the order of the points in the file.
Cloud canonical_order(const Cloud& cloud);

/// A cloud in canonical order without the points that equal the one before in position, intensity
/// and colour: merged files hold them, and they say nothing anew.
Cloud without_duplicates(Cloud sorted);

}  // namespace alea
