#pragma once

#include "alea/core/seed.hpp"
#include "experiments/die/twin.hpp"

namespace alea::experiments::die {

/// Adds to a twin with its die and stations: the four check planes at their printed distances, four
/// planes for the calibration (three walls, one of them across the shared edge, and a piece of
/// floor), and six spheres about the die.
void place_scenery(const PublishedTables& tables, const TwinPrior& prior, RandomStream& stream,
                   Twin& twin);

}  // namespace alea::experiments::die
