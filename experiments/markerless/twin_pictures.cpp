#include "experiments/markerless/twin_pictures.hpp"

#include <algorithm>
#include <filesystem>

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
  options.close_radius_m = 4;
  options.half_thickness_m = 0.15;
  const std::filesystem::path stem = std::filesystem::path(folder) / name;
  write_png(stem.string() + "_estimate.png",
            overlay_picture(fixed, moving, trial.estimate, options));
  write_png(stem.string() + "_truth.png", overlay_picture(fixed, moving, trial.truth, options));
}

}  // namespace alea::experiments::markerless
