#include "experiments/die/acceptance.hpp"

namespace alea::acceptance {

std::vector<Topic> die_topics() {
  return {
      {"die", "bound_tables", "Fisher bounds against the tables of the die study",
       run_bound_tables},
      {"bound", "ranges", "range at which the 10 m ring reaches 2.5 mm at 0.3 mrad",
       run_bound_ranges},
      {"bound", "ranks", "directions that a set of stations leaves open", run_bound_ranks},
      {"die", "pips", "pips read by the counting chain and by likelihood, against the range",
       run_pips},
  };
}

}  // namespace alea::acceptance
