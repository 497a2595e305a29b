#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iterator>

#include "alea/die/die_finder.hpp"
#include "alea/die/pips_chain.hpp"
#include "alea/io/atomic_file.hpp"
#include "alea/plane/plane_detector.hpp"
#include "alea/simulate/scanner.hpp"
#include "experiments/die/figures.hpp"

namespace alea::experiments::die {
namespace {

Patch rectangle(const Eigen::Vector3d& corner_m, const Eigen::Vector3d& u_m,
                const Eigen::Vector3d& v_m, double intensity) {
  Patch patch;
  patch.corner_m = corner_m;
  patch.side_u_m = u_m;
  patch.side_v_m = v_m;
  patch.intensity = intensity;
  return patch;
}

// A room of 12 by 12 m about the die, with a table, a cabinet, a pillar and the twin's spheres.
Scene room(const Twin& twin) {
  Scene scene;
  scene.dice.push_back(twin.die);
  scene.patches.push_back(rectangle({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0.35));
  scene.patches.push_back(rectangle({-4, -9, 0}, {0, 18, 0}, {0, 0, 3}, 0.6));
  scene.patches.push_back(rectangle({-9, 5, 0}, {18, 0, 0}, {0, 0, 3}, 0.65));
  Box table;
  table.size_m = {1.2, 0.7, 0.75};
  table.scene_from_box = levelled_pose({-2.2, -1.6, 0.375}, 0.4);
  Box cabinet;
  cabinet.size_m = {0.5, 1.0, 1.8};
  cabinet.scene_from_box = levelled_pose({-2.0, 2.6, 0.9}, -0.5);
  scene.boxes = {table, cabinet};
  Cylinder pillar;
  pillar.base_m = {-1.5, 1.0, 0};
  pillar.axis_m = {0, 0, 2.6};
  pillar.radius_m = 0.18;
  scene.cylinders.push_back(pillar);
  scene.spheres = twin.spheres;
  return scene;
}

// Place of each point's region among the regions, -1 for none.
std::vector<int> region_of_point(std::size_t points, const std::vector<PlaneRegion>& regions) {
  std::vector<int> region(points, -1);
  for (std::size_t k = 0; k < regions.size(); ++k)
    for (const std::uint32_t index : regions[k].indices) region[index] = static_cast<int>(k);
  return region;
}

void append_image(std::string& csv, int pips, const std::string& stage, const GreyImage& image) {
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      fmt::format_to(std::back_inserter(csv), "{},{},{},{},{:.4g}\n", pips, stage, row, column,
                     image.pixels[static_cast<std::size_t>(row) * image.width + column]);
}

}  // namespace

void write_extraction_figure(const Twin& twin, std::uint64_t seed, const std::string& folder) {
  const Scene scene = room(twin);
  Station station;
  station.scene_from_scan = levelled_pose(twin.scene_from_scan[0].translation,
                                          std::atan2(-twin.scene_from_scan[0].translation.y(),
                                                     -twin.scene_from_scan[0].translation.x()));
  station.azimuth = {-0.7, 0.7, 2.5e-3};
  station.elevation = {-0.6, 0.3, 2.5e-3};
  const Cloud cloud = simulate_scan(scene, station, {seed, 5, 0, 0});
  const std::vector<PlaneRegion> regions = detect_planes(cloud);
  const std::vector<int> region = region_of_point(cloud.size(), regions);
  std::vector<int> facet(cloud.size(), 0);
  DieFinderOptions options;
  options.edge_m = twin.nominal_edge_m;
  options.facets.fit.scanner_position = Eigen::Vector3d::Zero();
  if (const auto dice = find_dice(cloud, regions, options); dice && !dice->empty())
    for (int k = 0; k < 3; ++k)
      for (const std::uint32_t index : dice->front().facets.indices[k]) facet[index] = k + 1;
  std::string csv = "x_m,y_m,z_m,intensity,region,facet\n";
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = station.scene_from_scan * cloud.positions[i];
    fmt::format_to(std::back_inserter(csv), "{:.4f},{:.4f},{:.4f},{:.3f},{},{}\n", p.x(), p.y(),
                   p.z(), cloud.intensity[i], region[i], facet[i]);
  }
  write_file_atomically(std::filesystem::path(folder) / "figure5.csv", csv);
}

void write_pips_figure(const Twin& twin, std::uint64_t seed, const std::string& folder) {
  Scene scene;
  scene.dice.push_back(twin.die);
  const Station station =
      aimed_station(twin.scene_from_scan[0], bounding_ball(twin.die), twin.step_rad[0]);
  const SimulatedScan scan = simulate_scan_with_truth(scene, station, {seed, 6, 0, 0});
  const std::array<int, 3> pips{twin.top, twin.side, twin.master_facet};
  const RigidTransform scan_from_scene = twin.scene_from_scan[0].inverse();
  std::array<std::vector<std::uint32_t>, 3> indices;
  std::array<Plane, 3> planes;
  for (int k = 0; k < 3; ++k) {
    const Plane& plane = twin.die.facets[pips[k] - 1].plane;
    planes[k].normal = scan_from_scene.rotation * plane.normal;
    planes[k].offset_m = plane.offset_m + planes[k].normal.dot(scan_from_scene.translation);
    for (std::uint32_t i = 0; i < scan.truth.size(); ++i)
      if (scan.truth[i].surface.facet == pips[k]) indices[k].push_back(i);
  }
  const auto corner = assemble_corner(planes);
  std::array<double, 3> edges_m;
  for (int k = 0; k < 3; ++k)
    edges_m[k] = edge_length_m(twin.die.body, pips[(k + 1) % 3], pips[(k + 2) % 3]);
  const auto images =
      facet_images(scan.cloud, {indices[0], indices[1], indices[2]}, planes, *corner, edges_m);
  std::string csv = "pips,stage,row,column,value\n";
  for (int k = 0; k < 3; ++k) {
    const PipChainResult result = count_pips(images[k]);
    append_image(csv, pips[k], "raster", result.stages.raster);
    append_image(csv, pips[k], "smoothed", result.stages.smoothed);
    append_image(csv, pips[k], "binary", result.stages.binary);
    append_image(csv, pips[k], "edges", result.stages.edges);
    append_image(csv, pips[k], "clusters", result.stages.clusters);
  }
  write_file_atomically(std::filesystem::path(folder) / "figure6.csv", csv);
}

void write_figure_data(const PublishedTables& tables, std::uint64_t seed,
                       const std::string& folder) {
  const Twin twin = draw_twin(tables, "A", {}, seed, 0);
  write_extraction_figure(twin, seed, folder);
  write_pips_figure(twin, seed, folder);
  write_frame_figures(folder);
  write_calibration_figures(tables, seed, folder);
}

}  // namespace alea::experiments::die
