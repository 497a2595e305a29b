#include "alea/plane/plane_detector.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "alea/core/error.hpp"
#include "alea/plane/detectors.hpp"

namespace alea {
namespace {

constexpr std::array<std::pair<PlaneDetector, const char*>, 4> names{{
    {PlaneDetector::cells, "cells"},
    {PlaneDetector::efficient_ransac, "efficient_ransac"},
    {PlaneDetector::region_growing, "region_growing"},
    {PlaneDetector::ndt_ransac, "ndt_ransac"},
}};

void require(bool holds, const char* what) {
  if (!holds) throw usage_error(std::string("plane detection: ") + what);
}

void check(const Cloud& cloud, const PlaneDetectionOptions& o) {
  require(std::isfinite(o.tolerance_m) && o.tolerance_m > 0, "the tolerance must be positive");
  require(std::isfinite(o.cell_m) && o.cell_m >= 0,
          "the cell must be positive, or 0 for automatic");
  require(o.min_points >= 3, "a plane needs at least 3 points");
  require(o.normal_angle_rad > 0 && o.normal_angle_rad <= std::numbers::pi / 2,
          "the normal angle must lie between 0 and 90 degrees");
  require(o.miss_probability > 0 && o.miss_probability < 1,
          "the miss probability must lie between 0 and 1");
  require(o.neighbours >= 3, "normals need at least 3 neighbours");
  require(cloud.size() < std::numeric_limits<std::uint32_t>::max(),
          "a cloud of 2^32 points or more; split it");
}

}  // namespace

const char* to_string(PlaneDetector detector) {
  for (const auto& [value, name] : names)
    if (value == detector) return name;
  return "unknown";
}

PlaneDetector plane_detector_from_name(const std::string& name) {
  for (const auto& [value, known] : names)
    if (name == known) return value;
  throw usage_error("plane detector '" + name +
                    "' is unknown; use cells, efficient_ransac, region_growing or ndt_ransac");
}

std::vector<PlaneRegion> detect_planes(const Cloud& cloud, const PlaneDetectionOptions& options) {
  check(cloud, options);
  switch (options.detector) {
    case PlaneDetector::efficient_ransac:
      return detect_by_efficient_ransac(cloud, options);
    case PlaneDetector::region_growing:
      return detect_by_region_growing(cloud, options);
    case PlaneDetector::ndt_ransac:
      return detect_by_ndt_ransac(cloud, options);
    case PlaneDetector::cells:
      break;
  }
  return detect_by_cells(cloud, options);
}

}  // namespace alea
