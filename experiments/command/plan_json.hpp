#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "alea/evaluate/die_positions.hpp"
#include "alea/evaluate/plan.hpp"
#include "alea/evaluate/plan_check.hpp"
#include "alea/evaluate/plan_file.hpp"

namespace alea::command {

/// What a plan says of one slave.
struct PairPlan {
  std::size_t slave = 1;
  std::optional<Refusal> refusal;
  std::optional<TransformCovariance> covariance;  ///< about the target's centre, master frame
  PoseAccuracy accuracy;
  std::optional<PoseAccuracy>
      fitted;  ///< with the borders and pips left out that the fit leaves out
  std::optional<ErrorMap> map;
  std::optional<double> reach_m;
  std::vector<PlanCheck> checks;  ///< after the measurement, centroids in the scene's frame
};

struct PlanResult {
  Scene scene;
  PlanRequest request;
  std::vector<PlannedFacet> facets;
  std::vector<PairPlan> pairs;
  std::vector<DiePosition> positions;
  std::vector<std::string> files;
};

/// Schema: schemas/plan.v1.json.
nlohmann::json plan_json(const PlanResult& plan);

/// A few lines for a reader.
void print_plan(const PlanResult& plan);

}  // namespace alea::command
