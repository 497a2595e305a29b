#pragma once

#include <span>
#include <string>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/die/adjustment.hpp"
#include "alea/pipeline/register_die.hpp"

namespace alea {

struct ShapeCalibrationOptions {
  /// `edge_m` finds the die; with `edge_sd_m` every edge that is seen has that length within it (a
  /// caliper). Everything else as in a registration.
  DieRegistrationOptions die;
  bool use_planes = true;    ///< planes of the scene that scans share with the first one
  bool use_extents = false;  ///< lengths from the facets' extents, with their standard deviations
};

struct ShapeCalibration {
  DieAdjustment adjusted;
  Chirality hand = Chirality::clockwise;
  std::size_t scans = 0;   ///< that took part
  std::size_t planes = 0;  ///< pairs of scene planes that took part
  std::vector<std::string> warnings;
};

/// The shape of one die from scans about it, each in its own frame: all tilts of the facets that
/// the scans see, and the lengths that planes of the scene, a caliper or the extents support. What
/// nothing supports stays open and is said so. Scans without the die are left out with a warning.
/// Refusals: those of the scans where fewer than two have the die, `no_convergence`.
Result<ShapeCalibration> calibrate_shape(std::span<const Cloud> scans,
                                         const ShapeCalibrationOptions& options);

}  // namespace alea
