#include "alea/die/assembly.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "alea/core/seed.hpp"

namespace alea {
namespace {

Plane random_plane(RandomStream& stream) {
  const Eigen::Vector3d normal =
      Eigen::Vector3d(stream.normal(), stream.normal(), stream.normal()).normalized();
  return {normal, 5 * stream.normal()};
}

TEST(AssembleCorner, TheExactCornerLiesOnAllThreePlanesAndLeavesWithItsRounding) {
  RandomStream stream({11, 0, 0, 0, Purpose::test});
  for (int i = 0; i < 200; ++i) {
    const std::array<Plane, 3> planes{random_plane(stream), random_plane(stream),
                                      random_plane(stream)};
    const auto corner = assemble_corner(planes);
    ASSERT_TRUE(corner);
    EXPECT_TRUE(corner->corner_on_planes);
    EXPECT_LT(corner->corner_rounding_m.norm(), 1e-13 * (1 + corner->corner_m.norm()));
    Eigen::Matrix3d normals;
    for (int k = 0; k < 3; ++k) normals.row(k) = planes[k].normal;
    EXPECT_EQ(corner->orientation, normals.determinant() > 0 ? 1 : -1);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(planes[k].signed_distance(corner->corner_m), 0,
                  1e-9 * (1 + corner->corner_m.norm()));
      EXPECT_NEAR(corner->edges[k].direction.dot(planes[(k + 1) % 3].normal), 0, 1e-15);
      EXPECT_NEAR(corner->edges[k].direction.dot(planes[(k + 2) % 3].normal), 0, 1e-15);
    }
  }
}

TEST(AssembleCorner, PlanesWithoutASingleCommonPointHaveNoCorner) {
  const Plane x{Eigen::Vector3d::UnitX(), 1}, x2{Eigen::Vector3d::UnitX(), 2},
      y{Eigen::Vector3d::UnitY(), 1};
  EXPECT_FALSE(assemble_corner({x, x2, y}));
  EXPECT_FALSE(assemble_corner({x, x, y}));
}

}  // namespace
}  // namespace alea
