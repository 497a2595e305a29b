#include <gtest/gtest.h>

#include <cmath>

#include "alea/checkerboard/board.hpp"
#include "alea/core/angle.hpp"
#include "alea/transform/icp_target.hpp"

namespace alea {
namespace {

// The 2 x 2 board is its own image after half a turn, so that of the gradients at two opposite
// points one is the other's negative. Thirty neighbours on a raster end amid a ring of eight.
TEST(ColouredIcp, GradientsOfARasterFavourNoDirection) {
  IcpOptions options;
  options.objective = IcpObjective::coloured;
  options.max_distance_m = 1;
  const IcpTarget target(board_template({2, 2, 0.5}, 20), options);
  const IcpTarget::Data& data = target.data();
  double steepest = 0;
  for (std::size_t i = 0; i < data.gradients.size(); ++i) {
    const auto opposite = data.index->nearest_one(-data.points.positions[i], 1e-6);
    ASSERT_TRUE(opposite);
    EXPECT_LT((data.gradients[i] + data.gradients[opposite->index]).norm(), 1e-9);
    steepest = std::max(steepest, data.gradients[i].norm());
  }
  EXPECT_GT(steepest, 1);
}

// The first step turns the board by 65 deg. Moved as a screw the board would end half a turn off.
TEST(ColouredIcp, FirstStepMovesTheMeanOfThePairsAsTheSystemSays) {
  const Cloud board = board_template({2, 2, 0.5}, 20);
  const Eigen::Vector3d shift =
      0.9 * Eigen::Vector3d(std::cos(129.49 * deg), std::sin(129.49 * deg), 0);
  Cloud target = board;
  for (Eigen::Vector3d& p : target.positions) p += shift;
  IcpOptions options;
  options.objective = IcpObjective::coloured;
  options.max_distance_m = 1;
  const RigidTransform found = icp(target, board, {}, options).target_from_source;
  EXPECT_LT((found.translation - shift).norm(), 1e-6);
  EXPECT_LT(rotation_angle_rad(found.rotation), 1e-6);
}

}  // namespace
}  // namespace alea
