#pragma once

#include <array>
#include <vector>

#include "alea/die/pip_raster.hpp"
#include "alea/die/pips_likelihood.hpp"

namespace alea {

enum PipContrast { dark_pips, light_pips };

/// The evidence of one facet for one lattice.
struct FacetTable {
  PipPlaces places;
  /// Per contrast and number of pips: gain over a blank facet, and the pattern that gives it.
  std::array<std::array<double, 6>, 2> gain{};
  std::array<std::array<int, 6>, 2> pattern{};
};

using FacetTables = std::array<FacetTable, 3>;

/// The template of one of the lattices tried (spacings 0.22, 0.25, 0.28 and radii 0.07, 0.09, 0.11
/// of the edge; of an oblong facet's edges, or of the shorter one both ways) on a facet, blurred by
/// spot, cells and the frame's uncertainty.
PipTemplateShape template_shape(std::size_t lattice, const FacetImageInput& image,
                                const PipReaderOptions& options);

/// Is it one with the same spacing both ways on an oblong facet?
bool is_square_lattice(std::size_t lattice);

/// The evidence of the three facets for every lattice.
std::vector<FacetTables> tabulate_lattices(const std::array<PipRaster, 3>& rasters,
                                           const std::array<const FacetImageInput*, 3>& images,
                                           const PipReaderOptions& options);

/// One of the 48 readings: its likelihood maximised over lattice, radius and contrast.
struct PipHypothesis {
  PipTriple pips{};
  Chirality hand = Chirality::clockwise;
  double gain = -1;
  PipContrast contrast = dark_pips;
  std::size_t lattice = 0;
};

/// All 48, weighed.
std::vector<PipHypothesis> weigh_hypotheses(const std::vector<FacetTables>& lattices);

}  // namespace alea
