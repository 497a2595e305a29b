#include "alea/facet/pointing.hpp"

namespace alea {

// A turn d of the unit ray u moves its place at range r by r (d - u (n.d) / (n.u)).
double pointing_sd_m(const Eigen::Vector3d& ray_m, const Eigen::Vector3d& normal,
                     const Eigen::Vector3d& across, double pointing_rad) {
  const double slant = across.dot(ray_m) / normal.dot(ray_m);
  return pointing_rad * ray_m.norm() * (across - slant * normal).norm();
}

}  // namespace alea
