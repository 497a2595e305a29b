#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/result.hpp"
#include "alea/facet/facet_extent.hpp"
#include "alea/facet/facet_points.hpp"
#include "alea/facet/plane_fit.hpp"
#include "alea/plane/plane_detector.hpp"

namespace alea {

struct FacetFitOptions {
  PlaneFitOptions fit;
  /// Empty: the domain that goes with the fit (ray with along_ray, coordinate with orthogonal). The
  /// other one is there to show the damage.
  std::optional<SelectionDomain> domain;
  bool nearest_plane = true;
  /// Empty: the largest of the edge radius, the footprint and `least_trim_m`. Selection by rays
  /// also leaves out those whose pointing decides what they meet (pointing.hpp).
  std::optional<double> trim_m;
  std::optional<double> edge_radius_m;  ///< empty: estimated from the points along the edges
  double footprint_m = 0.008;           ///< beam diameter on the facets
  double least_trim_m = 0.01;           ///< but at most a fifteenth of the shortest edge
  double gate_sigmas = 4;               ///< of the residuals' own scale, along the normal
  std::optional<double> gate_m;         ///< a fixed gate instead
  /// Places to leave out, in each facet's uv (see pip_discs).
  std::array<std::vector<FacetDisc>, 3> masks;
  std::size_t min_points = 30;  ///< of a facet after trimming
};

/// The three facets of a corner, fitted to their points.
struct FacetFits {
  std::array<PlaneFit, 3> fits;                       ///< in the order given
  std::array<std::vector<std::uint32_t>, 3> indices;  ///< points that each fit used, ascending
  FacetCorner corner;
  std::array<FacetExtent, 3> extents;
  /// Lengths of corner.edges from both facets' extents, radius and footprint allowed for, and their
  /// standard deviations (m). An initial value and a size check, not a calibration.
  std::array<double, 3> edges_m{}, edges_sd_m{};
  double edge_radius_m = 0;  ///< given or estimated (blunting by the footprint included)
  double trim_m = 0;
  int iterations = 0;  ///< of selecting and fitting until the same points came out
};

/// Selects and fits the facets of a corner that the regions started from, until the selection no
/// longer changes (at most ten times). The regions give first planes and rough sizes only: members
/// are looked for in the whole cloud.
/// Refusals: no_die (the planes have no corner, or no facet faces the scanner), too_few_points.
/// Throws Error(usage) where the fit or the ray domain needs a scanner position that is missing.
Result<FacetFits> fit_facets(const Cloud& cloud, const std::array<PlaneRegion, 3>& regions,
                             const FacetFitOptions& options);

/// Fits the same facets again with other `masks`: planes, extents, edge radius and trim stay where
/// `before` has them, and the iteration starts from there. Refusals and errors as fit_facets.
Result<FacetFits> refit_facets(const Cloud& cloud, const FacetFits& before,
                               const FacetFitOptions& options);

}  // namespace alea
