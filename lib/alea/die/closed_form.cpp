#include "alea/die/closed_form.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "alea/core/error.hpp"
#include "alea/die/assembly.hpp"
#include "alea/die/facet_adjustment.hpp"
#include "alea/transform/reference_point.hpp"

namespace alea {
namespace {

void require_valid(const ClosedFormOptions& options) {
  if (options.edge_m && !(*options.edge_m > 0 && std::isfinite(*options.edge_m)))
    throw usage_error("closed form: the edge must be a positive length in metres");
  if (!(options.edge_sd_m >= 0 && std::isfinite(options.edge_sd_m)))
    throw usage_error("closed form: the edge's standard deviation must not be negative");
  if (options.tilt_prior_rad && !(*options.tilt_prior_rad > 0))
    throw usage_error("closed form: the tilt prior must be a positive angle");
}

bool knows_all(const DieShape& shape, const ObservedDie& master, const ObservedDie& slave) {
  for (const ObservedDie* die : {&master, &slave})
    for (const ObservedFacet& facet : die->facets)
      if (!shape.facet(facet.pips)) return false;
  return true;
}

/// Sum of the variances of an edge's direction (rad^2) in one scan.
double direction_variance(const ObservedDie& die, const EdgeName& edge) {
  const PlaneFit &a = find_facet(die, edge.first_pips)->fit,
                 &b = find_facet(die, edge.second_pips)->fit;
  double sum = 0;
  for (const auto& [tilted, other] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    Eigen::Matrix<double, 3, 2> turn;
    for (int k = 0; k < 2; ++k) turn.col(k) = tilted->tangent.col(k).cross(other->plane.normal);
    sum += (turn * tilted->covariance.topLeftCorner<2, 2>() * turn.transpose()).trace();
  }
  return sum;
}

/// The edge between the shared facets; of three, the one known best, the first among equals.
std::optional<EdgeName> choose_edge(const ObservedDie& master, const ObservedDie& slave,
                                    const std::vector<int>& shared) {
  std::optional<EdgeName> best;
  double best_variance = 0;
  for (std::size_t i = 0; i < shared.size(); ++i)
    for (std::size_t j = i + 1; j < shared.size(); ++j) {
      const EdgeName edge{shared[i], shared[j]};
      const double variance = direction_variance(master, edge) + direction_variance(slave, edge);
      if (best && variance >= best_variance) continue;
      best = edge;
      best_variance = variance;
    }
  return best;
}

/// The shape that the two scans are held against, where one is to be used.
Result<std::optional<UncertainShape>> shape_to_use(const ObservedDie& master,
                                                   const ObservedDie& slave,
                                                   const DieRegistration& known,
                                                   const ClosedFormOptions& options) {
  if (options.shape && knows_all(*options.shape, master, slave)) {
    if (const auto hand = hand_of(*options.shape); hand && *hand != known.hand)
      return Refusal{RefusalCode::chirality,
                     fmt::format("the given shape is {}, the die in the scans is {}",
                                 to_string(*hand), to_string(known.hand))};
    return std::optional(UncertainShape{*options.shape, 0, 0});
  }
  if (known.shared.size() >= 2) return std::optional<UncertainShape>();
  if (!options.tilt_prior_rad || !options.edge_m)
    return Refusal{RefusalCode::one_shared_facet,
                   fmt::format("the scans share {} facet{} of the die, which leaves its other "
                               "angles in the result; give a calibrated shape (--die) or a tilt "
                               "prior (--tilt-prior-deg), or move a station",
                               known.shared.size(), known.shared.size() == 1 ? "" : "s")};
  // An edge differs from the distance of the facets' centres by about the tilt times its length.
  const double length_sd_m =
      std::hypot(options.edge_sd_m, *options.edge_m * *options.tilt_prior_rad);
  return std::optional(UncertainShape{cube(*options.edge_m, known.hand), *options.tilt_prior_rad,
                                      length_sd_m / std::sqrt(2.0)});
}

/// The length along the shared edge, given or taken from an incomplete shape.
std::optional<EdgeLength> edge_to_use(const DieRegistration& known,
                                      const ClosedFormOptions& options) {
  if (known.shared.size() != 2) return std::nullopt;
  if (options.shape) {
    const auto& edge = *known.shared_edge;
    if (const auto length = edge_length_m(*options.shape, edge.first_pips, edge.second_pips))
      return EdgeLength{*length, 0};
  }
  if (options.edge_m) return EdgeLength{*options.edge_m, options.edge_sd_m};
  return std::nullopt;
}

/// Brings a result about the die's middles back to the scans' own frames.
void finish(DieRegistration& result, const FacetAdjustment& adjustment,
            const Eigen::Vector3d& master_origin, const Eigen::Vector3d& slave_origin,
            const ClosedFormOptions& options) {
  const RigidTransform& local = adjustment.master_from_slave;
  result.master_from_slave.rotation = local.rotation;
  result.master_from_slave.translation =
      master_origin + local.translation - local.rotation * slave_origin;
  result.centre_m = master_origin;
  result.covariance = moved_to({adjustment.covariance, master_origin},
                               options.covariance_about_m.value_or(reference_point(master_origin)));
  result.translation_by_edge = adjustment.translation_by_edge;
  result.misclosure_chi_square = adjustment.chi_square;
  result.misclosure_freedom = adjustment.freedom;
}

}  // namespace

Result<DieRegistration> register_closed_form(const ObservedDie& master, const ObservedDie& slave,
                                             const ClosedFormOptions& options) {
  require_valid(options);
  if (auto refusal = check_pair(master, slave, options.hand)) return *refusal;
  DieRegistration result;
  result.hand = hand_of(master).value();
  result.shared = shared_pips(master, slave);
  result.shared_edge = choose_edge(master, slave, result.shared);
  result.corner_master_m = assemble_corner(planes_of(master)).value().corner_m;
  result.corner_slave_m = assemble_corner(planes_of(slave)).value().corner_m;

  const Eigen::Vector3d master_origin = approximate_centre(master),
                        slave_origin = approximate_centre(slave);
  const ObservedDie near_master = recentred(master, master_origin),
                    near_slave = recentred(slave, slave_origin);
  const auto shape = shape_to_use(master, slave, result, options);
  if (!shape) return shape.refusal();
  if (*shape) {
    finish(result, adjust_to_shape(near_master, near_slave, **shape), master_origin, slave_origin,
           options);
    if (result.shared_edge && options.shape)
      result.edge_m = edge_length_m(*options.shape, result.shared_edge->first_pips,
                                    result.shared_edge->second_pips);
    return result;
  }
  const auto edge = edge_to_use(result, options);
  if (result.shared.size() == 2 && !edge)
    return Refusal{RefusalCode::unobservable,
                   fmt::format("the length of edge {}-{} is not known, so the shift along it is "
                               "not determined; give --edge or --die",
                               result.shared_edge->first_pips, result.shared_edge->second_pips)};
  if (edge) result.edge_m = edge->length_m;
  finish(result, adjust_shared_facets(near_master, near_slave, edge), master_origin, slave_origin,
         options);
  return result;
}

}  // namespace alea
