#pragma once

#include <array>

#include "alea/core/seed.hpp"
#include "alea/die/facet_image.hpp"
#include "alea/die/pips_rule.hpp"

namespace alea::die {

/// A die on the floor, its vertical edge towards the scanner, with what a pip reader is given of
/// it: perfect segmentation, a facet frame that is a little off, blurred and noisy intensity.
struct PipTrialOptions {
  double edge_m = 0.5;
  double range_m = 6;             ///< horizontal, from the scanner to the die's centre
  double scanner_height_m = 1.6;  ///< above the floor
  double step_rad = 3e-4;         ///< azimuth and elevation
  double footprint_m = 0.008;     ///< diameter of the laser spot
  double frame_jitter_m = 0.004;  ///< sd of each facet frame's shift, both directions
  double noise_over_contrast = 0.17;
  double background = 0.8;        ///< intensity of the facets
  double pip = 0.2;               ///< intensity of the pips; as the background: a blank cube
  double incidence_exponent = 0;  ///< intensity falls with the cosine of incidence to this power
  double pip_offset = 0.25;       ///< lattice spacing as a share of the edge
  double pip_radius = 0.09;       ///< share of the edge
  double trim_m = 0;              ///< border without points
  Chirality chirality = Chirality::clockwise;
};

struct PipTrial {
  std::array<FacetImageInput, 3> images;  ///< counterclockwise about the corner
  PipTriple pips{};                       ///< what the facets really show
};

/// One scan of one die in a random orientation, forms of 2, 3 and 6 random; a pure function of its
/// arguments.
PipTrial make_pip_trial(const PipTrialOptions& options, const StreamKey& key);

}  // namespace alea::die
