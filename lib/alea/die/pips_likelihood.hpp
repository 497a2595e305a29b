#pragma once

#include <array>
#include <optional>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/die/facet_image.hpp"
#include "alea/die/pips_rule.hpp"

namespace alea {

struct PipReaderOptions {
  /// The die's hand where it is known; empty reads either.
  std::optional<Chirality> chirality = Chirality::clockwise;
  double footprint_m = 0.008;     ///< diameter of the laser spot at the die
  double frame_jitter_m = 0.004;  ///< sd of the facet's frame (corner, edges) about the true one
  /// Log-likelihood by which the best reading must beat every other, and the share of its own gain
  /// over blank facets, on the facets that the other reads differently, that it must beat it by.
  double min_margin = 6;
  double min_margin_share = 0.05;
  double min_gain = 20;  ///< log-likelihood of the best reading over a blank die
  /// A blank die, and pips with several readings within the margin, come back as a reading with
  /// alternatives instead of a refusal. Marks that are not pips are refused all the same.
  bool keep_ambiguous = false;
};

/// One of the readings considered.
struct WeighedReading {
  std::array<int, 3> pips{};  ///< of the facets in the order given
  Chirality hand = Chirality::clockwise;
  double margin = 0;         ///< log-likelihood of the best reading over this one
  double needed_margin = 0;  ///< it is no alternative where its margin is not below this
};

/// What one facet shows by itself.
struct FacetEvidence {
  /// Log-likelihood over a blank facet of each number of pips (index = pips - 1), both forms of 2,
  /// 3 and 6 tried.
  std::array<double, 6> gain{};
  int best_pips = 0;     ///< of these the best; 0 where the facet carries no evidence
  double contrast = 0;   ///< pip minus background over the noise of one cell, for the joint reading
  int places_wrong = 0;  ///< places of the 3 x 3 lattice that contradict the joint reading
  /// Share of the facet's structure that the reading leaves unexplained, as far as it exceeds four
  /// standard errors: near 0 for pips, near 1 for other marks.
  double unexplained = 0;
};

/// The joint reading of the three facets of a corner.
struct PipReading {
  std::array<int, 3> pips{};  ///< of the facets in the order given
  std::array<double, 3>
      probability{};  ///< posterior of each facet's pips, all readings equal before
  Chirality hand = Chirality::clockwise;
  double margin = 0;         ///< log-likelihood over the runner-up among the readings considered
  double hand_margin = 0;    ///< log-likelihood over the best reading of the other hand
  double needed_margin = 0;  ///< over a reading that differs in all three facets
  int alternatives = 0;      ///< other readings within the required margin
  bool blank = false;        ///< no pips at all: every reading is as likely as the others
  bool dark_pips = true;     ///< false: light pips on dark facets
  /// On oblong facets: pips as far apart both ways, not as shares of each edge.
  bool square_lattice = false;
  std::array<FacetEvidence, 3> facets;
  std::vector<WeighedReading> readings;  ///< all that were considered, the best first
};

/// Maximum-likelihood reading over the 24 orientations of each hand: blurred pips on the 3 x 3
/// lattice against the cell means of the three facets, Gaussian noise of unknown size, level, slope
/// and contrast of each facet estimated (profile likelihood), pips all darker or all lighter than
/// their facets, lattice spacing and pip radius shared by the facets and chosen by likelihood. How
/// 2, 3 and 6 are turned is a nuisance. `orientation` is the sign of det of the facets' outward
/// normals in the order given (CornerAssembly::orientation).
///
/// With options.chirality set, only readings of that hand are rivals, unless one of the other hand
/// wins by the margin: it is then returned, and `hand` says so (check_pair decides over both
/// scans). Refuses as pips_unreadable a blank die or marks that are not pips, as pips_ambiguous a
/// small margin or facets that contradict each other. Throws Error(usage) for an orientation of
/// zero or edges that are not positive.
Result<PipReading> read_pips(const std::array<FacetImageInput, 3>& images, int orientation,
                             const PipReaderOptions& options = {});

}  // namespace alea
