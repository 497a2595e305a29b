#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "alea/io/mesh_file.hpp"

namespace alea::testing {

/// First hits of rays on triangles by CGAL's AABB tree: predicates exact, the point in doubles.
class TriangleOracle {
 public:
  explicit TriangleOracle(const TriangleMesh& mesh);
  ~TriangleOracle();
  TriangleOracle(const TriangleOracle&) = delete;
  TriangleOracle& operator=(const TriangleOracle&) = delete;

  /// Range (m) of the nearest triangle along a ray; the direction has unit length.
  std::optional<double> range_m(const Eigen::Vector3d& origin,
                                const Eigen::Vector3d& direction) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace alea::testing
