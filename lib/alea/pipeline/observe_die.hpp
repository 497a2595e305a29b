#pragma once

#include <optional>
#include <string>
#include <vector>

#include "alea/die/die_finder.hpp"
#include "alea/die/observed_die.hpp"
#include "alea/die/pips_likelihood.hpp"
#include "alea/pipeline/register_die.hpp"

namespace alea {

/// Radius about a pip that the fits leave out, as a share of the facet's shorter edge.
inline constexpr double pip_mask_radius_share = 0.1;

/// One die as one scan shows it: planes -> facets -> pips.
struct DieSighting {
  ObservedDie die;
  std::array<double, 3>
      edges_m{};  ///< from the facets' extents; [k] lies between the other two of die.facets
  std::array<double, 3> edges_sd_m{};    ///< radius and footprint allowed for
  std::array<std::size_t, 3> regions{};  ///< its plane regions
  std::size_t candidate = 0;             ///< where it stands among the scan's candidates
  PipReading reading;                    ///< of the facets in the order of the candidate
};

/// Everything that one scan has to say before it meets the other one.
struct ScanSighting {
  std::vector<PlaneRegion> planes;
  std::vector<DieCandidate> candidates;  ///< of the right shape and size, best first
  std::vector<DieSighting> dice;         ///< with readable pips, best first
  /// Where there are none: those with blank or ambiguous pips.
  std::vector<DieSighting> ambiguous;
  std::optional<Refusal> refusal;  ///< where `dice` is empty
  bool scanner_position_known = true;
  double coordinate_step_m = 0;  ///< to which the scan's coordinates were rounded; 0: not
  std::size_t duplicates = 0;    ///< points left out because they repeat another
  double planes_s = 0, facets_s = 0, pips_s = 0;  ///< time taken
};

/// Finds and reads the dice of one scan. The facets are fitted along the ray where the scanner's
/// position is known or the origin may be it, else orthogonally; the cloud keeps the position that
/// was used. `near_m` is in the scan's own frame.
ScanSighting observe_die(Cloud& cloud, const DieRegistrationOptions& options,
                         const std::optional<Eigen::Vector3d>& near_m);

/// Name of the edge between two facets: "1-2".
std::string edge_name(int first_pips, int second_pips);

}  // namespace alea
