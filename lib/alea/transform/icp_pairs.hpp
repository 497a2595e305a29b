#pragma once

#include <cstdint>
#include <vector>

#include "alea/transform/icp_target.hpp"

namespace alea {

/// The pairs of one iteration, in the order of the source. `target` remembers the last nearest
/// point of each source point, which bounds the next search.
struct IcpPairs {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::vector<Eigen::Vector3d> moved;  ///< source points, target frame
  std::vector<std::uint32_t> target;   ///< nearest target point, or none
  std::vector<double> squared_m2;      ///< distance of the pair
  std::vector<std::uint8_t> used;      ///< takes part
  std::size_t count = 0;               ///< of those that do
};

/// Pairs every source point with the nearest target point; then drops those that are too far, whose
/// normals disagree, or that trimming leaves out (equal distances stay together).
void update_pairs(const IcpTarget::Data& target, const IcpPoints& source,
                  const RigidTransform& target_from_source, const IcpOptions& options,
                  IcpPairs& pairs);

}  // namespace alea
