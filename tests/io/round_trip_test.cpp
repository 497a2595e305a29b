#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/io/readable_files.hpp"

namespace alea {
namespace {

using testing::far_cloud;
using testing::run_alea;
using testing::TemporaryFolder;

constexpr const char* writable[] = {"ply", "pcd", "xyz", "txt", "asc", "csv", "ptx", "e57"};

// What both files can hold must be the same, bit by bit.
void expect_kept(const Cloud& from, const Cloud& to, const std::string& format) {
  SCOPED_TRACE(format);
  ASSERT_EQ(to.size(), from.size());
  std::vector<std::size_t> order(from.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  // A PTX goes through its grid column by column.
  if (format == "ptx" && !from.rows.empty())
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(from.columns[a], from.rows[a]) < std::pair(from.columns[b], from.rows[b]);
    });
  if (from.has_intensity()) {
    ASSERT_EQ(to.intensity.size(), from.size());
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t k = order[i];
    EXPECT_EQ(to.positions[i], from.positions[k]);
    if (from.has_intensity()) {
      EXPECT_EQ(to.intensity[i], from.intensity[k]);
    }
    if (!from.colours.empty()) {
      EXPECT_EQ(to.colours.at(i), from.colours[k]);
    }
    if (!from.rows.empty()) {
      EXPECT_EQ(to.rows.at(i), from.rows[k]);
      EXPECT_EQ(to.columns.at(i), from.columns[k]);
    }
    if (!from.normals.empty() && format != "ptx") {
      EXPECT_EQ(to.normals.at(i), from.normals[k]);
    }
  }
}

TEST(RoundTrip, EveryReadableFormatToEveryWritableOneFarFromTheOrigin) {
  const TemporaryFolder folder;
  const Cloud truth = far_cloud();
  for (const std::string& name : testing::write_readable_files(folder)) {
    SCOPED_TRACE(name);
    const Cloud cloud = read_cloud(folder.file(name));
    ASSERT_EQ(cloud.size(), truth.size());
    // A LAS value is a number of steps: a product and a sum, each rounded once.
    const double resolution = name == "a.las" ? 2e-9 : 0;
    for (std::size_t i = 0; i < truth.size() && name != "a.ptx"; ++i)
      EXPECT_LE((cloud.positions[i] - truth.positions[i]).cwiseAbs().maxCoeff(), resolution);
    for (const std::string format : writable) {
      write_cloud(folder.file("out." + format), cloud);
      expect_kept(cloud, read_cloud(folder.file("out." + format)), format);
    }
  }
}

std::vector<ScanFile> two_posed_scans() {
  std::vector<ScanFile> scans(2);
  for (std::size_t s = 0; s < 2; ++s) {
    scans[s].cloud = testing::full_cloud(70, false);
    scans[s].cloud.normals.clear();
    scans[s].name = "station " + std::to_string(s);
    scans[s].pose = Eigen::Matrix4d::Identity();
    scans[s].pose->topLeftCorner<3, 3>() =
        Eigen::AngleAxisd(0.3 + static_cast<double>(s), Eigen::Vector3d(0.6, 0, 0.8))
            .toRotationMatrix();
    scans[s].pose->topRightCorner<3, 1>() << 5e5, static_cast<double>(s), -7.25;
  }
  return scans;
}

// master_from_slave: a quarter turn about z and a shift, so that products are exact to a rounding.
constexpr const char* turn = "0 -1 0 12.5\n1 0 0 -3\n0 0 1 0.125\n0 0 0 1\n";

TEST(RegisteredPose, IsWrittenBackAndThePointsStayUntouched) {
  const TemporaryFolder folder;
  write_file_atomically(folder.file("turn.txt"), turn);
  Eigen::Matrix4d master_from_slave;
  master_from_slave << 0, -1, 0, 12.5, 1, 0, 0, -3, 0, 0, 1, 0.125, 0, 0, 0, 1;
  for (const std::string from : {"e57", "ptx"}) {
    for (const std::string to : {"e57", "ptx"}) {
      SCOPED_TRACE(from + " to " + to);
      const std::string in = folder.file("in." + from), out = folder.file("out." + to);
      write_scans(in, two_posed_scans());
      ASSERT_EQ(run_alea({"apply", folder.file("turn.txt"), in, out}).exit_code, 0);
      const std::vector<ScanFile> before = read_scans(in);
      const std::vector<ScanFile> after = read_scans(out);
      ASSERT_EQ(after.size(), 2u);
      for (std::size_t s = 0; s < 2; ++s) {
        expect_kept(before[s].cloud, after[s].cloud, to);
        const Eigen::Matrix4d expected = master_from_slave * *before[s].pose;
        EXPECT_LT((*after[s].pose - expected).cwiseAbs().maxCoeff(),
                  1e-9);  // 5e5 m times a rounding
        if (from == "e57" && to == "e57") {
          EXPECT_EQ(after[s].name, before[s].name);
        }
      }
    }
  }
}

TEST(RegisteredPose, OtherFormatsGetMovedPoints) {
  const TemporaryFolder folder;
  write_file_atomically(folder.file("turn.txt"), turn);
  write_file_atomically(folder.file("in.csv"), "x,y,z,nx,ny,nz\n1,2,3,1,0,0\n");
  for (const std::string name : {"a.ply", "a.pcd", "a.xyz"}) {
    ASSERT_EQ(run_alea({"apply", folder.file("turn.txt"), folder.file("in.csv"), folder.file(name)})
                  .exit_code,
              0);
    const Cloud moved = read_cloud(folder.file(name));
    ASSERT_EQ(moved.size(), 1u);
    EXPECT_LT((moved.positions[0] - Eigen::Vector3d(10.5, -2, 3.125)).norm(), 1e-14);
    EXPECT_LT((moved.normals[0] - Eigen::Vector3f(0, 1, 0)).norm(), 1e-7F);
  }
}

}  // namespace
}  // namespace alea
