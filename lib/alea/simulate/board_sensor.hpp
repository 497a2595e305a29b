#pragma once

#include <string>

#include "alea/core/cloud.hpp"
#include "alea/core/seed.hpp"
#include "alea/simulate/scene.hpp"

namespace alea {

/// A scanner as a checkerboard sees it: what it does to ranges and intensities on dark and light
/// cells. All lengths at the board. The figures of the presets are assumptions of this project, not
/// data sheets, but for the survey scanner's 18 arc seconds and the low-cost one's 20 mm class.
struct BoardSensor {
  std::string name;
  double board_side_m = 0.15;  ///< of the 2 x 2 board that the preset is meant for
  double range_m = 10;
  bool raster = true;        ///< rows and columns of rays; else places drawn at random
  double spacing_m = 0.003;  ///< of the rays across the beam
  double range_sd_light_m = 0.0004, range_sd_dark_m = 0.0008;
  double outlier_share_dark = 0;  ///< of the points on dark cells with an error more along the ray
  double outlier_sd_m = 0;
  double direction_sd_rad = 0;                  ///< of the beam about its reported direction
  double footprint_x_m = 0, footprint_y_m = 0;  ///< standard deviations of the beam
  /// Cross-talk along the scan: the beam smeared by an exponential of this length to one side. The
  /// shift of a fitted edge is taken out: a scanner is calibrated by such targets.
  double cross_talk_m = 0;
  double intensity_sd = 0.03;
};

/// Like a survey scanner: a 0.15 m board at 10 m, 3 mm raster.
BoardSensor survey_sensor();
/// Like a low-cost non-repetitive one: a 0.30 m board at 3 m, 20 and 35 mm range noise on light and
/// dark, edges that bleed.
BoardSensor low_cost_sensor();

/// A scan of one board (and its plate) in the scanner's frame: the scanner at the origin looks
/// along +x to the board's centre, z up. `scanner_from_board` places the board. One trial of the
/// key is one scan; the same bits on every machine.
Cloud scan_board(const Checkerboard& board, const RigidTransform& scanner_from_board,
                 const BoardSensor& sensor, const StreamKey& key);

}  // namespace alea
