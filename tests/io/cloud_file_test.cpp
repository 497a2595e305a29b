#include "alea/io/cloud_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"
#include "alea/io/atomic_file.hpp"
#include "tests/io/scans.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using testing::error_of;
using testing::expect_same;
using testing::full_cloud;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

class RoundTrip : public ::testing::TestWithParam<const char*> {};

TEST_P(RoundTrip, KeepsEveryBitFarFromTheOrigin) {
  const TemporaryFolder folder;
  const std::string path = folder.file(std::string("scan.") + GetParam());
  Cloud cloud = full_cloud(1000, false);
  cloud.scanner_position = Eigen::Vector3d(5e5, 5e6, 1.7);
  write_cloud(path, cloud);
  const Cloud back = read_cloud(path);
  expect_same(cloud, back);
  const std::string format = GetParam();
  if (format == "ply" || format == "pcd") {
    EXPECT_EQ(back.scanner_position, cloud.scanner_position);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         ::testing::Values("ply", "pcd", "xyz", "csv", "txt", "asc", "e57"),
                         [](const auto& parameter) { return parameter.param; });

TEST(CloudFile, SixteenBitColoursSurvive) {
  const TemporaryFolder folder;
  const Cloud cloud = full_cloud(100, true);
  for (const char* name : {"a.ply", "a.xyz", "a.e57"}) {
    write_cloud(folder.file(name), cloud);
    expect_same(cloud, read_cloud(folder.file(name)));
  }
}

TEST(CloudFile, UnitScalesCoordinates) {
  const TemporaryFolder folder;
  write_file_atomically(folder.file("a.csv"), "x,y,z,intensity\n1000,2000,-3000,7\n");
  const Cloud cloud = read_cloud(folder.file("a.csv"), {.unit_m = 0.001});
  ASSERT_EQ(cloud.size(), 1u);
  EXPECT_TRUE(cloud.positions[0].isApprox(Eigen::Vector3d(1, 2, -3), 1e-15));
  EXPECT_EQ(cloud.intensity[0], 7);
}

TEST(CloudFile, CountsAndDropsNonFinitePoints) {
  const TemporaryFolder folder;
  write_file_atomically(folder.file("a.xyz"), "0 0 1\nnan 0 1\n0 inf 1\n\n2 2 2\n");
  const Cloud cloud = read_cloud(folder.file("a.xyz"));
  EXPECT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.dropped.non_finite, 2u);
}

TEST(CloudFile, CropsAndThins) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 100; ++i) text += std::to_string(i) + " 0 0\n";
  write_file_atomically(folder.file("a.xyz"), text);
  ReadOptions options;
  options.crop_m = Eigen::AlignedBox3d(Eigen::Vector3d(10, -1, -1), Eigen::Vector3d(29, 1, 1));
  options.keep_every = 5;
  const Cloud cloud = read_cloud(folder.file("a.xyz"), options);
  ASSERT_EQ(cloud.size(), 4u);
  EXPECT_EQ(cloud.positions[3].x(), 25);
}

TEST(CloudFile, ErrorsNameFileLineAndExpectation) {
  const TemporaryFolder folder;
  const std::string path = folder.file("bad.xyz");
  write_file_atomically(path, "1 2 3\n4 5 6\n7 eight 9\n");
  EXPECT_THAT(error_of(path), HasSubstr("bad.xyz: line 3: 'eight' is not a number"));
  write_file_atomically(path, "1 2 3\n4 5\n");
  EXPECT_THAT(error_of(path), HasSubstr("line 2: 2 values, expected 3"));
  write_file_atomically(path, "1 2 3\n4 5 6 7\n");
  EXPECT_THAT(error_of(path), HasSubstr("line 2: more than the 3 values expected"));
  EXPECT_THAT(error_of(folder.file("none.ply")), HasSubstr("No such file"));
}

TEST(CloudFile, ALargeCountInASmallFileTakesNoMemory) {
  const TemporaryFolder folder;
  const std::string path = folder.file("bad.ply");
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    write_file_atomically(path, std::string("ply\nformat ") + format +
                                    " 1.0\nelement vertex 1000000000000000\nproperty float x\n"
                                    "property float y\nproperty float z\nend_header\n");
    EXPECT_THAT(error_of(path), HasSubstr("declares 1000000000000000"));
  }
}

TEST(CloudFile, BigEndianPlyWithAListBetweenTheScalars) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.ply");
  const std::string one("\x3f\x80\x00\x00", 4);  // 1.0f
  const std::string two("\x40\x00\x00\x00", 4);
  const std::string list("\x02\x00\x05\x00\x06", 5);
  write_file_atomically(path,
                        "ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty float x\n"
                        "property list uchar short k\nproperty float y\nproperty float z\n"
                        "end_header\n" +
                            one + list + two + one + two + std::string(1, '\0') + one + two);
  const Cloud cloud = read_cloud(path);
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.positions[0], Eigen::Vector3d(1, 2, 1));
  EXPECT_EQ(cloud.positions[1], Eigen::Vector3d(2, 1, 2));
}

}  // namespace
}  // namespace alea
