#include "alea/pipeline/die_transform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "alea/die/closed_form.hpp"
#include "alea/die/paper_registration.hpp"

namespace alea {
namespace {

double measured_m(const std::vector<MeasuredEdge>& edges, const std::string& name) {
  for (const MeasuredEdge& edge : edges)
    if (edge.name == name) return edge.length_m;
  return 0;
}

/// Length between the two scans' corners, which are the ends of the edge that the shared facets
/// meet in.
std::optional<double> shared_edge_length_m(const DieSighting& master, const DieSighting& slave,
                                           const DieRegistrationOptions& options) {
  const std::vector<int> shared = shared_pips(master.die, slave.die);
  const double measured = shared.size() >= 2 ? measured_m(measured_edges(master, slave),
                                                          edge_name(shared[0], shared[1]))
                                             : master.edges_m[0];
  return nominal_edge_m(options, measured);
}

Result<DieTransform> by_closed_form(const DieSighting& master, const DieSighting& slave,
                                    const DieRegistrationOptions& options,
                                    const std::optional<Eigen::VectorXd>& lengths_m,
                                    double length_sd_m) {
  ClosedFormOptions closed;
  closed.edge_m = lengths_m ? (*lengths_m)[0] : shared_edge_length_m(master, slave, options);
  closed.edge_sd_m = lengths_m ? length_sd_m : options.edge_sd_m.value_or(0);
  closed.shape = options.shape;
  closed.tilt_prior_rad = options.tilt_prior_rad;
  closed.hand = hand_rule(options.chirality);
  const Result<DieRegistration> found = register_closed_form(master.die, slave.die, closed);
  if (!found) return found.refusal();

  DieTransform out;
  out.master_from_slave = found->master_from_slave;
  out.covariance = found->covariance;
  if (found->shared_edge)
    out.shared_edge = edge_name(found->shared_edge->first_pips, found->shared_edge->second_pips);
  out.edge_m = found->edge_m;
  out.edge_sd_m = closed.edge_sd_m;
  if (out.edge_m && !options.shape) {
    out.lengths_m = Eigen::VectorXd::Constant(1, *out.edge_m);
    out.directions = found->translation_by_edge;
  }
  out.corner_master_m = found->corner_master_m;
  out.corner_slave_m = found->corner_slave_m;
  out.centre_m = found->centre_m;
  if (options.method == DieMethod::adjustment) return out;  // which has its own test
  const double excess = found->misclosure_chi_square - found->misclosure_freedom;
  if (excess > 5 * std::sqrt(2.0 * std::max(1, found->misclosure_freedom)) + 5)
    out.warnings.push_back(fmt::format(
        "shape_disagreement: the scans disagree about the shape that both see (chi-square "
        "{:.1f} on {} degrees of freedom); was the die moved or bent between the scans?",
        found->misclosure_chi_square, found->misclosure_freedom));
  return out;
}

Result<DieTransform> by_paper(const DieSighting& master, const DieSighting& slave,
                              const DieRegistrationOptions& options,
                              const std::optional<Eigen::VectorXd>& lengths_m) {
  PaperRegistrationOptions paper;
  const double nominal_m = shared_edge_length_m(master, slave, options).value_or(master.edges_m[0]);
  const Eigen::VectorXd lengths = lengths_m.value_or(Eigen::Vector2d(nominal_m, 0));
  paper.dimensions = {lengths[0], lengths[0], lengths[0], lengths[1]};
  if (options.method == DieMethod::paper_literal) paper.errors = PrintedErrors::as_printed();
  paper.hand = hand_rule(options.chirality);
  const Result<PaperRegistration> found = register_paper(master.die, slave.die, paper);
  if (!found) return found.refusal();

  DieTransform out;
  out.master_from_slave = found->master_from_slave;
  if (found->shared.size() >= 2) {
    out.shared_edge = edge_name(found->shared[0], found->shared[1]);
    out.edge_m = lengths[0];
  } else {
    out.warnings.push_back(fmt::format(
        "one_shared_facet: {} shared facet(s); the published frames then rest on the die "
        "being a perfect cube",
        found->shared.size()));
  }
  out.lengths_m = lengths;
  out.directions.resize(3, 2);
  out.directions << found->translation_by_dimensions.leftCols<3>().rowwise().sum(),
      found->translation_by_dimensions.col(3);
  out.corner_master_m = found->v.corner_m;
  out.corner_slave_m = found->u.corner_m;
  out.centre_m = found->v.corner_m;
  return out;
}

}  // namespace

HandRule hand_rule(const std::optional<Chirality>& chirality) {
  if (!chirality) return HandRule::any;
  return *chirality == Chirality::clockwise ? HandRule::clockwise : HandRule::counterclockwise;
}

std::optional<double> nominal_edge_m(const DieRegistrationOptions& options, double measured_m) {
  if (options.edges_m)
    return *std::min_element(
        options.edges_m->begin(), options.edges_m->end(),
        [&](double a, double b) { return std::abs(a - measured_m) < std::abs(b - measured_m); });
  return options.edge_m > 0 ? std::optional(options.edge_m) : std::nullopt;
}

std::vector<MeasuredEdge> measured_edges(const DieSighting& master, const DieSighting& slave) {
  std::map<std::string, Eigen::Vector3d> sums;  // weight, weighted length, weighted deviation
  for (const DieSighting* sighting : {&master, &slave}) {
    for (int k = 0; k < 3; ++k) {
      const auto& facets = sighting->die.facets;
      const double weight = 1 / std::max(sighting->edges_sd_m[k] * sighting->edges_sd_m[k], 1e-12);
      auto [sum, is_new] = sums.try_emplace(
          edge_name(facets[(k + 1) % 3].pips, facets[(k + 2) % 3].pips), Eigen::Vector3d::Zero());
      sum->second += weight * Eigen::Vector3d(1, sighting->edges_m[k], sighting->edges_sd_m[k]);
    }
  }
  std::vector<MeasuredEdge> edges;
  for (const auto& [name, sum] : sums) edges.push_back({name, sum[1] / sum[0], sum[2] / sum[0]});
  return edges;
}

Result<DieTransform> transform_by_die(const DieSighting& master, const DieSighting& slave,
                                      const DieRegistrationOptions& options,
                                      const std::optional<Eigen::VectorXd>& lengths_m,
                                      double length_sd_m) {
  return is_published(options.method)
             ? by_paper(master, slave, options, lengths_m)
             : by_closed_form(master, slave, options, lengths_m, length_sd_m);
}

}  // namespace alea
