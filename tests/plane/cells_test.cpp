#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "alea/plane/plane_detector.hpp"
#include "tests/support/named_scenes.hpp"

namespace alea {
namespace {

using testing::cube_scan;
using testing::LabelledScan;

TEST(Cells, FindTheThreeFacetsOfALoneCube) {
  for (const double edge : {0.1, 0.3, 0.5}) {
    const LabelledScan scan = cube_scan(edge, 6, 0.8, 0.0005);
    const auto regions = detect_planes(scan.cloud);
    ASSERT_EQ(regions.size(), 3u) << edge;
    for (int a = 0; a < 3; ++a) {
      const Eigen::Vector3d normal = regions[a].plane.normal;
      EXPECT_LT(std::abs(normal.dot(regions[(a + 1) % 3].plane.normal)), 0.02) << edge;
      EXPECT_TRUE(std::is_sorted(regions[a].indices.begin(), regions[a].indices.end()));
      EXPECT_GT(regions[a].plane.signed_distance(*scan.cloud.scanner_position), 0);
    }
  }
}

}  // namespace
}  // namespace alea
