#include "experiments/die/mixed_axes.hpp"

#include "alea/die/corner_frame.hpp"
#include "alea/die/orthogonal_axes.hpp"

namespace alea::experiments::die {

RigidTransform turn_by_mixed_axes(const ObservedDie& master, const ObservedDie& slave,
                                  const RigidTransform& by_shared_edge) {
  const auto shared = shared_pips(master, slave);
  const Eigen::Matrix3d fixed = edge_axes(master, shared[0], shared[1], shared[0]);
  const Eigen::Matrix3d other = edge_axes(slave, shared[0], shared[1], shared[1]);
  Eigen::Matrix3d turned;
  turned << other.col(0), -other.col(2), other.col(1);
  RigidTransform estimate = by_shared_edge;
  const Eigen::Vector3d corner = corner_frame(slave, shared[0]).value().corner_m;
  const Eigen::Vector3d in_master = estimate * corner;
  estimate.rotation = fixed * turned.transpose();
  estimate.translation = in_master - estimate.rotation * corner;
  return estimate;
}

}  // namespace alea::experiments::die
