#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "alea/core/progress.hpp"
#include "experiments/die/twin.hpp"

namespace alea::experiments::die {

/// Every registration that a twin gets.
enum class TwinMethod : std::size_t {
  perfect,                  ///< the truth
  closed_form_nominal,      ///< length on the box
  closed_form_check,        ///< calibrated on the check planes themselves (circular)
  closed_form_independent,  ///< calibrated on other planes
  closed_form_borrowed,     ///< with dataset A's length (B and C are of the same die)
  paper_nominal,            ///< equations 1 to 8, vertical edge fixed
  paper_check,
  paper_independent,
  nearest_nominal,  ///< the reading nearest to the print, see biased_family
  nearest_check,
  nearest_independent,
  spheres_six,
  spheres_four,
  count
};

struct MethodOutcome {
  bool registered = false;
  double edge_m = 0;  ///< the length that it used; 0 for spheres and truth
  double rotation_rad = 0;
  double translation_m = 0;      ///< at the die's centre
  std::vector<double> union_m;   ///< RMSE of both scans together, each check plane
  std::vector<double> offset_m;  ///< true displacement along the normal, each check plane
};

struct PlaneOutcome {
  std::string name;
  bool vertical = true;
  double along_edge = 0, noise_scale = 1;
  double alone_master_m = 0, alone_slave_m = 0;
  /// Standard deviation of the offset that bound L allows, the length exact; and with the variance
  /// of a length calibrated on the independent planes.
  double bound_m = 0, widened_bound_m = 0;
};

struct TwinOutcome {
  std::array<std::size_t, 2> die_points{};
  std::array<double, 2> step_rad{}, azimuth_rad{};
  double scanner_height_m = 0;
  std::array<std::array<double, 3>, 2> angles_rad{};  ///< dihedral, as observed: master, slave
  std::vector<PlaneOutcome> planes;                   ///< the check planes
  std::array<MethodOutcome, static_cast<std::size_t>(TwinMethod::count)> methods;

  const MethodOutcome& of(TwinMethod method) const {
    return methods[static_cast<std::size_t>(method)];
  }
};

struct TwinTrialOptions {
  TwinPrior prior;
  double bias_rad = 0.0039;  ///< of the nearest reading's planes (0.225 deg)
  double plane_points = 1600;
  double step_scale = 1;  ///< of the angular steps on the die; 1 gives the printed point counts
  bool bounds = false;    ///< compute the plane's bounds too
  std::uint64_t seed = 1;
};

/// Draws a twin of the dataset, scans it and registers it by every method.
TwinOutcome run_twin(const PublishedTables& tables, const std::string& dataset,
                     const TwinTrialOptions& options, std::uint64_t trial);

/// The same for trials 0 to n - 1, side by side; same bits for any thread count.
std::vector<TwinOutcome> run_twins(const PublishedTables& tables, const std::string& dataset,
                                   const TwinTrialOptions& options, std::size_t trials,
                                   const ProgressCallback& progress = {});

}  // namespace alea::experiments::die
