#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "alea/simulate/scene.hpp"
#include "experiments/die/published.hpp"

namespace alea::experiments::die {

/// What the paper omits and the twins draw, each uniformly between two bounds unless it says
/// otherwise. Published distances, facets and sizes are inputs.
struct TwinPrior {
  double azimuth_half_range_rad = 0.349;  ///< of each station about 45 deg off the facets (20 deg)
  std::array<double, 2> scanner_height_m{1.3, 1.9};
  double tilt_sd_rad = 0.00698;  ///< normal, each facet, two directions (0.4 deg, as Table 6 shows)
  double offset_sd_m = 0.002;    ///< normal, each facet
  std::array<double, 2> patch_side_m{0.5, 1.0};   ///< of a check plane
  std::array<double, 2> wall_height_m{0.5, 2.0};  ///< of the centre of a vertical plane
  double max_incidence_rad = 1.13;                ///< at a vertical plane, both stations (65 deg)
  std::array<double, 2> noise_scale{0.7, 1.3};    ///< of the noise model, each plane its own
  std::array<double, 2> unprinted_distance{0.6,
                                           1.4};  ///< of its neighbour's, where none is printed
  double sphere_ring_m = 4;
};

/// A plane of the scene that both stations see.
struct TwinPlane {
  std::string name;  ///< "A-1", "calibration 1"
  bool vertical = true;
  bool check = true;  ///< else it calibrates the die's length and is never evaluated
  Patch patch;
  double noise_scale = 1;
  double along_edge = 0;  ///< |normal . shared edge|: how much of a length's error it shows
};

/// One draw of a dataset: a die, two stations, planes and spheres that the paper's numbers allow.
struct Twin {
  std::string dataset;
  Die die;
  int top = 0, side = 0;                          ///< pips of the shared facets; the top looks up
  int master_facet = 0, slave_facet = 0;          ///< pips of the facets that one scan alone sees
  std::array<RigidTransform, 2> scene_from_scan;  ///< master, slave
  std::array<double, 2> step_rad{};               ///< that gives Table 1's point counts on the die
  double nominal_edge_m = 0;
  double true_edge_m = 0;  ///< Table 6's value, corner to corner along the shared edge
  Eigen::Vector3d edge_direction = Eigen::Vector3d::UnitY();  ///< scene frame
  std::vector<TwinPlane> planes;
  std::vector<Sphere> spheres;
  std::array<double, 2> azimuth_rad{};  ///< departure of each station from 45 deg
  double scanner_height_m = 0;

  /// p_master = master_from_slave * p_slave, the truth.
  RigidTransform master_from_slave() const {
    return scene_from_scan[0].inverse() * scene_from_scan[1];
  }
};

/// Draws a twin of dataset "A" to "D". The same seed and trial give the same twin.
Twin draw_twin(const PublishedTables& tables, const std::string& dataset, const TwinPrior& prior,
               std::uint64_t seed, std::uint64_t trial);

}  // namespace alea::experiments::die
