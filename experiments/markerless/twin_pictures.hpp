#pragma once

#include <string>
#include <vector>

#include "experiments/markerless/twin_study.hpp"

namespace alea::experiments::markerless {

/// The stations of a twin seen from above over all scans (Figures 4 and 7): FOLDER/NAME.png.
void draw_station_plan(const TwinScans& scans, const std::string& title, const std::string& folder,
                       const std::string& name);

/// The fixed and the moving scan of a trial, at the estimate and at the truth, cut level and
/// upright (Figures 5, 8, 9): FOLDER/NAME_estimate.png and FOLDER/NAME_truth.png.
void draw_overlays(const TwinScans& scans, const PaperTrial& trial, const std::string& folder,
                   const std::string& name);

}  // namespace alea::experiments::markerless
