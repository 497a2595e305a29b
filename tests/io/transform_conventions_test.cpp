#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <sstream>

#include "alea/core/rigid_transform.hpp"
#include "alea/io/atomic_file.hpp"
#include "tests/io/scans.hpp"
#include "tests/support/program.hpp"
#include "tests/support/shell.hpp"

namespace alea {
namespace {

using testing::run_shell;
using testing::TemporaryFolder;

// What `alea transform --as CONVENTION` says of one registration, against the points that `alea
// apply` moves and against other programs.
class Conventions : public ::testing::Test {
 protected:
  Conventions() {
    truth_.rotation = rotation_from_omega_phi_kappa({0.3, -1.1, 2.2});
    truth_.translation = {12.5, -3.25, 0.75};
    std::string text;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) text += fmt::format("{} ", truth_.matrix()(i, j));
    write_file_atomically(folder_.file("registration.txt"), text);
    write_file_atomically(folder_.file("scan.xyz"), "1 2 3\n-4 5.5 6\n7 -8 0.25\n");
    EXPECT_EQ(testing::run_alea({"apply", folder_.file("registration.txt"),
                                 folder_.file("scan.xyz"), folder_.file("moved.xyz")})
                  .exit_code,
              0);
    moved_ = read_cloud(folder_.file("moved.xyz"));
  }

  std::vector<double> numbers(const std::string& convention) {
    const testing::ProgramRun run =
        testing::run_alea({"transform", folder_.file("registration.txt"), "--as", convention});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    std::istringstream in(run.out);
    std::vector<double> values;
    for (double value = 0; in >> value;) values.push_back(value);
    return values;
  }

  // Three lines of three coordinates that another program printed, against ours.
  void expect_moved(const std::string& output, double tolerance_m) const {
    std::istringstream in(output);
    for (const Eigen::Vector3d& p : moved_.positions) {
      Eigen::Vector3d q;
      ASSERT_TRUE(in >> q.x() >> q.y() >> q.z()) << output;
      EXPECT_LT((p - q).norm(), tolerance_m) << output;
    }
  }

  // Points of scan.xyz moved by a 4x4 that this Python code makes of the numbers `v`.
  void expect_open3d(const std::string& convention, const std::string& code) {
    if (run_shell("/usr/bin/python3 -c 'import open3d'").exit_code != 0)
      GTEST_SKIP() << "python3-open3d is not installed";
    const std::string script = folder_.file("move_points.py");
    write_file_atomically(
        script,
        "import sys, numpy, open3d\nv = [float(s) for s in open(sys.argv[1]).read().split()]\n"
        "T = numpy.eye(4)\ngeometry = open3d.geometry\n" +
            code +
            "\ncloud = geometry.PointCloud()\n"
            "cloud.points = open3d.utility.Vector3dVector(numpy.loadtxt(sys.argv[2]))\n"
            "cloud.transform(T)\nprint(*numpy.asarray(cloud.points).ravel())\n");
    const std::string numbers_file = folder_.file("numbers.txt");
    ASSERT_EQ(testing::run_alea({"transform", folder_.file("registration.txt"), "--as", convention,
                                 "--out", numbers_file})
                  .exit_code,
              0);
    expect_moved(run_shell("/usr/bin/python3 '" + script + "' '" + numbers_file + "' '" +
                           folder_.file("scan.xyz") + "'")
                     .output,
                 1e-12);
  }

  // Runs CloudCompare without a window; its cloud comes out as text in `out`.
  bool cloud_compare(const std::string& options, const std::string& out) {
    if (run_shell("command -v CloudCompare").exit_code != 0) return false;
    const testing::ShellRun run =
        run_shell("cd '" + folder_.path().string() +
                  "' && QT_QPA_PLATFORM=offscreen XDG_RUNTIME_DIR=. timeout 60 " +
                  "CloudCompare -SILENT -AUTO_SAVE OFF " + options +
                  " -C_EXPORT_FMT ASC -PREC 12 -SEP SPACE -SAVE_CLOUDS FILE '" + out + "'");
    EXPECT_EQ(run.exit_code, 0) << run.output;
    return true;
  }

  TemporaryFolder folder_;
  RigidTransform truth_;
  Cloud moved_;
};

TEST_F(Conventions, MatrixIsWhatTheTransformIsReadFrom) {
  const std::vector<double> v = numbers("matrix");
  ASSERT_EQ(v.size(), 16u);
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(v.data());
  EXPECT_LT((matrix - truth_.matrix()).cwiseAbs().maxCoeff(), 1e-15);
}

TEST_F(Conventions, MatrixInCloudCompare) {
  testing::run_alea(
      {"transform", folder_.file("registration.txt"), "--out", folder_.file("matrix.txt")});
  if (!cloud_compare("-O scan.xyz -APPLY_TRANS matrix.txt", "out.asc"))
    GTEST_SKIP() << "CloudCompare is not installed";
  // CloudCompare keeps coordinates and matrices as floats.
  expect_moved(testing::read_text(folder_.file("out.asc")), 5e-6);
}

TEST_F(Conventions, RegisteredPtxInCloudCompare) {
  ASSERT_EQ(testing::run_alea({"apply", folder_.file("registration.txt"), folder_.file("scan.xyz"),
                               folder_.file("posed.ptx")})
                .exit_code,
            0);
  if (!cloud_compare("-O posed.ptx", "ptx.asc")) GTEST_SKIP() << "CloudCompare is not installed";
  std::string lines, line;
  std::istringstream in(testing::read_text(folder_.file("ptx.asc")));
  while (std::getline(in, line)) {
    std::istringstream values(line);
    std::string x, y, z;
    if (values >> x >> y >> z) lines += x + " " + y + " " + z + "\n";
  }
  expect_moved(lines, 5e-6);
}

TEST_F(Conventions, MatrixInOpen3d) {
  expect_open3d("matrix", "T = numpy.array(v).reshape(4, 4)");
}

TEST_F(Conventions, QuaternionInOpen3d) {
  expect_open3d(
      "quaternion",
      "T[:3, :3] = geometry.get_rotation_matrix_from_quaternion(v[:4])\nT[:3, 3] = v[4:]");
}

TEST_F(Conventions, OmegaPhiKappaInOpen3d) {
  expect_open3d(
      "omega_phi_kappa",
      "T[:3, :3] = geometry.get_rotation_matrix_from_zyx(numpy.radians([v[2], v[1], v[0]]))\n"
      "T[:3, 3] = v[3:]");
}

TEST_F(Conventions, PtxHeaderHoldsPositionAxesAndTheMatrixForRowVectors) {
  const std::vector<double> v = numbers("ptx");
  ASSERT_EQ(v.size(), 28u);
  EXPECT_EQ(Eigen::Vector3d(v[0], v[1], v[2]), truth_.translation);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d a(v[3 + 3 * axis], v[4 + 3 * axis], v[5 + 3 * axis]);
    EXPECT_LT((a - truth_.rotation.col(static_cast<int>(axis))).norm(), 1e-14);
  }
  const Eigen::Matrix4d rows =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(v.data() + 12);
  const Eigen::RowVector4d p(1, 2, 3, 1);
  EXPECT_LT(((p * rows).head<3>().transpose() - moved_.positions[0]).norm(), 1e-12);
}

TEST_F(Conventions, E57PoseIsAUnitQuaternionAndATranslation) {
  const testing::ProgramRun run =
      testing::run_alea({"transform", folder_.file("registration.txt"), "--as", "e57"});
  const auto value = [&](const std::string& part, const std::string& name) {
    const std::size_t from = run.out.find("<" + part);
    const std::string open = "<" + name + " type=\"Float\">";
    return std::stod(run.out.substr(run.out.find(open, from) + open.size()));
  };
  const Eigen::Quaterniond q(value("rotation", "w"), value("rotation", "x"), value("rotation", "y"),
                             value("rotation", "z"));
  EXPECT_NEAR(q.norm(), 1, 1e-15);
  const Eigen::Vector3d t(value("translation", "x"), value("translation", "y"),
                          value("translation", "z"));
  EXPECT_LT((q * Eigen::Vector3d(1, 2, 3) + t - moved_.positions[0]).norm(), 1e-12);
}

TEST_F(Conventions, InverseTakesThePointsBack) {
  const std::string inverse = folder_.file("inverse.txt"), back = folder_.file("back.xyz");
  testing::run_alea({"transform", folder_.file("registration.txt"), "--inverse", "--out", inverse});
  testing::run_alea({"apply", inverse, folder_.file("moved.xyz"), back});
  EXPECT_LT((read_cloud(back).positions[0] - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
  const testing::ProgramRun bad = testing::run_alea({"transform", inverse, "--as", "euler"});
  EXPECT_EQ(bad.exit_code, 2);
}

}  // namespace
}  // namespace alea
