#pragma once

#include "alea/pipeline/register_die.hpp"

namespace alea {

/// The default registration of a die whose edge was measured.
inline DieRegistrationOptions with_edge(double edge_m) {
  DieRegistrationOptions options;
  options.edge_m = edge_m;
  return options;
}

}  // namespace alea
