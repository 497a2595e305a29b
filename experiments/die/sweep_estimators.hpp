#pragma once

#include <string>
#include <vector>

#include "alea/core/result.hpp"
#include "experiments/die/sweep_observation.hpp"

namespace alea::experiments::die {

/// What an estimator may look at.
struct SweepSight {
  const DieCase& setting;
  const DieScans& scans;
  /// Facets as the case extracts them, and as the paper does; for estimators that need them.
  const std::array<ObservedDie, 2>& facets;
  const std::array<ObservedDie, 2>& paper_facets;
  std::uint64_t seed = 1, trial = 0;
};

/// Which bound belongs beside an estimator.
enum class BoundKind { known_shape, free_shape, spheres, planes };

struct SweepEstimator {
  std::string name;
  std::string what;
  bool needs_facets = true;
  bool needs_paper_facets = false;
  BoundKind bound = BoundKind::free_shape;
  Result<RigidTransform> (*estimate)(const SweepSight&) = nullptr;  ///< master_from_slave
};

const std::vector<SweepEstimator>& sweep_estimators();
/// The estimator of this name, which exists.
const SweepEstimator& sweep_estimator(const std::string& name);

}  // namespace alea::experiments::die
