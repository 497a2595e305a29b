#pragma once

#include <array>
#include <cstdint>

#include "alea/core/cloud.hpp"

namespace alea::experiments::die {

/// What is wrong with a scene that two stations scan. The last one is the control: nothing.
enum class Fault {
  empty_room,
  furnished_room,
  box_without_pips,
  blank_cube,
  other_hand,
  mirrored_scan,
  two_facets,
  skewed,
  wrong_size,
  none
};

/// Every fault but `none`, in words.
constexpr std::array<const char*, 9> fault_names{
    "no die, empty room",        "no die, furnished room with boxes",
    "box without pips",          "blank cube of the die's size",
    "die of the other hand",     "one scan mirrored",
    "two facets seen by a scan", "facet more than 20 deg off",
    "die of another size"};

/// Two small scans (some thousand points) of one scene, the scanner at their origin.
struct FaultyScans {
  Cloud master, slave;
  double edge_m = 0;  ///< of the die that is looked for
};

/// Draws a scene with a fault: the die's size, pose and rounding, the stations, their distance and
/// step, the furniture. The same seed and number give the same bits.
FaultyScans draw_faulty_scans(Fault fault, std::uint64_t seed, std::uint64_t number);

}  // namespace alea::experiments::die
