#pragma once

#include <cstdint>
#include <string>

#include "experiments/die/twin.hpp"

namespace alea::experiments::die {

/// Writes the data of the pictures that correspond to the paper's Figures 5 to 10 and Table 7 as
/// CSV files below `folder`, for scripts/plot.py. Throws Error(input).
void write_figure_data(const PublishedTables& tables, std::uint64_t seed,
                       const std::string& folder);

/// Figure 5: a furnished room with the die of a twin, its planes, and the die found among them.
void write_extraction_figure(const Twin& twin, std::uint64_t seed, const std::string& folder);
/// Figure 6: the stages of the pip chain on the facets of one scan.
void write_pips_figure(const Twin& twin, std::uint64_t seed, const std::string& folder);
/// Figures 7 to 9: the axes before and after orthogonalisation, the 24 frames, the registered
/// frames.
void write_frame_figures(const std::string& folder);
/// Figure 10 and Table 7: RMSE against the length, and the clouds before and after calibration.
void write_calibration_figures(const PublishedTables& tables, std::uint64_t seed,
                               const std::string& folder);

}  // namespace alea::experiments::die
