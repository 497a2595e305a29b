#pragma once

#include <string>

namespace alea {

/// Why data cannot support a result. The names are part of the JSON contract: see to_string.
enum class RefusalCode {
  no_die,            ///< no three mutually near-orthogonal, close planes of the right size
  too_few_facets,    ///< fewer than three facets of the die in a scan
  pips_unreadable,   ///< the facets carry no readable pips (a blank cube)
  pips_ambiguous,    ///< two orientations explain the pips about as well
  chirality,         ///< a die of the other hand in both scans
  mirrored,          ///< the die's hand differs between the scans
  dihedral,          ///< two facets meet more than 20 deg from a right angle
  size_mismatch,     ///< the die's size is more than 15 % from the given edge
  too_few_points,    ///< a facet or target has too few points to fit
  one_shared_facet,  ///< one shared facet and neither a shape nor a tilt prior
  unobservable,      ///< a parameter that the result needs is not determined by the data
  ambiguous_target,  ///< several targets fit about as well
  no_target,         ///< no sphere or checkerboard found
  collinear,         ///< target centres on one line
  no_match,          ///< the targets or planes of the two scans do not match
  no_plane,          ///< no plane where the target should be
  no_pattern,        ///< a plane without the checkerboard's pattern
  low_overlap,       ///< too little common surface
  no_convergence     ///< the iteration did not settle
};

/// The code as it stands in JSON, e.g. "too_few_facets".
const char* to_string(RefusalCode code);

struct Refusal {
  RefusalCode code;
  std::string message;  ///< one line: what was found, what is needed, what to do
};

}  // namespace alea
