#include "alea/cgal/kernels.hpp"
#include "alea/plane/exact_predicates.hpp"

namespace alea {
namespace {

Data::Vector_3 to_vector(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
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

}  // namespace alea
