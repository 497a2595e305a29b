#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/noise_model.hpp"
#include "alea/die/die_shape.hpp"
#include "alea/die/shape_prior.hpp"
#include "alea/pipeline/refinement.hpp"
#include "alea/pipeline/registration.hpp"
#include "alea/plane/plane_detector.hpp"

namespace alea {

enum class DieMethod {
  paper,          ///< the published chain with its printed errors corrected
  paper_literal,  ///< the published chain with its equations as printed
  closed_form,    ///< shared edge and shared facets, along-ray fits
  adjustment,     ///< all scans together in one least squares, started by the closed form
};

const char* to_string(DieMethod method);

/// Whether it is one of the published chains.
bool is_published(DieMethod method);

/// How the points of a facet are weighed in its fit (lib/alea/facet/README.md). The published
/// methods know only equal weights.
enum class FacetWeights {
  noise,   ///< by the noise model: the most precise for flat facets
  area,    ///< by the surface that a ray stands for: one plane for a warped facet from any station
  robust,  ///< by the noise model, strays weighed down (Huber)
};

struct DieRegistrationOptions {
  DieMethod method = DieMethod::adjustment;
  PlaneDetector planes = PlaneDetector::cells;
  /// Instead of `planes`: somebody else's detector. Runs for both scans at the same time.
  std::function<std::vector<PlaneRegion>(const Cloud&)> find_planes;
  double edge_m =
      0;  ///< nominal or exact length of the shared edge, corner to corner; 0: not known
  std::optional<std::array<double, 3>> edges_m;  ///< of a cuboid, in any order
  std::optional<double>
      edge_sd_m;  ///< standard deviation of edge_m; without it edge_m is taken as exact
  std::optional<DieShape> shape;  ///< a calibrated shape
  /// Of its departures (see ShapePrior); without it the shape is taken as exact. Used by the
  /// adjustment.
  std::optional<ShapeMatrix> shape_covariance;
  /// Levelled scanners: standard deviation of their z axes from the vertical (rad). Used by the
  /// adjustment.
  std::optional<double> level_sd_rad;
  /// Planes that both scans see (those that would calibrate) take part in the adjustment as
  /// observations of the poses.
  bool join_planes = false;
  bool calibrate = false;  ///< estimate the length on planes that both scans see
  std::optional<Chirality> chirality =
      Chirality::clockwise;  ///< empty: whichever both scans agree on
  /// Where the pips leave several orientations or are missing, the rest of the scene decides.
  bool resolve_by_scene = false;
  /// Both scanners are levelled: only orientations of the die that keep the vertical are possible.
  bool levelled = false;
  std::optional<double> tilt_prior_rad;   ///< standard deviation of the facets' tilts
  std::optional<Eigen::Vector3d> near_m;  ///< where the die is, roughly, in the master frame
  std::vector<Eigen::Vector3d>
      check_plane_centroids_m;  ///< master frame; then the other planes calibrate
  FacetWeights weights = FacetWeights::noise;
  Refinement refine = Refinement::none;  ///< after the die, on the calibration planes
  NoiseModel noise;
  std::uint64_t seed = 1;
};

/// Registers a slave scan to a master scan by one die that both see. Clouds in metres with
/// intensity, each in its own frame; the scanner's position from the cloud, else the origin where
/// that is plausible. The same points in any order give the same bits. Throws Error(input) for a
/// cloud without intensity. Data that cannot support a transform come back as a refusal inside the
/// result. Method: Chan et al. 2023 (doi 10.3390/app13031306) and lib/alea/die/README.md.
Registration register_die(const Cloud& master, const Cloud& slave,
                          const DieRegistrationOptions& options);

/// The same for any number of slaves of one master, one result each. The adjustment takes all scans
/// of the die together, so that a slave which shares too little with the master is tied by the
/// others.
std::vector<Registration> register_die(const Cloud& master, std::span<const Cloud> slaves,
                                       const DieRegistrationOptions& options);

}  // namespace alea
