#pragma once

#include <array>
#include <optional>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/die/die_shape.hpp"

namespace alea {

/// The pips of three facets that meet in a corner, counterclockwise about the corner as seen from
/// outside (outward normals with positive determinant). Zero stands for a facet that was not read.
using PipTriple = std::array<int, 3>;

/// The hand of a die that shows these pips: empty unless they are three facets of one corner of a
/// die whose opposite facets sum to seven.
std::optional<Chirality> hand_of(const PipTriple& pips);

/// The 24 triples that a die of this hand can show at a given corner, in lexicographic order.
std::vector<PipTriple> orientations_of(Chirality chirality);

/// The triples of a die of this hand that agree with at least `agreeing` of the counts.
std::vector<PipTriple> orientations_agreeing(const PipTriple& counts, int agreeing,
                                             Chirality chirality);

/// The paper's rule (section 2.1: three facets scanned, the pips of two recognised): two facets
/// that agree with one orientation suffice, chirality known, opposite facets sum to seven. Refuses
/// as pips_unreadable with fewer than two counts, as chirality where all three fit a die of the
/// other hand, as pips_ambiguous where no orientation or several agree with two counts. One misread
/// among three counts is always refused; one misread among two is accepted silently in 60 % of
/// cases.
Result<PipTriple> resolve_any_two(const PipTriple& counts, Chirality chirality);

/// All three counts must agree with one orientation. With no chirality given, either hand will do.
/// No single misread passes.
Result<PipTriple> resolve_all_three(const PipTriple& counts, std::optional<Chirality> chirality);

}  // namespace alea
