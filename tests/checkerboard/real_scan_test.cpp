#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "alea/checkerboard/board_finder.hpp"
#include "alea/io/cloud_file.hpp"

namespace alea {
namespace {

constexpr const char* needs_frames =
    "set ALEA_DATASETS to the folder that holds checkerboard-pandar64";

/// Empty where they are not there.
std::filesystem::path frames_folder() {
  const char* folder = std::getenv("ALEA_DATASETS");
  if (folder == nullptr) return {};
  const auto frames = std::filesystem::path(folder) / "checkerboard-pandar64";
  return std::filesystem::exists(frames) ? frames : std::filesystem::path{};
}

// Five frames of a still board, 64 rings, 18 x 8 cells of 50 mm at 3.4 m.
TEST(RealScan, FiveFramesAgreeOnCentreNormalAndCell) {
  const std::filesystem::path frames = frames_folder();
  if (frames.empty()) GTEST_SKIP() << needs_frames;
  BoardOptions options;
  options.board = {18, 8, 0.05};
  std::vector<BoardMeasurement> measured;
  for (const char* frame : {"449", "549", "649", "749", "849"}) {
    const Cloud cloud = read_cloud((frames / ("frame-03-" + std::string(frame) + ".pcd")).string());
    const auto one = measure_by_likelihood(cloud, {3.3, 0.65, -0.3}, options);
    ASSERT_TRUE(one) << frame << ": " << one.refusal().message;
    measured.push_back(*one);
  }
  for (const BoardMeasurement& one : measured) {
    EXPECT_LT((one.centre_m - measured[0].centre_m).norm(), 3e-3);
    EXPECT_GT(one.normal.dot(measured[0].normal), std::cos(0.01));
    EXPECT_NEAR(one.cell_m, 0.05, 0.0005);
    EXPECT_NEAR(one.cell_m, measured[0].cell_m, 1e-4);
  }
}

// Walls whose intensities change from ring to ring correlate with the pattern too.
TEST(RealScan, TheBoardAndNothingElseIsFoundInAWholeFrame) {
  const std::filesystem::path frames = frames_folder();
  if (frames.empty()) GTEST_SKIP() << needs_frames;
  BoardOptions options;
  options.board = {18, 8, 0.05};
  const auto found = find_boards(read_cloud((frames / "frame-03-449.pcd").string()), options);
  ASSERT_TRUE(found) << found.refusal().message;
  ASSERT_EQ(found->size(), 1u);
  EXPECT_LT((found->front().centre_m - Eigen::Vector3d(3.3294, 0.6760, -0.3365)).norm(), 3e-3);
}

}  // namespace
}  // namespace alea
