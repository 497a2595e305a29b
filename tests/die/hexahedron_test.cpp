#include "alea/die/hexahedron.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "alea/core/seed.hpp"
#include "alea/simulate/die_model.hpp"

namespace alea {
namespace {

std::array<Plane, 6> cube_planes() {
  return die_planes({});
}

TEST(Hexahedron, CubeHasItsEightCorners) {
  const auto body = assemble_hexahedron(cube_planes());
  ASSERT_TRUE(body);
  for (int c = 0; c < 8; ++c) {
    EXPECT_EQ(body->corners_m[c].cwiseAbs(), Eigen::Vector3d::Constant(0.25)) << c;
    for (const int f : facets_of_corner(c))
      EXPECT_EQ(body->planes[f].signed_distance(body->corners_m[c]), 0) << c << " on " << f;
  }
  EXPECT_EQ(body->orientation, -1) << "the default hand is clockwise";
}

TEST(Hexahedron, AcceptsEveryMildlyTiltedDieAndItsCornersAreConvex) {
  DieSpread spread;
  spread.tilt_sd_rad = 0.035;
  spread.size_sd_share = 0.05;
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    const auto planes = die_planes(with_random_shape({}, spread, 1, 0, trial));
    const auto body = assemble_hexahedron(planes);
    ASSERT_TRUE(body) << trial;
    for (const Eigen::Vector3d& corner : body->corners_m)
      for (const Plane& plane : planes) EXPECT_LT(plane.signed_distance(corner), 1e-12);
  }
}

TEST(Hexahedron, RefusesPlanesThatDoNotClose) {
  auto open = cube_planes();
  open[5] = open[0];  // two facets on one side: unbounded below
  EXPECT_FALSE(assemble_hexahedron(open));

  auto inverted = cube_planes();
  inverted[5].offset_m = -0.3;  // the opposite facets have passed each other: nothing inside
  EXPECT_FALSE(assemble_hexahedron(inverted));

  auto cut = cube_planes();  // facet 1 cuts off the edge where 6 meets 2
  cut[0].normal = Eigen::Vector3d(0, 1.2, 1).normalized();
  cut[0].offset_m = 0;
  EXPECT_FALSE(assemble_hexahedron(cut));
}

TEST(Hexahedron, DecidesTheTouchingCornerExactly) {
  // Facet 1 in y + z = c meets facet 2 (y = 1/4) at z = c - 1/4: on facet 6 for c = 0, strictly
  // above it for the smallest positive double, which no sum of doubles would notice.
  auto planes = cube_planes();
  planes[0] = {Eigen::Vector3d(0, 1, 1), 0};
  EXPECT_FALSE(assemble_hexahedron(planes));
  planes[0].offset_m = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(assemble_hexahedron(planes));
}

}  // namespace
}  // namespace alea
