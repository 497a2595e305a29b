#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/report/axes.hpp"

namespace alea {

struct ScanImageOptions {
  double longest_px = 1400;  ///< of the picture's longer side, at most
  /// Only the surroundings of a point of the scan's frame (m), and their radius (m).
  std::optional<Eigen::Vector3d> about_m;
  double radius_m = 1;
  std::optional<Eigen::Vector3d> middle_m;  ///< in the middle of a picture all round
};

/// A scan as its scanner saw it: azimuth to the left like the compass turns it backwards (x right =
/// clockwise), elevation upwards, in degrees; the picture is cut behind the point asked for, else
/// in the scan's widest gap. Where the scanner's position is unknown the scan from obliquely above,
/// in metres.
struct ScanImage {
  int width = 0;
  int height = 0;
  std::vector<std::int64_t> nearest;  ///< index of each pixel's nearest point, -1 where none is
  Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< place of the lower left (deg or m)
  double step = 1;                                ///< deg or m a pixel
  std::string x_name, y_name;                     ///< of the axes, with units
  /// Place of a point of the scan's frame in the picture; the third number is its distance.
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> place;
};

/// One pixel holds about two points, so that the picture has few holes; single holes are closed
/// with their neighbours' point.
ScanImage scan_image(const Cloud& cloud, const ScanImageOptions& options = {});

/// Paints the image with a colour for each point of the cloud, in axes of its own, and returns
/// these.
Axes draw_scan_image(Canvas& canvas, const PanelArea& area, const std::string& title,
                     const ScanImage& image, const std::vector<Rgb>& point_colours);

/// Grey values of the points: the intensity between its 0.5 % and 99.5 % quantiles; without
/// intensity one middle grey.
std::vector<Rgb> intensity_colours(const Cloud& cloud);

}  // namespace alea
