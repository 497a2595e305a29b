#pragma once

#include <cstdint>
#include <string>

#include "alea/simulate/scene.hpp"

namespace alea::experiments::markerless {

/// One layout of a twin: everything that the photographs leave open is drawn from `layout`.
struct TwinOptions {
  std::uint64_t layout = 1;  ///< seed of stations, headings and surroundings
  bool bare = false;  ///< the symmetric building alone on flat ground: nothing breaks the symmetry
  double step_rad = 2.7e-3;  ///< of the scanners: 2.7 mrad is about a million points a scan
};

/// A hexagonal bell tower of 3 m circumradius with a window in each side, a door in one, a belfry,
/// trees, houses and a garden wall; stations ST1 to ST5 stand around it, ST6 to ST10 inside. The
/// scanners are levelled, each with a heading of its own.
Scene bell_tower(const TwinOptions& options);

/// A tapered lighthouse (1.9 to 1.4 m, 11 m high, with gallery, lantern and lightning rod) on
/// uneven, sloping ground with posts, shrubs and a shed; stations ST1 to ST9 stand around it.
Scene lighthouse(const TwinOptions& options);

/// The scene as the file that `alea simulate` reads.
std::string as_toml(const Scene& scene, const std::string& title);

}  // namespace alea::experiments::markerless
