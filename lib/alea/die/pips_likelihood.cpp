#include "alea/die/pips_likelihood.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "alea/core/error.hpp"
#include "alea/die/pip_raster.hpp"

namespace alea {
namespace {

/// Lattices and radii that dice come with, as shares of the edge.
constexpr std::array<double, 3> offsets{0.22, 0.25, 0.28};
constexpr std::array<double, 3> radii{0.07, 0.09, 0.11};

enum Contrast { dark, light };

/// The evidence of one facet for one lattice.
struct FacetTable {
  PipPlaces places;
  /// Per contrast and number of pips: gain over a blank facet, and the pattern that gives it.
  std::array<std::array<double, 6>, 2> gain{};
  std::array<std::array<int, 6>, 2> pattern{};
};

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
    const Contrast contrast = amplitude < 0 ? dark : light;
    const std::size_t pips = static_cast<std::size_t>(pip_patterns[p].pips) - 1;
    if (table.pattern[contrast][pips] >= 0 && gain <= table.gain[contrast][pips]) continue;
    table.gain[contrast][pips] = gain;
    table.pattern[contrast][pips] = static_cast<int>(p);
  }
  return table;
}

using FacetTables = std::array<FacetTable, 3>;

/// One of the 48 readings: its likelihood maximised over lattice, radius and contrast.
struct Hypothesis {
  PipTriple pips{};
  Chirality hand = Chirality::clockwise;
  double gain = -1;
  Contrast contrast = dark;
  std::size_t lattice = 0;
};

std::vector<Hypothesis> all_hypotheses() {
  std::vector<Hypothesis> hypotheses;
  for (const Chirality hand : {Chirality::clockwise, Chirality::counterclockwise})
    for (const PipTriple& pips : orientations_of(hand)) hypotheses.push_back({pips, hand});
  return hypotheses;
}

void maximise(Hypothesis& hypothesis, const std::vector<FacetTables>& lattices) {
  for (std::size_t lattice = 0; lattice < lattices.size(); ++lattice)
    for (const Contrast contrast : {dark, light}) {
      double gain = 0;
      for (std::size_t k = 0; k < 3; ++k)
        gain += lattices[lattice][k].gain[contrast][hypothesis.pips[k] - 1];
      if (gain <= hypothesis.gain) continue;
      hypothesis.gain = gain;
      hypothesis.contrast = contrast;
      hypothesis.lattice = lattice;
    }
}

std::vector<FacetTables> tabulate_lattices(const std::array<PipRaster, 3>& rasters,
                                           const std::array<const FacetImageInput*, 3>& images,
                                           const PipReaderOptions& options) {
  std::vector<FacetTables> lattices;
  for (const double offset : offsets)
    for (const double radius : radii) {
      FacetTables& tables = lattices.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const FacetImageInput& image = *images[k];
        const double cell_m = std::max(image.edge_u_m, image.edge_v_m) / PipRasterOptions{}.cells;
        const double spot_sd_m = options.footprint_m / 4;
        PipTemplateShape shape{offset, radius, 0, spot_sd_m * image.view_slope};
        shape.blur_m = std::sqrt(spot_sd_m * spot_sd_m + cell_m * cell_m / 12 +
                                 options.frame_jitter_m * options.frame_jitter_m);
        tables[k] = tabulate(rasters[k], image, shape);
      }
    }
  return lattices;
}

/// Compares each place's own amplitude with what the pattern says of it. A place is wrong when it
/// lies on the other side of half the contrast, beyond what its standard error excuses.
void judge_places(const PipRaster& raster, const FacetTable& table, const PipPattern& pattern,
                  FacetEvidence& evidence) {
  Eigen::Matrix<double, pip_places, 1> on;
  for (int place = 0; place < pip_places; ++place) on[place] = pattern.has(place) ? 1 : 0;
  const auto& places = table.places;
  const double amplitude = on.dot(places.projection) / on.dot(places.gram * on);
  const double after = raster.residual_square_sum - amplitude * on.dot(places.projection);
  const double variance =
      std::max(after, 0.0) / std::max<double>(1, static_cast<double>(raster.place.size()) - 4);
  const double cell_sd = std::sqrt(variance / raster.weight.mean());
  evidence.contrast = cell_sd > 0 ? amplitude / cell_sd : 0;

  Eigen::Matrix<double, pip_places, pip_places> gram = places.gram;
  gram.diagonal().array() += 1e-6 * gram.trace() + 1e-12;
  const Eigen::Matrix<double, pip_places, pip_places> inverse =
      gram.llt().solve(Eigen::Matrix<double, pip_places, pip_places>::Identity());
  const Eigen::Matrix<double, pip_places, 1> amplitudes = inverse * places.projection;
  for (int place = 0; place < pip_places; ++place) {
    const double seen = amplitudes[place] / amplitude;  // 1 on a pip, 0 beside
    const double standard_error = std::sqrt(variance * inverse(place, place)) / std::abs(amplitude);
    const double excess = std::abs(seen - on[place]) - 0.5;
    if (excess > 4 * standard_error) ++evidence.places_wrong;
  }
}

std::array<FacetEvidence, 3> gather_evidence(const std::array<PipRaster, 3>& rasters,
                                             const FacetTables& tables, const Hypothesis& best) {
  std::array<FacetEvidence, 3> facets;
  for (std::size_t k = 0; k < 3; ++k) {
    facets[k].gain = tables[k].gain[best.contrast];
    const auto highest = std::max_element(facets[k].gain.begin(), facets[k].gain.end());
    if (*highest > 0) facets[k].best_pips = static_cast<int>(highest - facets[k].gain.begin()) + 1;
    const int pattern = tables[k].pattern[best.contrast][best.pips[k] - 1];
    if (pattern >= 0)
      judge_places(rasters[k], tables[k], pip_patterns[static_cast<std::size_t>(pattern)],
                   facets[k]);
  }
  return facets;
}

/// Posterior of each facet's pips and the margin over the best rival.
void compare(const Hypothesis& best, const std::vector<Hypothesis>& rivals, double needed_margin,
             PipReading& reading) {
  reading.margin = std::numeric_limits<double>::infinity();
  double total = 0;
  std::array<double, 3> agreeing{};
  for (const Hypothesis& rival : rivals) {
    const double odds = std::exp(rival.gain - best.gain);
    total += odds;
    for (std::size_t k = 0; k < 3; ++k)
      if (rival.pips[k] == best.pips[k]) agreeing[k] += odds;
    if (rival.pips == best.pips) continue;
    reading.margin = std::min(reading.margin, best.gain - rival.gain);
    if (best.gain - rival.gain < needed_margin) ++reading.alternatives;
  }
  for (std::size_t k = 0; k < 3; ++k) reading.probability[k] = agreeing[k] / total;
}

const Hypothesis& best_of(const std::vector<Hypothesis>& hypotheses) {
  return *std::max_element(
      hypotheses.begin(), hypotheses.end(),
      [](const Hypothesis& a, const Hypothesis& b) { return a.gain < b.gain; });
}

std::vector<Hypothesis> of_hand(std::vector<Hypothesis> hypotheses, Chirality hand) {
  std::erase_if(hypotheses, [&](const Hypothesis& h) { return h.hand != hand; });
  return hypotheses;
}

double needed_margin(const Hypothesis& best, const PipReaderOptions& options) {
  return std::max(options.min_margin, options.min_margin_share * best.gain);
}

/// The readings among which the best must stand out: those of the known hand, unless the other hand
/// wins clearly.
std::vector<Hypothesis> rivals_of(const std::vector<Hypothesis>& hypotheses,
                                  const PipReaderOptions& options) {
  if (!options.chirality) return hypotheses;
  const std::vector<Hypothesis> known = of_hand(hypotheses, *options.chirality);
  const Hypothesis& best = best_of(hypotheses);
  const bool other_hand_wins = best.gain - best_of(known).gain > needed_margin(best, options);
  return other_hand_wins ? of_hand(hypotheses, best.hand) : known;
}

std::optional<Refusal> refuse_reading(const PipReading& reading, double gain, double needed) {
  int wrong = 0;
  double contradiction = -gain;
  for (const FacetEvidence& facet : reading.facets) {
    wrong = std::max(wrong, facet.places_wrong);
    contradiction += *std::max_element(facet.gain.begin(), facet.gain.end());
  }
  if (reading.alternatives > 0)
    return Refusal{
        RefusalCode::pips_ambiguous,
        std::to_string(reading.alternatives) +
            " other readings explain the pips about as well: scan from nearer or denser"};
  if (contradiction > 2 * needed)
    return Refusal{RefusalCode::pips_ambiguous,
                   "the three facets contradict each other: no orientation of a die explains all"};
  if (wrong > 1)
    return Refusal{RefusalCode::pips_unreadable,
                   "the marks on the facets are not pips: no die, or intensity badly disturbed"};
  return std::nullopt;
}

}  // namespace

Result<PipReading> read_pips(const std::array<FacetImageInput, 3>& images, int orientation,
                             const PipReaderOptions& options) {
  if (orientation == 0) throw usage_error("read_pips: three facets in one plane have no corner");
  for (const FacetImageInput& image : images)
    if (!(image.edge_u_m > 0 && image.edge_v_m > 0))
      throw usage_error("read_pips: the facets' edges must be positive lengths");
  // The rules speak of facets counterclockwise about the corner: swap two where they are not.
  std::array<const FacetImageInput*, 3> ordered{&images[0], &images[1], &images[2]};
  if (orientation < 0) std::swap(ordered[1], ordered[2]);
  std::array<PipRaster, 3> rasters;
  for (std::size_t k = 0; k < 3; ++k) rasters[k] = rasterise_pips(*ordered[k]);
  const std::vector<FacetTables> lattices = tabulate_lattices(rasters, ordered, options);
  std::vector<Hypothesis> hypotheses = all_hypotheses();
  for (Hypothesis& hypothesis : hypotheses) maximise(hypothesis, lattices);

  const std::vector<Hypothesis> rivals = rivals_of(hypotheses, options);
  const Hypothesis& best = best_of(rivals);
  if (best.gain < options.min_gain)
    return Refusal{RefusalCode::pips_unreadable,
                   "the facets carry no readable pips: a blank cube, or too few points on it"};
  const double needed = needed_margin(best, options);
  PipReading reading;
  reading.pips = best.pips;
  reading.hand = best.hand;
  reading.dark_pips = best.contrast == dark;
  compare(best, rivals, needed, reading);
  const Chirality other =
      best.hand == Chirality::clockwise ? Chirality::counterclockwise : Chirality::clockwise;
  reading.hand_margin = best.gain - best_of(of_hand(hypotheses, other)).gain;
  reading.facets = gather_evidence(rasters, lattices[best.lattice], best);
  if (auto refusal = refuse_reading(reading, best.gain, needed)) return *refusal;
  if (orientation < 0) {
    std::swap(reading.pips[1], reading.pips[2]);
    std::swap(reading.probability[1], reading.probability[2]);
    std::swap(reading.facets[1], reading.facets[2]);
  }
  return reading;
}

std::optional<Refusal> refuse_by_hand(const PipReading& master, const PipReading& slave,
                                      std::optional<Chirality> expected) {
  if (master.hand != slave.hand)
    return Refusal{RefusalCode::mirrored,
                   "the die's hand differs between the scans: one scan is mirrored, or these are "
                   "two dice"};
  if (expected && master.hand != *expected)
    return Refusal{RefusalCode::chirality,
                   "the die in both scans is of the other hand: check --chirality"};
  return std::nullopt;
}

}  // namespace alea
