#include "experiments/markerless/acceptance.hpp"

namespace alea::acceptance {

Cell point_cell(const std::string& name, double value, const std::string& unit, const Limit& limit,
                std::uint64_t n) {
  return {name, value, {value, value}, limit, n, unit, Judgement::point};
}

std::vector<Topic> markerless_topics() {
  return {
      {"markerless", "tables", "RMSE ratio of the grid at the truth, fall of the counts",
       run_markerless_tables},
      {"markerless", "paper", "the paper's method on the twins", run_markerless_paper},
      {"markerless", "layouts", "the robust method on layouts drawn from frozen seeds",
       run_markerless_layouts},
      {"markerless", "bare", "the bare symmetric tower, declared ambiguous", run_markerless_bare},
      {"markerless", "network", "networks with symmetric twins among their edges",
       run_markerless_network},
      {"markerless", "bits", "same bits for any thread count and order of the points",
       run_markerless_bits},
  };
}

}  // namespace alea::acceptance
