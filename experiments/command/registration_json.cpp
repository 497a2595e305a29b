#include "experiments/command/registration_json.hpp"

#include "alea/core/angle.hpp"
#include "alea/core/version.hpp"
#include "experiments/command/json_parts.hpp"

namespace alea::command {
namespace {

using nlohmann::json;

json transform_json(const RigidTransform& t, const std::optional<TransformCovariance>& covariance) {
  const Eigen::Quaterniond q(t.rotation);
  const double sign = q.w() < 0 ? -1 : 1;
  return {{"matrix", matrix_json(t.matrix())},
          {"covariance", covariance ? matrix_json(covariance->covariance) : json(nullptr)},
          {"covariance_about_m",
           vector_json(covariance ? covariance->about_m : Eigen::Vector3d::Zero().eval())},
          {"omega_phi_kappa_deg", vector_json(omega_phi_kappa_rad(t.rotation) * deg_per_rad)},
          {"translation_m", vector_json(t.translation)},
          {"quaternion_wxyz", {sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z()}}};
}

json site_json(const SiteTie& site, const RigidTransform& master_from_slave) {
  json points = json::array();
  for (const ControlResidual& point : site.points)
    points.push_back({{"name", point.name},
                      {"site_m", vector_json(point.site_m)},
                      {"master_m", vector_json(point.master_m)},
                      {"residual_m", vector_json(point.residual_m)}});
  return {{"site_from_master", transform_json(site.site_from_master, site.covariance)},
          {"site_from_slave",
           {{"matrix", matrix_json((site.site_from_master * master_from_slave).matrix())}}},
          {"points", points},
          {"rmse_m", site.rmse_m}};
}

json angles_json(const std::map<std::string, double>& angles_rad) {
  json out = json::object();
  for (const auto& [edge, angle] : angles_rad) out[edge] = angle * deg_per_rad;
  return out;
}

json facet_json(const FacetReport& facet) {
  return {{"scan", facet.in_master ? "master" : "slave"},
          {"pips", facet.pips},
          {"points", facet.points},
          {"normal", vector_json(facet.plane.normal)},
          {"offset_m", facet.plane.offset_m},
          {"rmse_m", facet.rmse_m},
          {"pip_probability", facet.pip_probability},
          {"variance_factor", facet.variance_factor}};
}

json die_json(const DieReport& die) {
  json facets = json::array();
  for (const FacetReport& facet : die.facets) facets.push_back(facet_json(facet));
  return {
      {"shared_edge", optional_json(die.shared_edge)},
      {"edge_m", optional_json(die.edge_m)},
      {"edges_m", die.edges_m},
      {"calibrated", die.calibrated},
      {"facets", facets},
      {"angles_deg",
       {{"master", angles_json(die.angles_master_rad)},
        {"slave", angles_json(die.angles_slave_rad)}}},
      {"corner_m",
       {{"master", vector_json(die.corner_master_m)}, {"slave", vector_json(die.corner_slave_m)}}}};
}

json ambiguity_json(const AmbiguityReport& ambiguity) {
  json orientations = json::array();
  for (const OrientationReport& each : ambiguity.orientations)
    orientations.push_back({{"matrix", matrix_json(each.master_from_slave.matrix())},
                            {"log_likelihood_margin", each.log_likelihood_margin},
                            {"scene_points", optional_json(each.scene_points)}});
  return {{"alternatives", ambiguity.alternatives},
          {"log_likelihood_margin", ambiguity.log_likelihood_margin},
          {"resolved_by", ambiguity.resolved_by_scene ? "scene" : "target"},
          {"orientations", orientations}};
}

json refinement_json(const std::optional<RefinementReport>& refinement) {
  if (!refinement) return nullptr;
  return {{"method", refinement->method},
          {"planes", refinement->planes},
          {"pairs", refinement->pairs},
          {"iterations", refinement->iterations},
          {"rotation_deg", refinement->rotation_rad * deg_per_rad},
          {"translation_m", vector_json(refinement->translation_m)},
          {"about_m", vector_json(refinement->about_m)}};
}

json test_json(const FacetTest& test) {
  return {{"scan", test.scan},
          {"pips", test.pips},
          {"tilt_rad", {test.residual[0], test.residual[1]}},
          {"offset_m", test.residual[2]},
          {"standardised", vector_json(test.standardised)},
          {"chi_square", test.statistic},
          {"freedom", test.freedom},
          {"p_value", test.p_value},
          {"suspect", test.suspect}};
}

json adjustment_json(const AdjustmentReport& report) {
  json components = json::array(), facets = json::array();
  for (const VarianceComponent& component : report.components)
    components.push_back({{"group", component.group},
                          {"scan", optional_json(component.scan)},
                          {"factor", component.factor},
                          {"freedom", component.freedom}});
  for (const FacetTest& test : report.tests) facets.push_back(test_json(test));
  return {{"scans", report.scans},
          {"chi_square", report.chi_square},
          {"freedom", report.freedom},
          {"p_value", report.p_value},
          {"covariance_factor", report.covariance_factor},
          {"rank_defect", report.defect},
          {"unobservable", report.open},
          {"variance_components", components},
          {"facets", facets},
          {"iterations", report.iterations}};
}

}  // namespace

json check_plane_json(const CheckPlane& plane) {
  return {{"id", plane.id},
          {"centroid_m", vector_json(plane.centroid_m)},
          {"normal", vector_json(plane.normal)},
          {"points_master", plane.points_master},
          {"points_slave", plane.points_slave},
          {"alone_master_m", plane.alone_master_m},
          {"alone_slave_m", plane.alone_slave_m},
          {"union_m", plane.union_m},
          {"slave_to_master_m", plane.slave_to_master_m},
          {"offset_m", plane.offset_m},
          {"tilt_rad", plane.tilt_rad},
          {"role", plane.role == CheckPlaneRole::check ? "check" : "calibration"}};
}

json registration_json(const Registration& registration, std::uint64_t seed) {
  json planes = json::array();
  for (const CheckPlane& plane : registration.check_planes)
    planes.push_back(check_plane_json(plane));
  json timing = json::object();
  for (const auto& [stage, seconds] : registration.timing_s) timing[stage] = seconds;
  return {{"alea", version()},
          {"status", registration.refusal ? "refused" : "registered"},
          {"refusal", refusal_json(registration.refusal)},
          {"method", registration.method},
          {"seed", seed},
          {"warnings", registration.warnings},
          {"master_from_slave",
           registration.master_from_slave
               ? transform_json(*registration.master_from_slave, registration.covariance)
               : json(nullptr)},
          {"die", registration.die ? die_json(*registration.die) : json(nullptr)},
          {"ambiguity",
           registration.ambiguity ? ambiguity_json(*registration.ambiguity) : json(nullptr)},
          {"refinement", refinement_json(registration.refinement)},
          {"adjustment",
           registration.adjustment ? adjustment_json(*registration.adjustment) : json(nullptr)},
          {"site", registration.site && registration.master_from_slave
                       ? site_json(*registration.site, *registration.master_from_slave)
                       : json(nullptr)},
          {"check_planes", planes},
          {"timing_s", timing}};
}

int finish_registrations(const CommonOptions& options,
                         const std::vector<Registration>& registrations) {
  json document = registration_json(registrations.front(), options.seed);
  if (registrations.size() > 1) {
    json all = json::array();
    for (const Registration& registration : registrations)
      all.push_back(registration_json(registration, options.seed));
    document["registrations"] = std::move(all);
  }
  write_json(options, document);
  int exit_code = exit_done;
  for (const Registration& registration : registrations) {
    if (options.json != "-") print_registration(registration);
    if (registration.refusal) exit_code = report_refusal(*registration.refusal);
  }
  return exit_code;
}

}  // namespace alea::command
