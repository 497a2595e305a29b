#include "experiments/die/acceptance.hpp"

namespace alea::acceptance {

std::vector<Topic> die_topics() {
  return {
      {"die", "exactness", "shared edge, noise-free dice, tilts 2 deg, sizes 5 %", run_exactness},
      {"die", "leak", "what frame rules leak of a die's tilts, noise-free", run_leak},
      {"die", "efficiency", "closed form against bound L, and its covariance",
       run_efficiency_topic},
      {"die", "mixed_domains", "negative control: ray selection with an orthogonal fit",
       run_mixed_domains},
      {"die", "errata", "damage of each misprint on a perfect die", run_errata},
      {"die", "bound_tables", "Fisher bounds against the tables of the die study",
       run_bound_tables},
      {"bound", "ranges", "range at which the 10 m ring reaches 2.5 mm at 0.3 mrad",
       run_bound_ranges},
      {"bound", "ranks", "directions that a set of stations leaves open", run_bound_ranks},
      {"bound", "adjustment", "adjustment against its bound, shape known and free; its covariance",
       run_adjustment_topic},
      {"bound", "misfit", "the covariance under warp, rounded edges and range bias", run_misfit},
      {"bound", "planes_only", "covariance of a registration by planes of the scene alone",
       run_planes_only},
      {"bound", "spheres", "covariance of a registration by six spheres, 1 mrad",
       run_sphere_coverage},
      {"bound", "plan", "what alea plan predicts against simulated registrations", run_plan},
      {"bound", "suspects",
       "planted wrong facets that are flagged with floor and walls as witnesses; false flags",
       run_suspects},
      {"die", "pips", "pips read by the counting chain and by likelihood, against the range",
       run_pips},
      {"die", "spheres", "registration by six spheres against its bound, 0.3 mrad", run_spheres},
      {"die", "twins", "twins of datasets A to D, length calibrated on independent planes",
       run_twins},
      {"die", "extraction", "facets from points: rounded edges with and without trim, naive bands",
       run_extraction},
      {"die", "refusals", "scenes without a valid die give no transform", run_die_refusals},
      {"die", "repeatability", "the same bits for any run, thread count and order of points",
       run_repeatability},
  };
}

}  // namespace alea::acceptance
