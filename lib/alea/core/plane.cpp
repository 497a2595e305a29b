#include "alea/core/plane.hpp"

#include <Eigen/Geometry>

namespace alea {

Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& normal) {
  int smallest = 0;
  normal.cwiseAbs().minCoeff(&smallest);
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = normal.cross(Eigen::Vector3d::Unit(smallest)).normalized();
  basis.col(1) = normal.cross(basis.col(0));
  return basis;
}

}  // namespace alea
