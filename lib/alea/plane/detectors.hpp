#pragma once

#include "alea/plane/plane_detector.hpp"

namespace alea {

/// The detectors behind detect_planes; options are valid when they are called.
std::vector<PlaneRegion> detect_by_cells(const Cloud& cloud, const PlaneDetectionOptions& options);
std::vector<PlaneRegion> detect_by_efficient_ransac(const Cloud& cloud,
                                                    const PlaneDetectionOptions& options);
std::vector<PlaneRegion> detect_by_region_growing(const Cloud& cloud,
                                                  const PlaneDetectionOptions& options);
std::vector<PlaneRegion> detect_by_ndt_ransac(const Cloud& cloud,
                                              const PlaneDetectionOptions& options);

}  // namespace alea
