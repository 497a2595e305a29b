#pragma once

#include <string>
#include <vector>

#include "experiments/markerless/twin_study.hpp"

namespace alea::experiments::markerless {

/// The stations of a twin seen from above over all scans (Figures 4 and 7): FOLDER/NAME.png.
void draw_station_plan(const TwinScans& scans, const std::string& title, const std::string& folder,
                       const std::string& name);

/// The fixed and the moving scan of a trial with their names, at the estimate beside the truth, cut
/// level and upright (Figures 5, 8, 9): FOLDER/NAME.png.
void draw_overlays(const TwinScans& scans, const PaperTrial& trial, const std::string& folder,
                   const std::string& name);

/// One station's raw points, its grid average of 0.05 m and the Harris keypoints on it (Figure 2):
/// FOLDER/NAME.png.
void draw_keypoints(const TwinScans& scans, std::size_t station, const std::string& folder,
                    const std::string& name);

}  // namespace alea::experiments::markerless
