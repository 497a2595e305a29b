#pragma once

#include "experiments/die/twin_observation.hpp"
#include "experiments/die/twin_trial.hpp"

namespace alea::experiments::die {

/// Adds to each check plane the standard deviation (m) of its offset that bound L allows (shape
/// free, the shared edge exact), and the same widened by the variance of the edge's length as the
/// independent planes give it: the noise of their points and bound L's error there.
void add_plane_bounds(const Twin& twin, const TwinObservation& observed, TwinOutcome& outcome);

}  // namespace alea::experiments::die
