#include "alea/cgal/kernels.hpp"
#include "alea/plane/region_decision.hpp"

namespace alea {

bool exactly_within(const std::vector<Eigen::Vector3d>& points, const Plane& plane,
                    double distance) {
  const Exact::Plane_3 exact = to_exact(plane);
  const Exact::FT limit =
      Exact::FT(distance) * distance * exact.orthogonal_vector().squared_length();
  for (const Eigen::Vector3d& p : points) {
    const Exact::FT value = exact.a() * p.x() + exact.b() * p.y() + exact.c() * p.z() + exact.d();
    if (value * value > limit) return false;
  }
  return true;
}

}  // namespace alea
