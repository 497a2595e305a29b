#include "alea/die/pips_chain.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "alea/core/error.hpp"
#include "alea/die/dbscan.hpp"

namespace alea {
namespace {

constexpr float unmeasured = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t fewest_points = 30;

GreyImage to_image(const cv::Mat& pixels, double pixel_m) {
  cv::Mat1f values;
  pixels.convertTo(values, CV_32F);
  return {values.cols, values.rows, std::vector<float>(values.begin(), values.end()), pixel_m};
}

/// Fine enough to resolve a pip, coarse enough that most pixels hold a point.
double automatic_pixel_m(const FacetImageInput& image) {
  const double edge_m = std::min(image.edge_u_m, image.edge_v_m);
  const double spacing_m =
      std::sqrt(image.edge_u_m * image.edge_v_m / static_cast<double>(image.uv_m.size()));
  return std::clamp(1.1 * spacing_m, edge_m / 120, edge_m / 8);
}

/// Sums of whole intensity levels, exact in doubles, so that the order of points does not matter.
struct PixelSums {
  cv::Mat1d level, count;
};

constexpr double top_level = 65535;

PixelSums bin_points(const FacetImageInput& image, IntensityRange range, double pixel_m) {
  const int width = static_cast<int>(std::ceil(image.edge_u_m / pixel_m));
  const int height = static_cast<int>(std::ceil(image.edge_v_m / pixel_m));
  PixelSums sums{cv::Mat1d(height, width, 0.0), cv::Mat1d(height, width, 0.0)};
  for (std::size_t i = 0; i < image.uv_m.size(); ++i) {
    const Eigen::Vector2d at = image.uv_m[i] / pixel_m;
    if (!(at.x() >= 0 && at.x() < width && at.y() >= 0 && at.y() < height)) continue;
    if (!std::isfinite(image.intensity[i])) continue;
    const double share = (image.intensity[i] - range.low) / (range.high - range.low);
    const int row = static_cast<int>(at.y()), column = static_cast<int>(at.x());
    sums.level(row, column) += std::round(top_level * std::clamp(share, 0.0, 1.0));
    sums.count(row, column) += 1;
  }
  return sums;
}

struct Raster {
  cv::Mat1f mean;    // NaN where no point fell
  cv::Mat1f smooth;  // normalised convolution: gaps take the mean of what lies around them
  cv::Mat1b inside;  // within the border and reached by the low-pass
};

Raster rasterise(const FacetImageInput& image, double pixel_m, const PipChainOptions& options) {
  const IntensityRange range = intensity_range(image.intensity);
  if (!(range.high > range.low)) return {};
  const PixelSums sums = bin_points(image, range, pixel_m);
  Raster raster{cv::Mat1f(sums.count.size(), unmeasured), cv::Mat1f(sums.count.size(), unmeasured),
                cv::Mat1b(sums.count.size(), std::uint8_t{0})};
  cv::Mat1d smooth_level, smooth_count;
  const double sd = options.low_pass_sd_pixels;
  cv::GaussianBlur(sums.level, smooth_level, {0, 0}, sd, sd, cv::BORDER_CONSTANT);
  cv::GaussianBlur(sums.count, smooth_count, {0, 0}, sd, sd, cv::BORDER_CONSTANT);
  const auto intensity = [&](double level, double count) {
    return static_cast<float>(range.low + (range.high - range.low) * level / count / top_level);
  };
  const double least_weight = 0.02 * cv::mean(sums.count)[0];
  for (int row = 0; row < raster.mean.rows; ++row)
    for (int column = 0; column < raster.mean.cols; ++column) {
      const double x = (column + 0.5) * pixel_m / image.edge_u_m;
      const double y = (row + 0.5) * pixel_m / image.edge_v_m;
      const double count = sums.count(row, column), reached = smooth_count(row, column);
      if (count > 0) raster.mean(row, column) = intensity(sums.level(row, column), count);
      if (reached <= least_weight) continue;
      raster.smooth(row, column) = intensity(smooth_level(row, column), reached);
      const double from = options.border, to = 1 - options.border;
      raster.inside(row, column) = x > from && x < to && y > from && y < to ? 1 : 0;
    }
  return raster;
}

/// 255 on the rarer of Otsu's two classes: pips cover at most a sixth of a facet, and are darker or
/// lighter than it.
cv::Mat1b binarise(const Raster& raster) {
  cv::Mat1b binary(raster.smooth.size(), std::uint8_t{0});
  double low = 0, high = 0;
  cv::minMaxLoc(raster.smooth, &low, &high, nullptr, nullptr, raster.inside);
  if (!(high > low)) return binary;
  std::vector<std::uint8_t> levels;
  for (int i = 0; i < static_cast<int>(raster.inside.total()); ++i)
    if (raster.inside(i) != 0)
      levels.push_back(
          static_cast<std::uint8_t>(std::lround(255 * (raster.smooth(i) - low) / (high - low))));
  cv::Mat1b classes;
  cv::threshold(cv::Mat1b(levels, false), classes, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  const bool light_pips = 2 * cv::countNonZero(classes) < static_cast<int>(levels.size());
  int next = 0;
  for (int i = 0; i < static_cast<int>(raster.inside.total()); ++i)
    if (raster.inside(i) != 0) binary(i) = (classes(next++) != 0) == light_pips ? 255 : 0;
  return binary;
}

struct EdgeCluster {
  Eigen::AlignedBox2d box;  // pixels
  std::vector<std::size_t> members;
};

std::vector<EdgeCluster> cluster_edges(const std::vector<Eigen::Vector2d>& edge_pixels) {
  const std::vector<int> labels = dbscan(edge_pixels, {1.5, 3});
  std::vector<EdgeCluster> clusters;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < 0) continue;
    const auto label = static_cast<std::size_t>(labels[i]);
    if (label >= clusters.size()) clusters.resize(label + 1);
    clusters[label].box.extend(edge_pixels[i]);
    clusters[label].members.push_back(i);
  }
  return clusters;
}

/// As wide as a pip may be, in both directions, and about as wide as long.
bool is_pip(const EdgeCluster& cluster, double edge_pixels, const PipChainOptions& options) {
  const Eigen::Vector2d widths = cluster.box.sizes().array() + 1;
  return widths.minCoeff() >= options.smallest_pip * edge_pixels &&
         widths.maxCoeff() <= options.largest_pip * edge_pixels &&
         widths.maxCoeff() <= 2 * widths.minCoeff();
}

}  // namespace

PipChainResult count_pips(const FacetImageInput& image, const PipChainOptions& options) {
  if (!(image.edge_u_m > 0 && image.edge_v_m > 0))
    throw usage_error("count_pips: the facet's edges must be positive lengths");
  PipChainResult result;
  if (image.uv_m.size() < fewest_points) return result;
  const double pixel_m = options.pixel_m > 0 ? options.pixel_m : automatic_pixel_m(image);
  const Raster raster = rasterise(image, pixel_m, options);
  if (raster.mean.empty()) return result;
  const cv::Mat1b binary = binarise(raster);
  cv::Mat1b edges;
  cv::Canny(binary, edges, 50, 150);

  std::vector<Eigen::Vector2d> edge_pixels;
  for (int row = 0; row < edges.rows; ++row)
    for (int column = 0; column < edges.cols; ++column)
      if (edges(row, column) != 0) edge_pixels.emplace_back(column, row);
  cv::Mat1f labelled(edges.size(), unmeasured);
  for (const Eigen::Vector2d& p : edge_pixels)
    labelled(static_cast<int>(p.y()), static_cast<int>(p.x())) = 0;
  const double shorter_edge_pixels = std::min(image.edge_u_m, image.edge_v_m) / pixel_m;
  for (const EdgeCluster& cluster : cluster_edges(edge_pixels)) {
    if (!is_pip(cluster, shorter_edge_pixels, options)) continue;
    result.centres_m.emplace_back((cluster.box.center().array() + 0.5) * pixel_m);
    for (const std::size_t i : cluster.members)
      labelled(static_cast<int>(edge_pixels[i].y()), static_cast<int>(edge_pixels[i].x())) =
          static_cast<float>(result.centres_m.size());
  }
  result.count = result.centres_m.size() <= 6 ? static_cast<int>(result.centres_m.size()) : 0;
  result.stages = {to_image(raster.mean, pixel_m), to_image(raster.smooth, pixel_m),
                   to_image(binary / 255, pixel_m), to_image(edges / 255, pixel_m),
                   to_image(labelled, pixel_m)};
  return result;
}

}  // namespace alea
