#pragma once

#include <vector>

#include "experiments/engine/acceptance.hpp"

namespace alea::acceptance {

/// The topics of the die, in the order in which they run. A new topic is one function declared here
/// and one line in acceptance.cpp.
std::vector<Topic> die_topics();

/// Issue die, line 3: K, L and P of the study's section 5 against fisher_bound; n has no meaning.
void run_bound_tables(const Options& options, const Report& report);
/// Issue bound, lines 2 and 3.
void run_bound_ranges(const Options& options, const Report& report);
void run_bound_ranks(const Options& options, const Report& report);
/// Issue bound, lines 1 and 4: the adjustment against the bound, its covariance, its bias.
void run_adjustment_topic(const Options& options, const Report& report);
/// Issue bound, line 4: the same where the model does not hold; shown, not judged.
void run_misfit(const Options& options, const Report& report);
/// Issue bound, line 4: the covariance of a registration by planes of the scene alone.
void run_planes_only(const Options& options, const Report& report);
/// Issue bound, line 5: `alea plan` against simulated registrations.
void run_plan(const Options& options, const Report& report);
/// Issue bound, line 7: planted wrong facets and false flags.
void run_suspects(const Options& options, const Report& report);
/// Issue die, line 10: registration by six spheres against its bound.
void run_spheres(const Options& options, const Report& report);
/// Issue bound, line 4: the covariance of a registration by six spheres.
void run_sphere_coverage(const Options& options, const Report& report);
/// Issue die, line 7: the counting chain and the likelihood reader on simulated facets.
void run_pips(const Options& options, const Report& report);

/// Issue die, line 1: the largest error of the shared edge over 1,000 noise-free dice.
void run_exactness(const Options& options, const Report& report);
/// Issue die, line 2: what each frame rule leaks of a die's tilts, 400 dice a cell.
void run_leak(const Options& options, const Report& report);
/// Issue die, line 4: the closed form against bound L, 10,000 pairs of scans a cell.
void run_efficiency_topic(const Options& options, const Report& report);
/// Issue die, line 4, negative control: points chosen by ray, planes fitted orthogonally.
void run_mixed_domains(const Options& options, const Report& report);
/// What each misprint of equations (3) to (8) does on a perfect die.
void run_errata(const Options& options, const Report& report);
/// Issue die, line 6: twins of datasets A to D, calibrated on independent planes, 300 dice each.
void run_twins(const Options& options, const Report& report);
/// Issue die, line 5: rotation of dice extracted from points against bound L of the whole facets.
void run_extraction(const Options& options, const Report& report);
/// Issue die, line 8: 1,000 scenes without a valid die give no transform.
void run_die_refusals(const Options& options, const Report& report);
/// Issue die, line 9: the same bits for one and two threads, shuffled points and two runs.
void run_repeatability(const Options& options, const Report& report);

}  // namespace alea::acceptance
