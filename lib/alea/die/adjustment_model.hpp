#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

#include "alea/die/adjustment.hpp"
#include "alea/die/normal_solution.hpp"

namespace alea {

/// The adjustment between its steps. Frames: scans about their own origins near the die; "master"
/// is the first of them.
struct AdjustmentState {
  std::vector<RigidTransform> master_from_scan;
  RigidTransform master_from_die;
  ShapeVector departure = ShapeVector::Zero();
  std::map<int, PlaneFit> planes;                       ///< of the scene by id, master frame
  Eigen::Vector3d vertical = Eigen::Vector3d::UnitZ();  ///< master frame
};

/// Where the unknowns stand; -1 marks what is not an unknown.
struct AdjustmentLayout {
  int size = 0;
  int die = 0;                 ///< six; scan s > 0 has its six at 6 (s - 1)
  std::array<int, 6> facet{};  ///< three departures each: facets seen and not exact
  std::map<int, int> planes;   ///< three each, by id
  int vertical = -1;           ///< two
  int scan(std::size_t s) const { return s == 0 ? -1 : 6 * (static_cast<int>(s) - 1); }
};

enum class ObservationGroup { facets, shape, edges, planes, levels };

/// A linearised observation: misclosure + by_unknowns * x has the inverse covariance `weight`.
struct AdjustmentObservation {
  ObservationGroup group = ObservationGroup::facets;
  std::size_t scan = 0;
  int label = 0;  ///< pips, or the plane's id
  Eigen::VectorXd misclosure;
  Eigen::MatrixXd by_unknowns;
  Eigen::MatrixXd weight;
};

struct LinearisedAdjustment {
  std::vector<AdjustmentObservation> observations;
  Eigen::MatrixXd constraints;  ///< exact edges, and the die's frame where only the unknowns say it
  Eigen::VectorXd closure;
};

/// Scans about origins near the die, and the rest that does not change from step to step.
struct AdjustmentProblem {
  std::vector<AdjustmentScan> scans;
  ShapePrior shape;
  std::vector<KnownEdge> edges;
  std::optional<double> level_sd_rad;
  bool without_noise = false;  ///< all covariances are zero: equal weights
};

AdjustmentLayout layout_of(const AdjustmentProblem& problem);
AdjustmentState starting_state(const AdjustmentProblem& problem);
LinearisedAdjustment linearise(const AdjustmentProblem& problem, const AdjustmentLayout& layout,
                               const AdjustmentState& state);
NormalSystem normal_system(const LinearisedAdjustment& linearised, int size);
/// The state after a correction of the unknowns.
AdjustmentState corrected(const AdjustmentState& state, const AdjustmentLayout& layout,
                          const Eigen::VectorXd& correction);

}  // namespace alea
