#include "alea/simulate/truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "alea/core/version.hpp"

namespace alea {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json to_json(const Eigen::Matrix4d& matrix) {
  Json rows = Json::array();
  for (int r = 0; r < 4; ++r)
    rows.push_back({matrix(r, 0), matrix(r, 1), matrix(r, 2), matrix(r, 3)});
  return rows;
}

Json to_json(const Scanner& scanner) {
  return {{"range_noise_m", scanner.noise.range_noise_m},
          {"grazing_m", scanner.noise.grazing_m},
          {"surface_m", scanner.noise.surface_m},
          {"angular_noise_rad", scanner.noise.angular_noise_rad},
          {"range_growth", scanner.noise.range_growth},
          {"beam_diameter_m", scanner.beam_diameter_m},
          {"beam_divergence_rad", scanner.beam_divergence_rad},
          {"beam_rings", scanner.beam_rings},
          {"mixed_pixels", scanner.mixed_pixels},
          {"intensity_noise", scanner.intensity_noise}};
}

Json to_json(const Station& station, const WrittenScan& scan) {
  return {{"name", station.name},
          {"file", scan.file},
          {"points", scan.points},
          {"scene_from_scan", to_json(station.scene_from_scan.matrix())},
          {"azimuth_step_rad", station.azimuth.step_rad},
          {"elevation_step_rad", station.elevation.step_rad},
          {"noise_model", to_json(station.scanner)}};
}

/// "1-2-3": the pips of the facets that meet in a corner, ascending.
std::string corner_name(int corner) {
  auto facets = facets_of_corner(corner);
  std::sort(facets.begin(), facets.end());
  return fmt::format("{}-{}-{}", facets[0] + 1, facets[1] + 1, facets[2] + 1);
}

Json to_json(const Die& die) {
  Json planes, edges, corners, pips;
  for (int f = 0; f < 6; ++f) {
    const DieFacet& facet = die.facets[f];
    planes[std::to_string(f + 1)] = {{"normal", to_json(facet.plane.normal)},
                                     {"offset_m", facet.plane.offset_m}};
    Json centres = Json::array();
    for (const Eigen::Vector2d& at : facet.pip_centres_m)
      centres.push_back(
          to_json(Eigen::Vector3d(facet.centre_m + at.x() * facet.u + at.y() * facet.v)));
    pips[std::to_string(f + 1)] = {{"centres_m", centres}, {"radius_m", facet.pip_radius_m}};
  }
  for (int a = 1; a <= 6; ++a)
    for (int b = a + 1; b <= 6; ++b)
      if (a + b != 7) edges[fmt::format("{}-{}", a, b)] = edge_length_m(die.body, a, b);
  for (int c = 0; c < 8; ++c) corners[corner_name(c)] = to_json(die.body.corners_m[c]);
  return {{"id", die.model.id},
          {"planes", planes},
          {"edges_m", edges},
          {"covariance", nullptr},
          {"corners_m", corners},
          {"pips", pips},
          {"chirality", to_string(die.model.chirality)},
          {"size_m", to_json(die.model.size_m)},
          {"edge_radius_m", die.model.edge_radius_m},
          {"scene_from_die", to_json(die.model.scene_from_die.matrix())}};
}

Json to_json(const Patch& patch) {
  const Plane plane = plane_of(patch);
  return {{"id", patch.id},
          {"role", patch.role == PatchRole::check ? "check" : "calibration"},
          {"normal", to_json(plane.normal)},
          {"offset_m", plane.offset_m},
          {"centroid_m", to_json(centre_of(patch))},
          {"corners_m",
           {to_json(patch.corner_m), to_json(Eigen::Vector3d(patch.corner_m + patch.side_u_m)),
            to_json(Eigen::Vector3d(patch.corner_m + patch.side_u_m + patch.side_v_m)),
            to_json(Eigen::Vector3d(patch.corner_m + patch.side_v_m))}}};
}

Json to_json(const Checkerboard& board) {
  const Eigen::Matrix3d& turn = board.scene_from_board.rotation;
  return {{"id", board.id},
          {"centre_m", to_json(board.scene_from_board.translation)},
          {"normal", to_json(Eigen::Vector3d(turn.col(2)))},
          {"axes", {to_json(Eigen::Vector3d(turn.col(0))), to_json(Eigen::Vector3d(turn.col(1)))}},
          {"columns", board.columns},
          {"rows", board.rows},
          {"cell_m", board.cell_m},
          {"side_m", board.columns * board.cell_m}};
}

}  // namespace

std::string truth_json(const Scene& scene, std::uint64_t seed,
                       const std::vector<WrittenScan>& scans) {
  Json truth{{"alea", version()}, {"seed", seed}, {"scans", Json::array()}};
  for (std::size_t i = 0; i < scans.size(); ++i)
    truth["scans"].push_back(to_json(scene.stations[i], scans[i]));
  truth["die"] = scene.dice.empty() ? Json(nullptr) : to_json(scene.dice.front());
  truth["dice"] = Json::array();
  for (const Die& die : scene.dice) truth["dice"].push_back(to_json(die));
  truth["check_planes"] = Json::array();
  for (const Patch& patch : scene.patches)
    if (patch.role != PatchRole::scenery) truth["check_planes"].push_back(to_json(patch));
  truth["spheres"] = Json::array();
  for (const Sphere& sphere : scene.spheres)
    truth["spheres"].push_back(
        {{"id", sphere.id}, {"centre_m", to_json(sphere.centre_m)}, {"radius_m", sphere.radius_m}});
  truth["checkerboards"] = Json::array();
  for (const Checkerboard& board : scene.checkerboards)
    truth["checkerboards"].push_back(to_json(board));
  truth["meshes"] = Json::array();
  for (const Mesh& mesh : scene.meshes)
    truth["meshes"].push_back({{"id", mesh.id},
                               {"vertices", mesh.body.vertices.size()},
                               {"triangles", mesh.body.triangles.size()}});
  return truth.dump(2) + "\n";
}

}  // namespace alea
