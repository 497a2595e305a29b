#include "alea/pipeline/joint_shape.hpp"

#include <array>
#include <cmath>

namespace alea {
namespace {

/// Named as "1-2".
EdgeName edge_from(const std::string& name) {
  return {name[0] - '0', name[2] - '0'};
}

std::vector<KnownEdge> shared_edges(const std::vector<SlaveRun>& runs) {
  std::vector<KnownEdge> edges;
  std::array<bool, 3> taken{};
  for (const SlaveRun& run : runs) {
    const DieTransform& transform = run.transform;
    if (!run.pair || run.tied_by_others || !transform.shared_edge || !transform.edge_m) continue;
    const EdgeName edge = edge_from(*transform.shared_edge);
    // A second edge along the same axis would contradict an exact first one: they are not parallel.
    bool& axis = taken[3 - die_axis(edge.first_pips) - die_axis(edge.second_pips)];
    if (!axis) edges.push_back({edge, *transform.edge_m, transform.edge_sd_m});
    axis = true;
  }
  return edges;
}

/// A size to start from: the given edge, else the mean of what the extents say.
double start_edge_m(const std::vector<SlaveRun>& runs, const DieRegistrationOptions& options) {
  double sum = 0, count = 0;
  for (const SlaveRun& run : runs) {
    if (!run.pair) continue;
    for (const double edge_m : run.pair->master.edges_m) sum += edge_m, ++count;
  }
  return options.edge_m > 0 ? options.edge_m : sum / count;
}

ShapePrior given_shape(const DieRegistrationOptions& options) {
  return options.shape_covariance ? calibrated_shape(*options.shape, *options.shape_covariance)
                                  : exact_shape(*options.shape);
}

Chirality seen_hand(const std::vector<SlaveRun>& runs) {
  for (const SlaveRun& run : runs)
    if (run.pair) return hand_of(run.pair->master.die).value_or(Chirality::clockwise);
  return Chirality::clockwise;
}

}  // namespace

AdjustmentOptions joint_options(const std::vector<SlaveRun>& runs,
                                const DieRegistrationOptions& options, bool with_tilt_prior) {
  AdjustmentOptions out;
  out.hand = hand_rule(options.chirality);
  out.level_sd_rad = options.level_sd_rad;
  if (options.shape) {
    out.shape = given_shape(options);
    if (!options.shape_covariance) return out;
    out.edges = shared_edges(runs);
    return out;
  }
  const double edge_m = start_edge_m(runs, options);
  const DieShape nominal = cube(edge_m, seen_hand(runs));
  out.edges = shared_edges(runs);
  if (!with_tilt_prior) {
    out.shape = free_shape(nominal);
    return out;
  }
  // An edge differs from the distance of the facets' centres by about the tilt times its length.
  const double length_sd_m =
      std::hypot(options.edge_sd_m.value_or(0), edge_m * *options.tilt_prior_rad);
  out.shape = normal_shape(nominal, *options.tilt_prior_rad, length_sd_m / std::sqrt(2.0));
  return out;
}

}  // namespace alea
