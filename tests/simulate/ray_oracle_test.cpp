#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "alea/core/seed.hpp"
#include "alea/simulate/die_ray.hpp"
#include "alea/simulate/primitive_ray.hpp"
#include "tests/support/triangle_oracle.hpp"

namespace alea {
namespace {

/// The boundary of a convex body: each plane's corners as a fan, seen from outside.
TriangleMesh boundary(const std::vector<Eigen::Vector3d>& corners,
                      const std::vector<Plane>& planes) {
  TriangleMesh mesh{corners, {}};
  for (const Plane& plane : planes) {
    std::vector<std::int64_t> face;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (std::abs(plane.signed_distance(corners[i])) < 1e-9) {
        face.push_back(static_cast<std::int64_t>(i));
        centre += corners[i];
      }
    centre /= static_cast<double>(face.size());
    const Eigen::Matrix<double, 3, 2> basis = tangent_basis(plane.normal);
    const auto angle = [&](std::int64_t i) {
      const Eigen::Vector2d at =
          basis.transpose() * (corners[static_cast<std::size_t>(i)] - centre);
      return std::atan2(at.y(), at.x());
    };
    std::sort(face.begin(), face.end(),
              [&](std::int64_t a, std::int64_t b) { return angle(a) < angle(b); });
    add_face(face, corners.size(), "test", mesh);
  }
  return mesh;
}

/// A lumpy ball of triangles about the origin: 2 m across, lumps of 0.3 m.
TriangleMesh lumpy_ball(int rings, std::uint64_t trial) {
  const RandomStream random({1, 0, trial, 0, Purpose::test});
  TriangleMesh mesh;
  const int columns = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < columns; ++k) {
      const double polar = M_PI * i / rings, azimuth = 2 * M_PI * k / columns;
      const bool pole = i == 0 || i == rings;
      const double radius =
          1 + (pole ? 0.0 : 0.3 * random.uniform_at(static_cast<std::uint64_t>(i * columns + k)));
      mesh.vertices.emplace_back(radius * Eigen::Vector3d(std::sin(polar) * std::cos(azimuth),
                                                          std::sin(polar) * std::sin(azimuth),
                                                          std::cos(polar)));
    }
  const auto at = [columns](int i, int k) { return std::int64_t{i} * columns + k % columns; };
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < columns; ++k) {
      if (i > 0) add_face({at(i, k), at(i + 1, k), at(i, k + 1)}, mesh.vertices.size(), "", mesh);
      if (i + 1 < rings)
        add_face({at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)}, mesh.vertices.size(), "", mesh);
    }
  return mesh;
}

/// Rays from about 4 m off towards the surroundings of the origin.
Ray random_ray(const RandomStream& random, std::uint64_t number) {
  const auto vector = [&](std::uint64_t at) {
    const auto [x, y] = random.normal2_at(at);
    return Eigen::Vector3d(x, y, random.normal_at(at + 1));
  };
  Ray ray;
  ray.origin = 4 * vector(4 * number).normalized();
  ray.direction = (0.5 * vector(4 * number + 2) - ray.origin).normalized();
  return ray;
}

struct Agreement {
  int hits = 0;
  int differ = 0;        ///< one hits and the other does not
  double largest_m = 0;  ///< difference of the ranges where both hit
};

template <typename Object>
Agreement compare(const Object& object, const TriangleMesh& mesh, const Eigen::Vector3d& shift_m,
                  int rays) {
  const testing::TriangleOracle oracle(mesh);
  const RandomStream random({7, 0, 0, 0, Purpose::test});
  Agreement agreement;
  for (int i = 0; i < rays; ++i) {
    Ray ray = random_ray(random, static_cast<std::uint64_t>(i));
    ray.origin += shift_m;
    Hit hit;
    intersect(object, 0, ray, hit);
    const auto expected = oracle.range_m(ray.origin, ray.direction);
    const bool both = expected && std::isfinite(hit.range_m);
    agreement.hits += both;
    agreement.differ += expected.has_value() != std::isfinite(hit.range_m);
    if (both)
      agreement.largest_m = std::max(agreement.largest_m, std::abs(hit.range_m - *expected));
  }
  return agreement;
}

TEST(RayOracle, ADieIsHitWhereItsTrianglesAre) {
  DieModel model;
  model.size_m = {0.9, 1.1, 1.4};
  model.scene_from_die = standing_pose(Chirality::clockwise, 3, 1, 0.7, {0.1, -0.2, 0.05});
  model = with_random_shape(model, {.tilt_sd_rad = 0.05, .offset_sd_m = 0.02}, 3, 0, 0);
  const Die die = build_die(model);
  const TriangleMesh mesh = boundary({die.body.corners_m.begin(), die.body.corners_m.end()},
                                     {die.body.planes.begin(), die.body.planes.end()});
  ASSERT_EQ(mesh.triangles.size(), 12u);
  const Agreement agreement = compare(die, mesh, Eigen::Vector3d::Zero(), 5000);
  EXPECT_GT(agreement.hits, 1500);
  EXPECT_EQ(agreement.differ, 0);
  EXPECT_LT(agreement.largest_m, 1e-12);
}

TEST(RayOracle, ABoxIsHitWhereItsTrianglesAre) {
  Box box{"box", {0.8, 1.5, 1.1}, {rotation_exp({0.4, -0.7, 1.1}), {0.1, 0, -0.2}}, 0.5};
  std::vector<Eigen::Vector3d> corners;
  std::vector<Plane> planes;
  for (int c = 0; c < 8; ++c)
    corners.push_back(box.scene_from_box * Eigen::Vector3d(((c & 1) - 0.5) * 0.8,
                                                           ((c >> 1 & 1) - 0.5) * 1.5,
                                                           ((c >> 2 & 1) - 0.5) * 1.1));
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d normal = side * box.scene_from_box.rotation.col(axis);
      planes.push_back({normal, normal.dot(box.scene_from_box.translation) + box.size_m[axis] / 2});
    }
  const TriangleMesh mesh = boundary(corners, planes);
  const Agreement agreement = compare(box, mesh, Eigen::Vector3d::Zero(), 5000);
  EXPECT_GT(agreement.hits, 1500);
  EXPECT_EQ(agreement.differ, 0);
  EXPECT_LT(agreement.largest_m, 1e-12);
}

// Single precision finds the triangle: near an edge it may take the neighbour, whose plane is then
// a little off (by the rounding times the slope), and a silhouette may be missed by a hair.
TEST(RayOracle, AMeshIsHitWhereItsTrianglesAre) {
  for (const double shift_m : {0.0, 5e5}) {
    TriangleMesh body = lumpy_ball(40, 1);
    ASSERT_EQ(body.triangles.size(), 6240u);
    const Eigen::Vector3d shift(shift_m, -shift_m, 0.1 * shift_m);
    for (Eigen::Vector3d& vertex : body.vertices) vertex += shift;
    const Mesh mesh = build_mesh("ball", body);
    const Agreement agreement = compare(mesh, body, shift, 4000);
    EXPECT_GT(agreement.hits, 1500);
    EXPECT_LE(agreement.differ, 2);
    EXPECT_LT(agreement.largest_m, shift_m == 0 ? 1e-5 : 2e-5);
  }
}

}  // namespace
}  // namespace alea
