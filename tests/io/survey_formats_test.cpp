#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cstring>

#include "alea/io/atomic_file.hpp"
#include "tests/io/scans.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using testing::error_of;
using testing::full_cloud;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

TEST(Ptx, KeepsPoseGridAndColours) {
  const TemporaryFolder folder;
  std::vector<ScanFile> scans(2);
  for (ScanFile& scan : scans) {
    scan.cloud = full_cloud(700, false);
    scan.pose = Eigen::Matrix4d::Identity();
    scan.pose->topLeftCorner<3, 3>() =
        Eigen::AngleAxisd(2, Eigen::Vector3d(0, 0.6, 0.8)).toRotationMatrix();
    scan.pose->topRightCorner<3, 1>() << 3, 4, 5e5;
  }
  write_scans(folder.file("a.ptx"), scans);
  const std::vector<ScanFile> back = read_scans(folder.file("a.ptx"));
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(*back[1].pose, *scans[1].pose);
  EXPECT_EQ(back[1].cloud.scanner_position, Eigen::Vector3d(0, 0, 0));
  const Cloud& in = scans[1].cloud;
  const Cloud& out = back[1].cloud;
  ASSERT_EQ(out.size(), 700u);
  for (std::size_t i = 0; i < 700; ++i) {
    // The file goes column by column: 100 rows, 7 columns.
    const std::size_t from = i % 100 * 7 + i / 100;
    EXPECT_EQ(out.positions[i], in.positions[from]);
    EXPECT_EQ(out.intensity[i], in.intensity[from]);
    EXPECT_EQ(out.colours[i], in.colours[from]);
    EXPECT_EQ(out.rows[i], in.rows[from]);
    EXPECT_EQ(out.columns[i], in.columns[from]);
  }
}

TEST(Ptx, AnEmptyReturnIsMissingAndTheGridGoesOn) {
  const TemporaryFolder folder;
  const std::string frame = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n7 8 9 1\n";
  write_file_atomically(folder.file("a.ptx"),
                        "2\n2\n" + frame + "1 2 3 0.5\n0 0 0 0.5\n4 5 6 0.25\n7 8 9 0\n");
  const ScanFile scan = read_scans(folder.file("a.ptx")).at(0);
  EXPECT_EQ(scan.cloud.dropped.missing, 1u);
  EXPECT_EQ(scan.cloud.rows, (std::vector<std::int32_t>{0, 0, 1}));
  EXPECT_EQ(scan.cloud.columns, (std::vector<std::int32_t>{0, 1, 1}));
  EXPECT_EQ((scan.pose->topRightCorner<3, 1>()), Eigen::Vector3d(7, 8, 9));
  write_file_atomically(folder.file("b.ptx"), "2\n2\n" + frame + "1 2 3 0.5\n");
  EXPECT_THAT(error_of(folder.file("b.ptx")), HasSubstr("4 points declared, 1 are there"));
  write_file_atomically(folder.file("b.ptx"), "4000000000\n4000000000\n" + frame);
  EXPECT_THAT(error_of(folder.file("b.ptx")), HasSubstr("do not fit into the file"));
}

TEST(Ptx, APoseThatScalesIsBadInputUnlessAccepted) {
  const TemporaryFolder folder;
  write_file_atomically(folder.file("a.ptx"),
                        "1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 2\n1 0 0 0\n0 1 0 0\n0 0 2 0\n0 0 0 1\n"
                        "1 2 3 0.5\n");
  EXPECT_EQ(error_of(folder.file("a.ptx")), "no error");
  EXPECT_THAT(error_of(folder.file("a.ptx"), {.apply_pose = true}), HasSubstr("not rigid"));
  const Cloud cloud =
      read_cloud(folder.file("a.ptx"), {.apply_pose = true, .accept_non_rigid_pose = true});
  EXPECT_EQ(cloud.positions[0], Eigen::Vector3d(1, 2, 6));
  const testing::ProgramRun run =
      testing::run_alea({"info", folder.file("a.ptx"), "--apply-pose", "--json", "-"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("pose_not_rigid"));
}

TEST(Pts, BlocksAreScansAndCountsAreChecked) {
  const TemporaryFolder folder;
  write_file_atomically(folder.file("a.pts"), "2\n1 2 3 -9 1 2 255\n4 5 6 7 0 0 0\n1\n7 8 9 3\n");
  const std::vector<ScanFile> scans = read_scans(folder.file("a.pts"));
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans[0].cloud.intensity[0], -9);
  EXPECT_EQ(scans[0].cloud.colours[0], (Colour{257, 514, 65535}));
  EXPECT_EQ(scans[1].cloud.size(), 1u);
  write_file_atomically(folder.file("a.pts"), "3\n1 2 3\n4 5 6\n");
  EXPECT_THAT(error_of(folder.file("a.pts")), HasSubstr("3 points declared, 2 are there"));
}

template <typename T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

TEST(Pts, MoreScansThanTheLimitAreRefused) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 10001; ++i) text += "1\n1 2 3\n";
  write_file_atomically(folder.file("a.pts"), text);
  EXPECT_THAT(error_of(folder.file("a.pts")), HasSubstr("more than 10000 scans"));
}

TEST(Pcd, MoreValuesAPointThanTheLimitTakeNoMemory) {
  const TemporaryFolder folder;
  std::string names, sizes, types, counts;
  for (int i = 0; i < 2000; ++i) {
    names += i < 3 ? std::string(" ") + "xyz"[i] : " a";
    sizes += " 4";
    types += " F";
    counts += i < 3 ? " 1" : " 1000000";
  }
  write_file_atomically(folder.file("a.pcd"), "VERSION .7\nFIELDS" + names + "\nSIZE" + sizes +
                                                  "\nTYPE" + types + "\nCOUNT" + counts +
                                                  "\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3\n");
  EXPECT_THAT(error_of(folder.file("a.pcd")), HasSubstr("line 8: more than 1000000 values"));
}

// A LAS file of `points` records; tables 7 to 17 of the specification give size and colours.
std::string las_file(int minor, int format, std::size_t record, std::size_t colours,
                     std::size_t points) {
  const std::size_t header = minor == 4 ? 375 : minor == 3 ? 235 : 227;
  std::string bytes(header + record * points, '\0');
  bytes.replace(0, 4, "LASF");
  bytes[24] = 1;
  bytes[25] = static_cast<char>(minor);
  put(bytes, 94, static_cast<std::uint16_t>(header));
  put(bytes, 96, static_cast<std::uint32_t>(header));
  bytes[104] = static_cast<char>(format);
  put(bytes, 105, static_cast<std::uint16_t>(record));
  put(bytes, 107, static_cast<std::uint32_t>(points));
  for (std::size_t axis = 0; axis < 3; ++axis) put(bytes, 131 + 8 * axis, 0.01);
  put(bytes, 155, 500000.0);
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t at = header + i * record;
    put(bytes, at, std::int32_t{-100});
    put(bytes, at + 4, static_cast<std::int32_t>(i));
    put(bytes, at + 12, std::uint16_t{60000});
    if (colours != 0) put(bytes, at + colours + 2, std::uint16_t{1234});
  }
  return bytes;
}

TEST(Las, EveryPointFormat) {
  const TemporaryFolder folder;
  const std::array<std::array<std::size_t, 2>, 11> formats{{{20, 0},
                                                            {28, 0},
                                                            {26, 20},
                                                            {34, 28},
                                                            {57, 0},
                                                            {63, 28},
                                                            {30, 0},
                                                            {36, 30},
                                                            {38, 30},
                                                            {59, 0},
                                                            {67, 30}}};
  for (std::size_t format = 0; format < formats.size(); ++format) {
    const auto [record, colours] = formats[format];
    const int minor = format >= 6 ? 4 : format >= 4 ? 3 : static_cast<int>(format) % 3;
    const std::string bytes = las_file(minor, static_cast<int>(format), record + 3, colours, 5);
    write_file_atomically(folder.file("a.las"), bytes);
    const Cloud cloud = read_cloud(folder.file("a.las"));
    ASSERT_EQ(cloud.size(), 5u) << format;
    EXPECT_EQ(cloud.positions[4], Eigen::Vector3d(499999, 4 * 0.01, 0));
    EXPECT_EQ(cloud.intensity[4], 60000);
    EXPECT_EQ(cloud.colours.empty(), colours == 0);
    if (colours != 0) {
      EXPECT_EQ(cloud.colours[4], (Colour{0, 1234, 0}));
    }
    write_file_atomically(folder.file("a.las"), bytes.substr(0, bytes.size() - 1));
    EXPECT_THAT(error_of(folder.file("a.las")), HasSubstr("5 points of"));
  }
}

TEST(KnownFormats, AreNamedWithWhatToDo) {
  const TemporaryFolder folder;
  for (const char* name : {"a.laz", "a.obj", "a.off", "a.vtk"}) {
    write_file_atomically(folder.file(name), "x");
    const testing::ProgramRun run = testing::run_alea({"info", folder.file(name)});
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_THAT(run.err, HasSubstr("is not read; "));
  }
}

}  // namespace
}  // namespace alea
