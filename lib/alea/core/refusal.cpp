#include "alea/core/refusal.hpp"

namespace alea {

const char* to_string(RefusalCode code) {
  switch (code) {
    case RefusalCode::no_die:
      return "no_die";
    case RefusalCode::too_few_facets:
      return "too_few_facets";
    case RefusalCode::pips_unreadable:
      return "pips_unreadable";
    case RefusalCode::pips_ambiguous:
      return "pips_ambiguous";
    case RefusalCode::chirality:
      return "chirality";
    case RefusalCode::mirrored:
      return "mirrored";
    case RefusalCode::dihedral:
      return "dihedral";
    case RefusalCode::size_mismatch:
      return "size_mismatch";
    case RefusalCode::too_few_points:
      return "too_few_points";
    case RefusalCode::one_shared_facet:
      return "one_shared_facet";
    case RefusalCode::unobservable:
      return "unobservable";
    case RefusalCode::ambiguous_target:
      return "ambiguous_target";
    case RefusalCode::no_target:
      return "no_target";
    case RefusalCode::collinear:
      return "collinear";
    case RefusalCode::no_match:
      return "no_match";
    case RefusalCode::no_plane:
      return "no_plane";
    case RefusalCode::no_pattern:
      return "no_pattern";
    case RefusalCode::low_overlap:
      return "low_overlap";
    case RefusalCode::no_convergence:
      return "no_convergence";
  }
  return "unknown";
}

}  // namespace alea
