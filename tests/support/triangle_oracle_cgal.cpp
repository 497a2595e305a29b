#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <vector>

#include "tests/support/triangle_oracle.hpp"

namespace alea::testing {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 to_cgal(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

struct TriangleOracle::Tree {
  Triangles triangles;
  AabbTree tree;
};

TriangleOracle::TriangleOracle(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
  for (const auto& t : mesh.triangles)
    tree_->triangles.emplace_back(to_cgal(mesh.vertices[t[0]]), to_cgal(mesh.vertices[t[1]]),
                                  to_cgal(mesh.vertices[t[2]]));
  tree_->tree.rebuild(tree_->triangles.cbegin(), tree_->triangles.cend());
  tree_->tree.build();
}

TriangleOracle::~TriangleOracle() = default;

std::optional<double> TriangleOracle::range_m(const Eigen::Vector3d& origin,
                                              const Eigen::Vector3d& direction) const {
  const Kernel::Ray_3 ray(to_cgal(origin), to_cgal(origin + direction));
  const auto hit = tree_->tree.first_intersection(ray);
  if (!hit) return std::nullopt;
  const Kernel::Point_3* const point = boost::get<Kernel::Point_3>(&hit->first);
  if (point == nullptr) return std::nullopt;  // the ray runs in the triangle's plane
  return (Eigen::Vector3d(point->x(), point->y(), point->z()) - origin).norm();
}

}  // namespace alea::testing
