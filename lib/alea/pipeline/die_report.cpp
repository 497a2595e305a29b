#include "alea/pipeline/die_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace alea {
namespace {

std::map<std::string, double> named_angles(const ObservedDie& die) {
  std::map<std::string, double> angles_rad;
  for (const DihedralAngle& angle : dihedral_angles(die))
    angles_rad[edge_name(angle.first_pips, angle.second_pips)] = angle.angle_rad;
  return angles_rad;
}

void add_facets(const ObservedDie& die, bool in_master, std::vector<FacetReport>& facets) {
  for (const ObservedFacet& facet : die.facets)
    facets.push_back({in_master, facet.pips, facet.fit.points, facet.fit.plane, facet.fit.rmse_m,
                      facet.pip_probability, facet.fit.variance_factor});
}

}  // namespace

DieReport die_report(const DiePair& pair, const DieTransform& transform, bool calibrated,
                     const DieRegistrationOptions& options) {
  DieReport report;
  report.shared_edge = transform.shared_edge;
  report.calibrated = calibrated;
  for (const MeasuredEdge& edge : measured_edges(pair.master, pair.slave))
    report.edges_m[edge.name] = edge.length_m;
  for (const auto& [name, length_m] : transform.edges_m) report.edges_m[name] = length_m;
  if (transform.shared_edge) {
    double& length_m = report.edges_m[*transform.shared_edge];
    length_m = transform.edge_m.value_or(nominal_edge_m(options, length_m).value_or(length_m));
    report.edge_m = length_m;
  }
  add_facets(pair.master.die, true, report.facets);
  add_facets(pair.slave.die, false, report.facets);
  report.angles_master_rad = named_angles(pair.master.die);
  report.angles_slave_rad = named_angles(pair.slave.die);
  report.corner_master_m = transform.corner_master_m;
  report.corner_slave_m = transform.corner_slave_m;
  return report;
}

std::vector<std::string> size_warnings(const DiePair& pair, const DieRegistrationOptions& options) {
  // Extents are those of whole facets: the edge at their border is as much longer or shorter as
  // opposite facets of a usual die (0.4 deg) lean apart over half an edge.
  constexpr double lean = 0.0035;
  std::vector<std::string> warnings;
  for (const MeasuredEdge& edge : measured_edges(pair.master, pair.slave)) {
    // Of a cuboid each length is held against its own, of a die only the one that is used.
    const auto& shared = pair.transform.shared_edge;
    if (!options.edges_m && shared && edge.name != *shared) continue;
    const std::optional<double> nominal_m = nominal_edge_m(options, edge.length_m);
    if (!nominal_m) continue;
    const double sd_m = std::hypot(edge.sd_m, options.edge_sd_m.value_or(0), lean * edge.length_m);
    const double difference_m = edge.length_m - *nominal_m;
    if (std::abs(difference_m) > 3 * sd_m)
      warnings.push_back(fmt::format(
          "edge_unverified: the facets make edge {} {:.4f} m long (sd {:.4f}), {:+.1f} mm from "
          "the given {:.4f} m; measure it or use --calibrate",
          edge.name, edge.length_m, sd_m, difference_m * 1e3, *nominal_m));
  }
  return warnings;
}

}  // namespace alea
