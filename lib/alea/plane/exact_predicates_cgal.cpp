#include "alea/cgal/kernels.hpp"
#include "alea/plane/exact_predicates.hpp"

namespace alea {
namespace {

Data::Vector_3 to_vector(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Exact::Point_3 to_exact_point(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

int exact_orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      const Eigen::Vector3d& c) {
  return static_cast<int>(CGAL::orientation(to_vector(a), to_vector(b), to_vector(c)));
}

bool exactly_parallel(const Plane& a, const Plane& b) {
  return CGAL::parallel(to_exact(a), to_exact(b));
}

int exact_sign_of_dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // An obtuse angle has a negative scalar product; the predicate is exact in the data kernel.
  return static_cast<int>(CGAL::angle(to_vector(a), to_vector(b)));
}

CornerDecision decide_corner(const std::array<Plane, 3>& planes,
                             const std::array<Eigen::Vector3d, 3>& centres_m,
                             const std::optional<Eigen::Vector3d>& scanner_position) {
  const std::array<Exact::Plane_3, 3> exact{to_exact(planes[0]), to_exact(planes[1]),
                                            to_exact(planes[2])};
  CornerDecision out;
  out.single_point = CGAL::orientation(exact[0].orthogonal_vector(), exact[1].orthogonal_vector(),
                                       exact[2].orthogonal_vector()) != CGAL::COPLANAR;
  out.convex = out.faces_scanner = true;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j)
      out.convex &=
          j == k || exact[k].oriented_side(to_exact_point(centres_m[j])) == CGAL::ON_NEGATIVE_SIDE;
    if (scanner_position)
      out.faces_scanner &=
          exact[k].oriented_side(to_exact_point(*scanner_position)) == CGAL::ON_POSITIVE_SIDE;
  }
  return out;
}

}  // namespace alea
