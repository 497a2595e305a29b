#include "alea/cgal/kernels.hpp"
#include "alea/die/corner_decision.hpp"

namespace alea {
namespace {

Exact::Point_3 to_exact_point(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

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
