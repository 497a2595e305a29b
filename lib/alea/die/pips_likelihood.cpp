#include "alea/die/pips_likelihood.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "alea/core/error.hpp"
#include "alea/die/pip_hypotheses.hpp"
#include "alea/die/pip_raster.hpp"

namespace alea {
namespace {

/// Compares each place's own amplitude with what the pattern says of it. A place is wrong when it
/// lies on the other side of half the contrast, beyond what its standard error excuses.
void judge_places(const PipRaster& raster, const PipPlaces& places, const PipPattern& pattern,
                  FacetEvidence& evidence) {
  evidence.places_wrong = 0;
  Eigen::Matrix<double, pip_places, 1> on;
  for (int place = 0; place < pip_places; ++place) on[place] = pattern.has(place) ? 1 : 0;
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

double unexplained_share(const PipLackOfFit& fit) {
  const double excess = fit.after - 4 * fit.noise;
  return excess > 0 && fit.before > 0 ? excess / fit.before : 0;
}

void judge_facet(const PipRaster& raster, const FacetImageInput& image,
                 const PipTemplateShape& shape, const PipPattern& pattern,
                 FacetEvidence& evidence) {
  judge_places(raster, correlate_places(raster, image, shape), pattern, evidence);
  evidence.unexplained = unexplained_share(lack_of_fit(raster, image, shape, pattern));
}

std::array<FacetEvidence, 3> gather_evidence(const std::array<PipRaster, 3>& rasters,
                                             const std::array<const FacetImageInput*, 3>& images,
                                             const FacetTables& tables, const PipHypothesis& best,
                                             const PipReaderOptions& options) {
  constexpr double clearly_explained = 0.1;  // otherwise the lattice may sit a bit off
  std::array<FacetEvidence, 3> facets;
  for (std::size_t k = 0; k < 3; ++k) {
    facets[k].gain = tables[k].gain[best.contrast];
    const auto highest = std::max_element(facets[k].gain.begin(), facets[k].gain.end());
    if (*highest > 0) facets[k].best_pips = static_cast<int>(highest - facets[k].gain.begin()) + 1;
    const int form = tables[k].pattern[best.contrast][best.pips[k] - 1];
    if (form < 0) continue;
    const PipPattern& pattern = pip_patterns[static_cast<std::size_t>(form)];
    PipTemplateShape shape = template_shape(best.lattice, *images[k], options);
    judge_facet(rasters[k], *images[k], shape, pattern, facets[k]);
    if (facets[k].unexplained <= clearly_explained && facets[k].places_wrong == 0) continue;
    shape.shift = fit_shift(rasters[k], *images[k], shape, pattern);
    judge_facet(rasters[k], *images[k], shape, pattern, facets[k]);
  }
  return facets;
}

double needed_margin(double gain, const PipReaderOptions& options) {
  return std::max(options.min_margin, options.min_margin_share * gain);
}

/// The best reading's gain on the facets where another differs: a facet that both read alike says
/// nothing between them, however clear it is.
double gain_against(const PipHypothesis& best, const PipHypothesis& rival,
                    const FacetTables& tables) {
  double gain = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (rival.pips[k] != best.pips[k]) gain += tables[k].gain[best.contrast][best.pips[k] - 1];
  return gain;
}

/// Posterior of each facet's pips, the margin over the best rival and the rivals by their margins.
void compare(const PipHypothesis& best, const std::vector<PipHypothesis>& rivals,
             const FacetTables& tables, const PipReaderOptions& options, PipReading& reading) {
  reading.margin = std::numeric_limits<double>::infinity();
  double total = 0;
  std::array<double, 3> agreeing{};
  for (const PipHypothesis& rival : rivals) {
    const double margin = reading.blank ? 0 : best.gain - rival.gain;
    const double odds = std::exp(-margin);
    total += odds;
    for (std::size_t k = 0; k < 3; ++k)
      if (rival.pips[k] == best.pips[k]) agreeing[k] += odds;
    const double needed = needed_margin(gain_against(best, rival, tables), options);
    reading.readings.push_back({rival.pips, rival.hand, margin, needed});
    if (rival.pips == best.pips) continue;
    reading.margin = std::min(reading.margin, margin);
    if (margin < needed) ++reading.alternatives;
  }
  std::stable_sort(
      reading.readings.begin(), reading.readings.end(),
      [](const WeighedReading& a, const WeighedReading& b) { return a.margin < b.margin; });
  for (std::size_t k = 0; k < 3; ++k) reading.probability[k] = agreeing[k] / total;
}

const PipHypothesis& best_of(const std::vector<PipHypothesis>& hypotheses) {
  return *std::max_element(
      hypotheses.begin(), hypotheses.end(),
      [](const PipHypothesis& a, const PipHypothesis& b) { return a.gain < b.gain; });
}

std::vector<PipHypothesis> of_hand(std::vector<PipHypothesis> hypotheses, Chirality hand) {
  std::erase_if(hypotheses, [&](const PipHypothesis& h) { return h.hand != hand; });
  return hypotheses;
}

/// The readings among which the best must stand out: those of the known hand, unless the other hand
/// wins clearly.
std::vector<PipHypothesis> rivals_of(const std::vector<PipHypothesis>& hypotheses,
                                     const PipReaderOptions& options) {
  if (!options.chirality) return hypotheses;
  const std::vector<PipHypothesis> known = of_hand(hypotheses, *options.chirality);
  const PipHypothesis& best = best_of(hypotheses);
  const bool other_hand_wins = best.gain - best_of(known).gain > needed_margin(best.gain, options);
  return other_hand_wins ? of_hand(hypotheses, best.hand) : known;
}

/// Whether the facets that say something else by themselves say it clearly.
bool contradicted(const PipReading& reading, const PipReaderOptions& options) {
  double alone = 0, together = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& gain = reading.facets[k].gain;
    const double most = *std::max_element(gain.begin(), gain.end());
    const double read = gain[static_cast<std::size_t>(reading.pips[k]) - 1];
    if (most > read) alone += most, together += read;
  }
  return alone - together > 2 * needed_margin(alone, options);
}

std::optional<Refusal> refuse_reading(const PipReading& reading, const PipReaderOptions& options) {
  constexpr double most_unexplained = 0.4;
  bool pips = true;
  for (const FacetEvidence& facet : reading.facets)
    pips = pips && facet.places_wrong <= 1 && facet.unexplained <= most_unexplained;
  if (reading.alternatives > 0 && !options.keep_ambiguous)
    return Refusal{
        RefusalCode::pips_ambiguous,
        std::to_string(reading.alternatives) +
            " other readings explain the pips about as well: scan from nearer or denser"};
  if (contradicted(reading, options))
    return Refusal{RefusalCode::pips_ambiguous,
                   "the three facets contradict each other: no orientation of a die explains all"};
  if (!pips)
    return Refusal{RefusalCode::pips_unreadable,
                   "the marks on the facets are not pips: no die, or intensity badly disturbed"};
  return std::nullopt;
}

/// From the order of the rules back to the order given.
void swap_last_two(PipReading& reading) {
  std::swap(reading.pips[1], reading.pips[2]);
  std::swap(reading.probability[1], reading.probability[2]);
  std::swap(reading.facets[1], reading.facets[2]);
  for (WeighedReading& other : reading.readings) std::swap(other.pips[1], other.pips[2]);
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
  const std::vector<PipHypothesis> hypotheses = weigh_hypotheses(lattices);
  const std::vector<PipHypothesis> rivals = rivals_of(hypotheses, options);
  const PipHypothesis& best = best_of(rivals);
  PipReading reading;
  reading.blank = best.gain < options.min_gain;
  if (reading.blank && !options.keep_ambiguous)
    return Refusal{RefusalCode::pips_unreadable,
                   "the facets carry no readable pips: a blank cube, or too few points on it"};
  reading.needed_margin = needed_margin(best.gain, options);
  reading.pips = best.pips;
  reading.hand = best.hand;
  reading.dark_pips = best.contrast == dark_pips;
  reading.square_lattice = is_square_lattice(best.lattice);
  compare(best, rivals, lattices[best.lattice], options, reading);
  const Chirality other =
      best.hand == Chirality::clockwise ? Chirality::counterclockwise : Chirality::clockwise;
  reading.hand_margin = best.gain - best_of(of_hand(hypotheses, other)).gain;
  reading.facets = gather_evidence(rasters, ordered, lattices[best.lattice], best, options);
  if (!reading.blank)
    if (auto refusal = refuse_reading(reading, options)) return *refusal;
  if (orientation < 0) swap_last_two(reading);
  return reading;
}

}  // namespace alea
