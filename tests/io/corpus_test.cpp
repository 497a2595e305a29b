#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "alea/io/e57_pages.hpp"
#include "tests/io/scans.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

struct Expectation {
  std::string file;
  int exit_code = 0;
  std::vector<std::size_t> points;  // of each scan
};

std::vector<Expectation> expectations() {
  std::ifstream in(testing::source_dir() + "/tests/io/corpus_expectation.csv");
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

// The values of a LAS header, from byte `at` on.
template <typename T, std::size_t n>
std::array<T, n> header_values(const std::string& bytes, std::size_t at) {
  std::array<T, n> values{};
  std::memcpy(values.data(), bytes.data() + at, sizeof(values));
  return values;
}

// No second reader of LAS is packaged, so the files' own headers are the other opinion.
TEST_F(Corpus, LasPointsFillTheBoundsOfTheirHeaders) {
  std::size_t checked = 0;
  for (const Expectation& expected : expectations()) {
    if (!expected.file.ends_with(".las") || expected.exit_code != 0) continue;
    SCOPED_TRACE(expected.file);
    const std::string bytes = testing::read_text(root_ + expected.file);
    const auto scale = header_values<double, 3>(bytes, 131);
    const auto bounds = header_values<double, 6>(bytes, 179);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : read_cloud(root_ + expected.file).positions) box.extend(p);
    // spurious.las holds a point outside on purpose; headers may be rounded by less than a step.
    if (box.isEmpty() || expected.file == "las-pdal/spurious.las") continue;
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      EXPECT_NEAR(box.max()[axis], bounds[2 * k], scale[k]);
      EXPECT_NEAR(box.min()[axis], bounds[2 * k + 1], scale[k]);
    }
    ++checked;
  }
  EXPECT_GE(checked, 20u);
}

double number_after(const std::string& text, const std::string& opening, std::size_t from) {
  const std::size_t at = text.find('>', text.find(opening, from)) + 1;
  return std::strtod(text.c_str() + at, nullptr);
}

// The same for E57: bounds in the XML part; checksums are checked at every reading (E57Pages).
TEST_F(Corpus, E57PointsFillTheBoundsOfTheirScans) {
  std::size_t checked = 0;
  for (const Expectation& expected : expectations()) {
    if (!expected.file.ends_with(".e57") || expected.exit_code != 0) continue;
    SCOPED_TRACE(expected.file);
    const InputFile file(root_ + expected.file);
    const E57Pages pages(file);
    const std::string bytes = pages.read(0, pages.logical_size(), "the file");
    const std::vector<ScanFile> scans = read_scans(root_ + expected.file);
    std::size_t at = 0;
    for (const ScanFile& scan : scans) {
      at = bytes.find("<cartesianBounds", at + 1);
      if (at == std::string::npos || scans.size() != expected.points.size()) break;
      // The bounds of the first count its invalid points, those of the second are in the common
      // frame.
      if (scan.cloud.empty() || expected.file.ends_with("cartesian_invalid_state_single.e57") ||
          expected.file.ends_with("translationWithoutRotation.e57"))
        continue;
      Eigen::AlignedBox3d box;
      for (const Eigen::Vector3d& p : scan.cloud.positions) box.extend(p);
      for (int axis = 0; axis < 3; ++axis) {
        const std::string name = std::string("<") + "xyz"[axis];
        const double tolerance = 1e-6 * (1 + box.sizes().maxCoeff());
        EXPECT_NEAR(box.min()[axis], number_after(bytes, name + "Minimum", at), tolerance);
        EXPECT_NEAR(box.max()[axis], number_after(bytes, name + "Maximum", at), tolerance);
      }
      ++checked;
    }
  }
  EXPECT_GE(checked, 15u);
}

#ifndef __SANITIZE_ADDRESS__
// The program on every file: exit code, one line, time, and memory of at most 64 MB and four times
// the file.
TEST_F(Corpus, TheProgramNeedsLittleMemoryForAnyFile) {
  const testing::TemporaryFolder scratch;
  const std::string program = testing::program_path();
  const std::string message = scratch.file("message");
  for (const Expectation& expected : expectations()) {
    SCOPED_TRACE(expected.file);
    const std::string path = root_ + expected.file;
    const pid_t child = ::fork();
    if (child == 0) {
      ::alarm(20);
      const int out = ::open(message.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      ::dup2(out, STDERR_FILENO);
      ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
      ::execl(program.c_str(), "alea", "info", path.c_str(), nullptr);
      ::_exit(127);
    }
    int status = 0;
    rusage usage{};
    ASSERT_EQ(::wait4(child, &status, 0, &usage), child);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), expected.exit_code);
    const std::string text = testing::read_text(message);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), expected.exit_code == 0 ? 0 : 1) << text;
    const auto limit_kb = 65536 + 4 * static_cast<long>(std::filesystem::file_size(path)) / 1024;
    EXPECT_LE(usage.ru_maxrss, limit_kb);
  }
}
#endif

TEST_F(Corpus, AFileWithoutPointsIsNotRegistered) {
  std::size_t checked = 0;
  for (const Expectation& expected : expectations()) {
    const bool none = std::all_of(expected.points.begin(), expected.points.end(),
                                  [](std::size_t points) { return points == 0; });
    if (expected.exit_code != 0 || !none) continue;
    const std::string path = root_ + expected.file;
    const testing::ProgramRun run = testing::run_alea({"register", "markerless", path, path});
    EXPECT_EQ(run.exit_code, 3) << expected.file;
    EXPECT_THAT(run.err, ::testing::HasSubstr(expected.file));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    ++checked;
  }
  EXPECT_GE(checked, 10u);
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

std::vector<Eigen::Vector3d> sorted(std::vector<Eigen::Vector3d> points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  return points;
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
        EXPECT_EQ(sorted(back.positions), sorted(kept.positions)) << expected.file;  // grid's order
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
