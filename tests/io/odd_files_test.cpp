#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "alea/io/atomic_file.hpp"
#include "tests/io/scans.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

// Files as users have them: hand-made, exported by spreadsheets, edited, damaged.
class OddFiles : public ::testing::Test {
 protected:
  std::string written(const std::string& name, const std::string& bytes) {
    write_file_atomically(folder_.file(name), bytes);
    return folder_.file(name);
  }
  Cloud read(const std::string& name, const std::string& bytes, const ReadOptions& options = {}) {
    return read_cloud(written(name, bytes), options);
  }
  std::string error(const std::string& name, const std::string& bytes) {
    const std::string what = error_of(written(name, bytes));
    EXPECT_THAT(what, HasSubstr(name));
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what;
  }
  TemporaryFolder folder_;
};

TEST_F(OddFiles, TextWithAnyLineEndsAndByteOrderMark) {
  const std::vector<Eigen::Vector3d> two{{1, 2, 3}, {4, 5, 6}};
  for (const char* text : {"1 2 3\r\n4 5 6\r\n", "1 2 3\r\r\n4 5 6",
                           "\xEF\xBB\xBF"
                           "1 2 3\n4 5 6\n\n\n",
                           "1\t2\t3  \n\n4 5 6\t\n", "1,2,3,\n4,5,6,\n", "1 ; 2;3\n4;5;6\n",
                           "# a\n1 2 3\n// b\n4 5 6"})
    EXPECT_EQ(read("a.xyz", text).positions, two) << text;
  EXPECT_EQ(read("a.csv", "\xEF\xBB\xBFx,y,z\n1,2,3\n4,5,6\n").positions, two);
  EXPECT_EQ(read("a.pts",
                 "\xEF\xBB\xBF"
                 "2\n1 2 3\n4 5 6\n")
                .positions,
            two);
  EXPECT_THAT(error("a.txt", std::string("\xFF\xFE"
                                         "1\0 \0",
                                         6)),
              HasSubstr("UTF-16"));
  EXPECT_THAT(error("a.xyz", "1 2 3\r4 5 6\r"), HasSubstr("ends in CR alone"));
}

TEST_F(OddFiles, AZeroByteIsNoBlank) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "1 2 3\n";
  EXPECT_THAT(error("a.xyz", text + std::string("4 5 6\0\n", 7)), HasSubstr("line 1001"));
  EXPECT_THAT(error("a.xyz", text + std::string("4\0 5 6\n", 7)), HasSubstr("line 1001"));
  EXPECT_THAT(error("a.xyz", std::string("4 5\0 6\n", 7)), HasSubstr("binary data"));
}

// Half a number in each column would be a wrong scan, not a wrong file.
TEST_F(OddFiles, DecimalCommasAreRefused) {
  for (const char* text : {"1,5;2,5;3,5\n", "1,5 2,5 3,5\n", "1,5\t2,5\t3,5\n"})
    EXPECT_THAT(error("a.csv", text), HasSubstr("line 1: commas beside another separator")) << text;
  EXPECT_THAT(error("a.csv", "x;y;z\n1,5;2,5;3,5\n"), HasSubstr("'1,5' is not a number"));
  EXPECT_THAT(error("a.csv", "1;2;3\n4,5;5;6\n"), HasSubstr("line 2: '4,5' is not a number"));
  EXPECT_THAT(error("a.csv", "1,2,3\n4,5 6\n"), HasSubstr("line 2: expected ',' before column 3"));
}

TEST_F(OddFiles, AnEmptyValueShiftsNoColumn) {
  EXPECT_THAT(error("a.csv", "1,2,3,4\n1,,3,4\n"),
              HasSubstr("line 2: '' is not a number (column 2)"));
  EXPECT_THAT(error("a.csv", "1,,3,4\n1,,3,4\n"), HasSubstr("line 1: an empty value"));
  const Cloud cloud =
      read("b.csv", ",x,y,z,label\n0,1,2,3,\"a, wall\"\n1,4,5,6,\n2,7,8,9,\"a, b\"\n");
  EXPECT_EQ(cloud.positions, (std::vector<Eigen::Vector3d>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

TEST_F(OddFiles, HeadersWithQuotesUnitsAndColumnsNamedByTheUser) {
  for (const char* text : {"\"x\",\"y\",\"z\"\n1,2,3\n", "X [m];Y [m];Z [m]\n1;2;3\n",
                           "x(m)\ty(m)\tz(m)\n1\t2\t3\n", "# x y z\n1 2 3\n"})
    EXPECT_EQ(read("a.csv", text).positions, (std::vector<Eigen::Vector3d>{{1, 2, 3}})) << text;
  const std::string millimetres = "x [mm],y [mm],z [mm]\n1000,2000,3000\n";
  EXPECT_THAT(error("a.csv", millimetres), HasSubstr("name the columns with --columns"));
  EXPECT_EQ(read("a.csv", millimetres, {.unit_m = 0.001, .columns = {"x", "y", "z"}}).positions,
            (std::vector<Eigen::Vector3d>{{1, 2, 3}}));
  EXPECT_THAT(error("a.csv", "x,y,z,x\n1,2,3,4\n"), HasSubstr("two columns are called 'x'"));
  EXPECT_EQ(read("a.csv", "x,y,z,intensity,reflectance\n1,2,3,4,5\n").intensity,
            std::vector<float>{4});
}

TEST_F(OddFiles, ColumnsWithoutNamesAreWhatAllTheirValuesAre) {
  // The first colour is black: zeros could be a normal too.
  Cloud cloud = read("a.xyz", "1 2 3 0 0 0\n1 2 3 255 128 1\n");
  EXPECT_TRUE(cloud.normals.empty());
  EXPECT_EQ(cloud.colours.at(1), (Colour{65535, 32896, 257}));
  cloud = read("a.xyz", "1 2 3 0 0 1\n1 2 3 0.6 0 -0.8\n");
  EXPECT_TRUE(cloud.colours.empty());
  EXPECT_EQ(cloud.normals.at(1), Eigen::Vector3f(0.6F, 0, -0.8F));
  cloud = read("a.xyz", "1 2 3 0 0 0\n1 2 3 0 0 0\n");
  EXPECT_TRUE(cloud.colours.empty() && cloud.normals.empty());
  // CloudCompare puts colours before the scalar.
  cloud = read("a.xyz", "1 2 3 10 20 30 0.5\n1 2 3 11 21 31 0.25\n");
  EXPECT_EQ(cloud.intensity, (std::vector<float>{0.5F, 0.25F}));
  EXPECT_EQ(cloud.colours.at(0), (Colour{2570, 5140, 7710}));
}

std::string ply(const std::string& header, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

constexpr const char* vertex =
    "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";

TEST_F(OddFiles, PlyWithListsAndElementsInAnyPlace) {
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  EXPECT_EQ(read("a.ply", ply(face + vertex, "3 0 0 0\n1 2 3\n")).size(), 1u);
  EXPECT_THAT(error("a.ply", ply(std::string(vertex) + vertex, "1 2 3\n4 5 6\n")),
              HasSubstr("two elements are called vertex"));
  EXPECT_THAT(error("a.ply", ply(std::string(vertex) + "property float x\n", "1 2 3 4\n")),
              HasSubstr("two columns are called 'x'"));
  // A list called like a coordinate or an intensity is none.
  EXPECT_THAT(error("a.ply", ply("element vertex 1\nproperty list uchar float x\nproperty float "
                                 "y\nproperty float z\n",
                                 "1 5 2 3\n")),
              HasSubstr("no properties x, y and z"));
  const std::string list = std::string(vertex) + "property list uchar float intensity\n";
  EXPECT_FALSE(read("a.ply", ply(list, "1 2 3 1 7\n")).has_intensity());
  for (const char* count : {"-1", "nan", "0.5", "1e300"})
    EXPECT_THAT(error("a.ply", ply(list, std::string("1 2 3 ") + count + "\n")),
                HasSubstr("line 9"));
}

TEST_F(OddFiles, AnImageOfPointsKeepsRowsAndColumns) {
  const std::string header =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 2\nDATA ";
  const Cloud text =
      read("a.pcd", header + "ascii\n1 2 3\nnan nan nan\n4 5 6\n7 8 9\n1 1 1\n2 2 2\n");
  EXPECT_EQ(text.rows, (std::vector<std::int32_t>{0, 0, 1, 1, 1}));
  EXPECT_EQ(text.columns, (std::vector<std::int32_t>{0, 2, 0, 1, 2}));
  const std::vector<float> values{1, 2, 3, std::nanf(""), 0, 0, 4, 5, 6, 7, 8, 9, 1, 1, 1, 2, 2, 2};
  const Cloud binary = read(
      "b.pcd", header + "binary\n" +
                   std::string(reinterpret_cast<const char*>(values.data()), 4 * values.size()));
  testing::expect_same(text, binary);
}

TEST_F(OddFiles, PosesThatAreNotFiniteAreNamed) {
  const std::string axes = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  EXPECT_THAT(error("a.ptx", "1\n1\n" + axes + "1 0 0 0\n0 nan 0 0\n0 0 1 0\n0 0 0 1\n1 2 3 0.5\n"),
              HasSubstr("line 7: a pose that is not finite"));
}

template <typename T>
std::string changed(std::string bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof(T));
  return bytes;
}

TEST_F(OddFiles, LasWithAScaleOrOffsetThatIsNoNumber) {
  std::string las = changed(changed(std::string(227 + 20, '\0'), 0, 'L'), 25, '\2');
  las.replace(0, 4, "LASF");
  las = changed(changed(changed(las, 24, '\1'), 94, std::uint16_t{227}), 96, std::uint32_t{227});
  las = changed(changed(las, 105, std::uint16_t{20}), 107, std::uint32_t{1});
  for (std::size_t at = 131; at < 155; at += 8) las = changed(las, at, 0.01);
  EXPECT_EQ(read("a.las", las).size(), 1u);
  EXPECT_THAT(error("a.las", changed(las, 139, 0.0)),
              HasSubstr("byte 131: scale factors 0.01 0 0.01"));
  EXPECT_THAT(error("a.las", changed(las, 163, std::nan(""))),
              HasSubstr("byte 155: offsets 0 nan 0"));
}

}  // namespace
}  // namespace alea
