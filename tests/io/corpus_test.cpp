#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/io/scans.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

struct Expectation {
  std::string file;
  int exit_code = 0;
  std::vector<std::size_t> points;  // of each scan
};

std::vector<Expectation> expectations() {
  std::ifstream in(std::string(ALEA_SOURCE_DIR) + "/tests/io/corpus_expectation.csv");
  std::vector<Expectation> out;
  std::string line;
  for (std::getline(in, line); std::getline(in, line);) {
    std::istringstream cells(line);
    std::string file, exit_code, points;
    std::getline(cells, file, ',');
    std::getline(cells, exit_code, ',');
    std::getline(cells, points, ',');
    Expectation expectation{file, std::stoi(exit_code), {}};
    std::istringstream counts(points);
    for (std::string count; std::getline(counts, count, '|');)
      expectation.points.push_back(std::stoul(count));
    out.push_back(expectation);
  }
  return out;
}

class Corpus : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* datasets = std::getenv("ALEA_DATASETS");
    if (datasets == nullptr || !std::filesystem::exists(std::string(datasets) + folder))
      GTEST_SKIP() << "set ALEA_DATASETS to a folder with " << folder;
    root_ = std::string(datasets) + folder + "/";
  }
  static constexpr const char* folder = "/format-conformance";
  std::string root_;
};

TEST_F(Corpus, EveryGoodFileGivesItsPointsAndEveryBadOneOneLine) {
  const std::vector<Expectation> all = expectations();
  ASSERT_EQ(all.size(), 185u);
  for (const Expectation& expected : all) {
    if (expected.exit_code != 0) {
      const std::string error = testing::error_of(root_ + expected.file);
      EXPECT_THAT(error, ::testing::HasSubstr(expected.file));
      EXPECT_EQ(error.find('\n'), std::string::npos) << expected.file;
      continue;
    }
    const std::vector<ScanFile> scans = read_scans(root_ + expected.file);
    std::vector<std::size_t> points;
    for (const ScanFile& scan : scans) points.push_back(scan.cloud.size());
    EXPECT_EQ(points, expected.points) << expected.file;
  }
}

// What the other formats keep of a cloud: PTX has no normals and colours of 8 bits.
Cloud reduced(Cloud cloud, const std::string& format) {
  cloud.dropped = {};
  if (format == "ptx" || format == "pcd")
    for (Colour& colour : cloud.colours)
      for (std::uint16_t& value : colour)
        value = static_cast<std::uint16_t>((value + 128) / 257 * 257);
  if (format == "ptx") cloud.normals.clear();
  for (Eigen::Vector3d& p : cloud.positions)
    if (format == "ptx" && p.isZero(0)) p.x() = 1e-300;
  return cloud;
}

// The same bits; a normal that is not a number stays one.
bool same_normals(const std::vector<Eigen::Vector3f>& a, const std::vector<Eigen::Vector3f>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
    return p == q || (p.hasNaN() && q.hasNaN());
  });
}

TEST_F(Corpus, EveryReadableFileSurvivesEveryWritableFormat) {
  const testing::TemporaryFolder out;
  for (const Expectation& expected : expectations()) {
    if (expected.exit_code != 0) continue;
    const Cloud cloud = read_cloud(root_ + expected.file, {.accept_non_rigid_pose = true});
    if (cloud.size() > 3000) continue;  // the same formats as the smaller files
    for (const std::string format : {"ply", "pcd", "xyz", "csv", "ptx", "e57"}) {
      const std::string path = out.file("a." + format);
      write_cloud(path, cloud);
      const Cloud back = read_cloud(path);
      const Cloud kept = reduced(cloud, format);
      if (format == "ptx" && !cloud.rows.empty()) {
        EXPECT_EQ(back.size(), cloud.size());  // in the grid's order
        continue;
      }
      EXPECT_EQ(back.positions, kept.positions) << expected.file << " " << format;
      EXPECT_EQ(back.colours, kept.colours) << expected.file << " " << format;
      EXPECT_TRUE(same_normals(back.normals, kept.normals)) << expected.file << " " << format;
      if (cloud.has_intensity()) {
        EXPECT_EQ(back.intensity, kept.intensity) << expected.file << " " << format;
      }
    }
  }
}

}  // namespace
}  // namespace alea
