#include "alea/report/die_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "alea/die/assembly.hpp"
#include "alea/die/pip_layout.hpp"
#include "alea/die/pips_chain.hpp"
#include "alea/report/axes.hpp"
#include "alea/report/scan_image.hpp"

namespace alea {
namespace {

constexpr double usual_spacing = 0.25, usual_radius = 0.09;  // of the pips, share of the edge

Rgb colour_of(FacetPointFate fate) {
  switch (fate) {
    case FacetPointFate::used:
      return colours::used;
    case FacetPointFate::border:
      return colours::middle;
    case FacetPointFate::pip_mask:
      return colours::masked;
    case FacetPointFate::off_plane:
      return colours::slave;
  }
  return colours::ink;
}

std::string facet_name(const DrawnDie& die, int k) {
  return die.pips[k] > 0 ? fmt::format("facet {}", die.pips[k]) : std::string("facet, not read");
}

void draw_die_in_scan(Canvas& canvas, const PanelArea& area, const Cloud& cloud,
                      const DrawnDie& die, const std::array<FacetView, 3>& views,
                      const std::string& scan_name) {
  std::vector<Rgb> colours = intensity_colours(cloud);
  for (const FacetView& view : views)
    for (std::size_t i = 0; i < view.indices.size(); ++i) {
      Rgb& colour = colours[view.indices[i]];
      colour = colours::mixed(colour, colour_of(view.fate[i]), 0.55);
    }
  const ScanImage image =
      scan_image(cloud, {.about_m = die.centre_m(), .radius_m = 1.5 * die.longest_edge_m()});
  Axes axes = draw_scan_image(canvas, area, scan_name, image, colours);
  const auto corners = die.corners_m();
  for (int k = 0; k < 3; ++k) {
    const unsigned u = 1U << (k + 1) % 3, v = 1U << (k + 2) % 3;
    const Eigen::Vector2d middle = image.place((corners[u] + corners[v]) / 2).head<2>();
    axes.text(middle, die.pips[k] > 0 ? std::to_string(die.pips[k]) : "?",
              {.height_px = 16, .anchor = TextAnchor::centre, .halo = true});
    for (const unsigned start : {0U, v})
      axes.line(image.place(corners[start]).head<2>(), image.place(corners[start | u]).head<2>(),
                colours::masked, 1);
    axes.line(image.place(corners[u]).head<2>(), image.place(corners[u | v]).head<2>(),
              colours::masked, 1);
  }
}

void draw_facet(Canvas& canvas, const PanelArea& area, const DrawnDie& die, int k,
                const FacetView& view) {
  const Eigen::Vector2d lengths(die.edges_m[(k + 1) % 3], die.edges_m[(k + 2) % 3]);
  Axes axes(canvas, area,
            {.title = fmt::format("{}: {} of {}, {:.2f} mm", facet_name(die, k), die.used[k].size(),
                                  view.uv_m.size(), die.rmse_m[k] * 1e3),
             .x_name = "u from the corner (m)",
             .y_name = "v (m)",
             .low = -0.1 * lengths,
             .high = 1.1 * lengths,
             .grid = false});
  const double spacing_px =
      axes.pixels_per_x() *
      std::sqrt(lengths.prod() / std::max<double>(1, static_cast<double>(view.uv_m.size())));
  const double radius_px = std::clamp(0.4 * spacing_px, 0.5, 3.0);
  for (std::size_t i = 0; i < view.uv_m.size(); ++i)
    axes.point(view.uv_m[i], colour_of(view.fate[i]), radius_px);
  const std::array<Eigen::Vector2d, 5> outline{
      Eigen::Vector2d(0, 0), {lengths.x(), 0}, lengths, {0, lengths.y()}, {0, 0}};
  axes.polyline(outline, colours::ink);
}

/// A grey or labelled image over the facet.
Axes draw_stage(Canvas& canvas, const PanelArea& area, const std::string& title,
                const GreyImage& image, bool labelled) {
  Axes axes(canvas, area,
            {.title = title,
             .low = {0, 0},
             .high = {std::max(image.width, 1), std::max(image.height, 1)},
             .frame = false});
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const float value : image.pixels)
    if (std::isfinite(value))
      low = std::min<double>(low, value), high = std::max<double>(high, value);
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const float value = image.pixels[static_cast<std::size_t>(row) * image.width + column];
      const Rgb colour =
          !std::isfinite(value) ? (labelled ? colours::white : colours::light)
          : labelled ? (value > 0 ? colours::categorical(static_cast<std::size_t>(value) - 1)
                                  : colours::light)
                     : colours::grey(high > low ? (value - low) / (high - low) : 0.5);
      const Eigen::Vector2d upper = axes.at({column, row + 1.0}),
                            lower = axes.at({column + 1.0, row});
      canvas.box({std::ceil(upper.x()), std::ceil(upper.y())},
                 {std::ceil(lower.x()) - 1, std::ceil(lower.y()) - 1}, colour);
    }
  }
  return axes;
}

/// Mean of the pixels within a pip's radius about a place of the lattice; NaN where none is seen.
double mean_at_place(const GreyImage& image, int place) {
  const Eigen::Vector2d size(image.width, image.height);
  const Eigen::Vector2d centre = pip_place(place, usual_spacing).cwiseProduct(size);
  const double radius = 0.8 * usual_radius * size.minCoeff();
  double sum = 0, count = 0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const float value = image.pixels[static_cast<std::size_t>(row) * image.width + column];
      if (!std::isfinite(value)) continue;
      if ((Eigen::Vector2d(column + 0.5, row + 0.5) - centre).norm() > radius) continue;
      sum += value;
      ++count;
    }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

/// Of the forms that show this many pips the one that stands out more.
PipPattern pattern_shown(const GreyImage& image, int pips) {
  PipPattern best{pips, 0};
  double best_contrast = -1;
  for (const PipPattern& pattern : pip_patterns) {
    if (pattern.pips != pips) continue;
    double with = 0, without = 0;
    for (int place = 0; place < pip_places; ++place) {
      const double mean = mean_at_place(image, place);
      if (!std::isfinite(mean)) continue;
      (pattern.has(place) ? with : without) +=
          mean / (pattern.has(place) ? pips : pip_places - pips);
    }
    if (std::abs(with - without) <= best_contrast) continue;
    best_contrast = std::abs(with - without);
    best = pattern;
  }
  return best;
}

void draw_decision(Canvas& canvas, const PanelArea& area, const DrawnDie& die, int k,
                   const GreyImage& raster) {
  const std::string title =
      die.pips[k] > 0 ? fmt::format("decision: {} (p = {:.4f})", die.pips[k], die.probability[k])
                      : std::string("decision: not read");
  Axes axes = draw_stage(canvas, area, title, raster, false);
  if (die.pips[k] == 0 || raster.width == 0) return;
  const PipPattern pattern = pattern_shown(raster, die.pips[k]);
  const Eigen::Vector2d size(raster.width, raster.height);
  for (int place = 0; place < pip_places; ++place) {
    const Eigen::Vector2d centre = axes.at(pip_place(place, usual_spacing).cwiseProduct(size));
    const double radius = usual_radius * size.minCoeff() * axes.pixels_per_x();
    if (pattern.has(place))
      canvas.circle(centre, radius, colours::slave, 2);
    else
      canvas.disc(centre, 2.5, colours::master);
  }
}

}  // namespace

Picture facets_picture(const Cloud& cloud, const DrawnDie& die, const std::string& scan_name) {
  Canvas canvas(1560, 460);
  const auto views = facet_views(cloud, die);
  const auto panel = [&](int number) {
    PanelArea area = grid_panel(canvas, 4, 1, number);
    area.height -= 30;
    return area;
  };
  draw_die_in_scan(canvas, panel(0), cloud, die, views, scan_name + ": the die in the scan");
  for (int k = 0; k < 3; ++k) draw_facet(canvas, panel(k + 1), die, k, views[k]);
  draw_legend_row(canvas, {480, 446},
                  {{"used by the fit", colour_of(FacetPointFate::used)},
                   {"border, trimmed", colour_of(FacetPointFate::border)},
                   {"pip, masked", colour_of(FacetPointFate::pip_mask)},
                   {"off the plane", colour_of(FacetPointFate::off_plane)}});
  return canvas.picture();
}

Picture pips_picture(const Cloud& cloud, const DrawnDie& die) {
  constexpr int columns = 6;
  Canvas canvas(1500, 3 * 275);
  const auto corner = assemble_corner(die.corner.planes);
  if (!corner) return canvas.picture();
  const auto images = facet_images(cloud, {die.read[0], die.read[1], die.read[2]},
                                   die.corner.planes, *corner, die.edges_m);
  for (int k = 0; k < 3; ++k) {
    const PipChainResult chain = count_pips(images[k]);
    const auto area = [&](int column) {
      return grid_panel(canvas, columns, 3, columns * k + column);
    };
    const PipChainStages& stages = chain.stages;
    draw_stage(canvas, area(0), facet_name(die, k) + ": raster", stages.raster, false);
    draw_stage(canvas, area(1), "low-passed", stages.smoothed, false);
    draw_stage(canvas, area(2), "binary (Otsu)", stages.binary, false);
    draw_stage(canvas, area(3), "edges (Canny)", stages.edges, false);
    draw_stage(canvas, area(4), fmt::format("clusters: {} pips", chain.count), stages.clusters,
               true);
    draw_decision(canvas, area(5), die, k, stages.raster);
  }
  return canvas.picture();
}

}  // namespace alea
