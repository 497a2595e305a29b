#include "alea/die/pip_hypotheses.hpp"

#include <algorithm>
#include <cmath>

namespace alea {
namespace {

/// Lattices and radii that dice come with, as shares of the edge.
constexpr std::array<double, 3> offsets{0.22, 0.25, 0.28};
constexpr std::array<double, 3> radii{0.07, 0.09, 0.11};
constexpr std::size_t sizes = offsets.size() * radii.size();
constexpr double oblong = 1.03;  // edges that differ by more leave two ways to lay out pips

bool is_oblong(const std::array<const FacetImageInput*, 3>& images) {
  return std::any_of(images.begin(), images.end(), [](const FacetImageInput* image) {
    return std::max(image->edge_u_m, image->edge_v_m) >
           oblong * std::min(image->edge_u_m, image->edge_v_m);
  });
}

FacetTable tabulate(const PipRaster& raster, const FacetImageInput& image,
                    const PipTemplateShape& shape) {
  FacetTable table;
  for (auto& patterns : table.pattern) patterns.fill(-1);
  if (raster.place.empty()) return table;
  table.places = correlate_places(raster, image, shape);
  const double cells = static_cast<double>(raster.place.size());
  const double before = raster.residual_square_sum;
  for (std::size_t p = 0; p < pip_patterns.size(); ++p) {
    Eigen::Matrix<double, pip_places, 1> on;
    for (int place = 0; place < pip_places; ++place) on[place] = pip_patterns[p].has(place) ? 1 : 0;
    const double square = on.dot(table.places.gram * on);
    if (square < 1e-3) continue;  // nothing of the pattern was seen
    const double amplitude = on.dot(table.places.projection) / square;
    const double after = std::max(before - amplitude * amplitude * square, 1e-9 * before);
    const double gain = 0.5 * cells * std::log(before / after);
    const PipContrast contrast = amplitude < 0 ? dark_pips : light_pips;
    const std::size_t pips = static_cast<std::size_t>(pip_patterns[p].pips) - 1;
    if (table.pattern[contrast][pips] >= 0 && gain <= table.gain[contrast][pips]) continue;
    table.gain[contrast][pips] = gain;
    table.pattern[contrast][pips] = static_cast<int>(p);
  }
  return table;
}

std::vector<PipHypothesis> all_hypotheses() {
  std::vector<PipHypothesis> hypotheses;
  for (const Chirality hand : {Chirality::clockwise, Chirality::counterclockwise})
    for (const PipTriple& pips : orientations_of(hand)) hypotheses.push_back({pips, hand});
  return hypotheses;
}

void maximise(PipHypothesis& hypothesis, const std::vector<FacetTables>& lattices) {
  for (std::size_t lattice = 0; lattice < lattices.size(); ++lattice)
    for (const PipContrast contrast : {dark_pips, light_pips}) {
      double gain = 0;
      for (std::size_t k = 0; k < 3; ++k)
        gain += lattices[lattice][k].gain[contrast][hypothesis.pips[k] - 1];
      if (gain <= hypothesis.gain) continue;
      hypothesis.gain = gain;
      hypothesis.contrast = contrast;
      hypothesis.lattice = lattice;
    }
}

}  // namespace

bool is_square_lattice(std::size_t lattice) {
  return lattice >= sizes;
}

PipTemplateShape template_shape(std::size_t lattice, const FacetImageInput& image,
                                const PipReaderOptions& options) {
  const double cell_m = std::max(image.edge_u_m, image.edge_v_m) / PipRasterOptions{}.cells;
  const double spot_sd_m = options.footprint_m / 4;
  const double variance = spot_sd_m * spot_sd_m + cell_m * cell_m / 12 +
                          options.frame_jitter_m * options.frame_jitter_m;
  return {offsets[lattice % sizes / radii.size()], radii[lattice % radii.size()],
          std::sqrt(variance), spot_sd_m * image.view_slope, is_square_lattice(lattice)};
}

std::vector<FacetTables> tabulate_lattices(const std::array<PipRaster, 3>& rasters,
                                           const std::array<const FacetImageInput*, 3>& images,
                                           const PipReaderOptions& options) {
  std::vector<FacetTables> lattices(is_oblong(images) ? 2 * sizes : sizes);
  for (std::size_t lattice = 0; lattice < lattices.size(); ++lattice)
    for (std::size_t k = 0; k < 3; ++k)
      lattices[lattice][k] =
          tabulate(rasters[k], *images[k], template_shape(lattice, *images[k], options));
  return lattices;
}

std::vector<PipHypothesis> weigh_hypotheses(const std::vector<FacetTables>& lattices) {
  std::vector<PipHypothesis> hypotheses = all_hypotheses();
  for (PipHypothesis& hypothesis : hypotheses) maximise(hypothesis, lattices);
  return hypotheses;
}

}  // namespace alea
