#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "alea/core/rigid_transform.hpp"
#include "alea/evaluate/fisher_bound.hpp"
#include "alea/facet/facet_corner.hpp"
#include "alea/facet/plane_fit.hpp"
#include "alea/plane/plane_detector.hpp"
#include "alea/simulate/die_model.hpp"
#include "experiments/engine/sweep_experiment.hpp"

namespace alea::experiments::die {

/// Which facets of the die are out of square.
enum class TiltKind {
  random,          ///< all six, each on its own
  parallelepiped,  ///< opposite facets stay parallel
  single_facet     ///< the upper one alone
};

/// How the facets' points are found.
struct Extraction {
  bool direct = true;  ///< sorted by the true planes, then by the fitted ones: no detection
  PlaneDetector detector = PlaneDetector::cells;
  SelectionDomain domain = SelectionDomain::ray;
  FitMethod fit = FitMethod::along_ray;
  bool area_weights = false;
  double trim_m = -1;  ///< negative: as estimated
};

/// One cell of a sweep of the die: a die on the floor at the scene's origin, the facet with one pip
/// up, two levelled stations, the first 45 deg off the facets.
struct DieCase {
  double edge_m = 0.5, range_m = 6, step_rad = 1e-3, separation_rad = 0;
  TiltKind tilt_kind = TiltKind::random;
  double tilt_rad = 0;
  double edge_radius_m = 0, bow_m = 0;
  bool true_length = true;  ///< the shared edge's own length is known; else the nominal one is used
  double tilt_prior_rad = 0;  ///< for pairs that share one facet; zero: none
  NoiseModel noise;
  Extraction extraction;
  std::array<RigidTransform, 2> scene_from_scan;
};

/// The parameters of the experiment `die` with their defaults and units.
std::vector<SweepParameter> die_parameters();

DieCase die_case_of(const SweepSettings& settings);

/// The die of a trial; the same for every cell of the same spread and edge.
Die draw_die(const DieCase& setting, std::uint64_t seed, std::uint64_t trial);

/// Planes that only judge: a place on each and its normal (scene frame, m).
struct CheckPlace {
  Eigen::Vector3d centroid_m, normal;
};
const std::array<CheckPlace, 4>& check_places();

/// What a transform may reach at best.
struct SweepBound {
  double rotation_rad = no_number, translation_m = no_number, check_m = no_number,
         ring10_m = no_number;
};

/// From the covariance of master_from_slave about the die's centre (master frame).
SweepBound bound_from(const DieCase& setting, const TransformCovariance& covariance);

/// Bound K (shape known) or L (free shape, the shared edge exact) of the nominal cube; without
/// numbers where the stations leave a direction open.
SweepBound die_bound_of(const DieCase& setting, bool shape_known);

}  // namespace alea::experiments::die
