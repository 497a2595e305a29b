#include "experiments/markerless/twin_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "alea/cloud/sampling.hpp"
#include "alea/report/axes.hpp"
#include "alea/report/overlay_picture.hpp"
#include "alea/report/view.hpp"

namespace alea::experiments::markerless {
namespace {

std::size_t index_of(const TwinScans& scans, const std::string& name) {
  return static_cast<std::size_t>(std::find(scans.names.begin(), scans.names.end(), name) -
                                  scans.names.begin());
}

/// One panel of the keypoint figure: the building as the station sees it from somewhat above; grey
/// by distance, keypoints in red.
void draw_step(Canvas& canvas, int panel, const std::string& title, const RigidTransform& pose,
               const Cloud& cloud, const Cloud* keypoints) {
  constexpr double radius_m = 6.5, height_m = 9;
  const auto is_shown = [&](const Eigen::Vector3d& p) {
    return p.head<2>().norm() < radius_m && p.z() < height_m;
  };
  const Eigen::Vector3d aside(-pose.translation.y(), pose.translation.x(), 0);
  const ParallelView view = view_from(pose.translation + 0.4 * aside + Eigen::Vector3d(0, 0, 2));
  std::vector<Eigen::Vector3d> points;
  std::vector<Rgb> shades;
  for (const Eigen::Vector3d& scan_point : cloud.positions) {
    const Eigen::Vector3d p = pose * scan_point;
    if (!is_shown(p)) continue;
    points.push_back(p);
    const double shade = 0.5 - 0.5 * view.nearness(p) / radius_m;
    shades.push_back(
        colours::grey(keypoints != nullptr ? 0.75 : 0.75 * std::clamp(shade, 0.0, 1.0)));
  }
  AxesOptions options;
  options.title = title;
  options.frame = options.grid = false;
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector3d& p : points) places.push_back(view(p));
  std::tie(options.low, options.high) = bounds_of(places, 0.02);
  Axes axes(canvas, grid_panel(canvas, 3, 1, panel), options);
  draw_points(axes, view, points, shades, 0.5);
  if (keypoints == nullptr) return;
  for (const Eigen::Vector3d& scan_point : keypoints->positions)
    if (const Eigen::Vector3d p = pose * scan_point; is_shown(p))
      axes.point(view(p), colours::slave, 3);
}

}  // namespace

void draw_station_plan(const TwinScans& scans, const std::string& title, const std::string& folder,
                       const std::string& name) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Rgb> colours_of;
  for (std::size_t s = 0; s < scans.clouds.size(); ++s)
    for (const Eigen::Vector3d& p : grid_average(scans.clouds[s], 0.2).positions) {
      points.push_back(scans.scene_from_scan[s] * p);
      colours_of.push_back(colours::mixed(colours::categorical(s), colours::white, 0.45));
    }
  Canvas canvas(900, 900);
  AxesOptions options;
  options.title = title;
  options.x_name = "x (m)";
  options.y_name = "y (m)";
  options.low = {-16, -16};
  options.high = {16, 16};
  Axes axes(canvas, grid_panel(canvas, 1, 1, 0), options);
  draw_points(axes, view_from({0, 0, 1}), points, colours_of, 1);
  TextStyle style;
  style.halo = true;
  for (std::size_t s = 0; s < scans.names.size(); ++s) {
    const Eigen::Vector2d place = scans.scene_from_scan[s].translation.head<2>();
    axes.point(place, colours::black, 4);
    axes.text(place + Eigen::Vector2d(0.3, 0.3), scans.names[s], style);
  }
  write_png(std::filesystem::path(folder) / (name + ".png"), canvas.picture());
}

void draw_overlays(const TwinScans& scans, const PaperTrial& trial, const std::string& folder,
                   const std::string& name) {
  const std::size_t f = index_of(scans, trial.fixed), m = index_of(scans, trial.moving);
  const Cloud fixed = grid_average(scans.clouds[f], 0.05);
  const Cloud moving = grid_average(scans.clouds[m], 0.05);
  OverlayOptions options;
  options.about_m = scans.scene_from_scan[f].inverse() * Eigen::Vector3d(0, 0, 2.5);
  options.close_radius_m = 6.5;
  options.half_thickness_m = 0.15;
  options.master_name = trial.fixed;
  options.slave_name = trial.moving;
  const std::string pair = trial.fixed + " - " + trial.moving;
  const Picture picture = overlay_comparison(
      fixed, moving, {{{pair + ", estimate", trial.estimate}, {pair + ", truth", trial.truth}}},
      options);
  write_png(std::filesystem::path(folder) / (name + ".png"), picture);
}

void draw_keypoints(const TwinScans& scans, std::size_t station, const std::string& folder,
                    const std::string& name) {
  PaperIcpOptions paper;
  paper.keypoints = PaperKeypoints::harris;
  const Cloud& raw = scans.clouds[station];
  const PaperScan prepared = prepare_paper_scan(raw, paper, true);
  const RigidTransform& pose = scans.scene_from_scan[station];
  Canvas canvas(1500, 480);
  draw_step(canvas, 0, fmt::format("{}: {} points", scans.names[station], raw.size()), pose, raw,
            nullptr);
  draw_step(canvas, 1, fmt::format("grid average 0.05 m: {} points", prepared.grid.size()), pose,
            prepared.grid, nullptr);
  draw_step(canvas, 2, fmt::format("{} Harris keypoints", prepared.keypoints->size()), pose,
            prepared.grid, &*prepared.keypoints);
  write_png(std::filesystem::path(folder) / (name + ".png"), canvas.picture());
}

}  // namespace alea::experiments::markerless
