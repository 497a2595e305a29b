#include "alea/report/scan_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "alea/core/angle.hpp"
#include "alea/die/facet_image.hpp"
#include "alea/report/view.hpp"

namespace alea {
namespace {

constexpr double points_per_pixel = 2;

/// Azimuth (deg) in the middle of the widest gap of a scan; -180 for a scan all round.
double widest_gap_deg(const Cloud& cloud, const Eigen::Vector3d& scanner) {
  constexpr int bins = 720;
  std::array<bool, bins> seen{};
  for (const Eigen::Vector3d& p : cloud.positions) {
    const double azimuth = std::atan2(p.y() - scanner.y(), p.x() - scanner.x()) * deg_per_rad;
    seen[std::clamp(static_cast<int>((azimuth + 180) / 360 * bins), 0, bins - 1)] = true;
  }
  int longest = 0, end = 0, run = 0;
  for (int i = 0; i < 2 * bins; ++i) {
    run = seen[i % bins] ? 0 : run + 1;
    if (run <= longest || run > bins) continue;
    longest = run;
    end = i;
  }
  return longest < 3 ? -180 : (end + 1 - longest / 2.0) * 360 / bins - 180;
}

/// The step at which a pixel holds the wanted number of points, from the share of a coarse raster
/// that holds any.
double pixel_step(const std::vector<Eigen::Vector2d>& places, const Eigen::Vector2d& extent,
                  const Eigen::Vector2d& low) {
  constexpr int coarse = 100;
  std::vector<bool> filled(coarse * coarse, false);
  for (const Eigen::Vector2d& p : places) {
    const Eigen::Vector2d share = (p - low).cwiseQuotient(extent) * (coarse - 1e-6);
    filled[static_cast<std::size_t>(share.y()) * coarse + static_cast<std::size_t>(share.x())] =
        true;
  }
  const double share =
      static_cast<double>(std::count(filled.begin(), filled.end(), true)) / (coarse * coarse);
  return std::sqrt(share * extent.prod() * points_per_pixel / static_cast<double>(places.size()));
}

std::function<Eigen::Vector3d(const Eigen::Vector3d&)> projection(
    const Cloud& cloud, const std::optional<Eigen::Vector3d>& middle_m) {
  if (!cloud.scanner_position) {
    const ParallelView view = view_from({-0.6, -1, 0.9});
    return [view](const Eigen::Vector3d& p) {
      const Eigen::Vector2d at = view(p);
      return Eigen::Vector3d(at.x(), at.y(), -view.nearness(p));
    };
  }
  const Eigen::Vector3d scanner = *cloud.scanner_position;
  const double cut_deg =
      middle_m
          ? std::atan2(middle_m->y() - scanner.y(), middle_m->x() - scanner.x()) * deg_per_rad - 180
          : widest_gap_deg(cloud, scanner);
  return [scanner, cut_deg](const Eigen::Vector3d& p) {
    const Eigen::Vector3d d = p - scanner;
    const double azimuth = std::atan2(d.y(), d.x()) * deg_per_rad;
    // Seen from inside, azimuth grows to the left: the picture's abscissa is its negative.
    const double from_cut = azimuth - cut_deg - 360 * std::floor((azimuth - cut_deg) / 360);
    return Eigen::Vector3d(-(cut_deg + from_cut),
                           std::atan2(d.z(), std::hypot(d.x(), d.y())) * deg_per_rad, d.norm());
  };
}

/// Closes holes of one pixel: four or more of the eight neighbours are seen.
void close_holes(ScanImage& image) {
  const std::vector<std::int64_t> before = image.nearest;
  for (int y = 1; y + 1 < image.height; ++y) {
    for (int x = 1; x + 1 < image.width; ++x) {
      if (before[y * image.width + x] >= 0) continue;
      std::int64_t found = -1;
      int seen = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const std::int64_t neighbour = before[(y + dy) * image.width + x + dx];
          seen += neighbour >= 0;
          if (neighbour >= 0) found = neighbour;
        }
      if (seen >= 4) image.nearest[y * image.width + x] = found;
    }
  }
}

}  // namespace

ScanImage scan_image(const Cloud& cloud, const ScanImageOptions& options) {
  ScanImage image;
  image.place = projection(cloud, options.about_m ? options.about_m : options.middle_m);
  image.x_name = cloud.scanner_position ? "minus azimuth (deg)" : "right (m)";
  image.y_name = cloud.scanner_position ? "elevation (deg)" : "up (m)";
  std::vector<std::int64_t> shown;
  std::vector<Eigen::Vector2d> places;
  std::vector<double> distance_m;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d& p = cloud.positions[i];
    if (options.about_m && (p - *options.about_m).norm() > options.radius_m) continue;
    const Eigen::Vector3d at = image.place(p);
    shown.push_back(static_cast<std::int64_t>(i));
    places.emplace_back(at.head<2>());
    distance_m.push_back(at.z());
  }
  if (places.empty()) return image;
  const auto [low, high] = bounds_of(places, 0.005);
  const Eigen::Vector2d extent = high - low;
  image.low = low;
  image.step = std::max(pixel_step(places, extent, low), extent.maxCoeff() / options.longest_px);
  image.width = static_cast<int>(extent.x() / image.step) + 1;
  image.height = static_cast<int>(extent.y() / image.step) + 1;
  image.nearest.assign(static_cast<std::size_t>(image.width) * image.height, -1);
  std::vector<double> depth(image.nearest.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Eigen::Vector2d cell = (places[k] - low) / image.step;
    const std::size_t pixel =
        static_cast<std::size_t>(image.height - 1 - static_cast<int>(cell.y())) * image.width +
        static_cast<std::size_t>(cell.x());
    if (distance_m[k] >= depth[pixel]) continue;
    depth[pixel] = distance_m[k];
    image.nearest[pixel] = shown[k];
  }
  close_holes(image);
  return image;
}

Axes draw_scan_image(Canvas& canvas, const PanelArea& area, const std::string& title,
                     const ScanImage& image, const std::vector<Rgb>& point_colours) {
  const Eigen::Vector2d high = image.low + image.step * Eigen::Vector2d(image.width, image.height);
  Axes axes(canvas, area,
            {.title = title,
             .x_name = image.x_name,
             .y_name = image.y_name,
             .low = image.low,
             .high = high,
             .grid = false});
  const Eigen::Vector2d from = axes.at({image.low.x(), high.y()}),
                        to = axes.at({high.x(), image.low.y()});
  for (int y = static_cast<int>(std::ceil(from.y())); y < to.y(); ++y) {
    for (int x = static_cast<int>(std::ceil(from.x())); x < to.x(); ++x) {
      const Eigen::Vector2d cell = (axes.place({x + 0.0, y + 0.0}) - image.low) / image.step;
      const int column = std::clamp(static_cast<int>(cell.x()), 0, image.width - 1);
      const int row =
          std::clamp(image.height - 1 - static_cast<int>(cell.y()), 0, image.height - 1);
      const std::int64_t i = image.nearest[static_cast<std::size_t>(row) * image.width + column];
      if (i >= 0) canvas.pixel(x, y, point_colours[static_cast<std::size_t>(i)]);
    }
  }
  return axes;
}

std::vector<Rgb> intensity_colours(const Cloud& cloud) {
  if (!cloud.has_intensity()) return std::vector<Rgb>(cloud.size(), colours::middle);
  const IntensityRange range = intensity_range(cloud.intensity);
  std::vector<Rgb> colours;
  colours.reserve(cloud.size());
  for (const float intensity : cloud.intensity) {
    const double share =
        range.high > range.low ? (intensity - range.low) / (range.high - range.low) : 0.5;
    colours.push_back(colours::grey(std::isfinite(share) ? 0.1 + 0.85 * share : 0.5));
  }
  return colours;
}

}  // namespace alea
