#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "alea/core/seed.hpp"
#include "alea/io/cloud_file.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using nlohmann::json;
using testing::ProgramRun;
using testing::run_alea;
using testing::TemporaryFolder;

/// Two scans of a die, written again in other units, elsewhere and in another order, and registered
/// with each plane detector.
class RegisterWithDetector : public ::testing::TestWithParam<std::string> {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder();
    const std::string scene = folder_->file("scene.toml");
    std::ofstream(scene) << R"(
[[die]]
edge_m = 0.5
centre_m = [0, 0, 0.25]
up = 1
front = 2
front_azimuth_deg = 0

[[station]]
name = "master"
position_m = [3.1, 3.1, 1.6]
omega_phi_kappa_deg = [0, 0, 20]
aim_at = "die"
step_mrad = 2

[[station]]
name = "slave"
position_m = [3.1, -3.1, 1.6]
omega_phi_kappa_deg = [0, 0, -100]
aim_at = "die"
step_mrad = 2
)";
    const ProgramRun run =
        run_alea({"simulate", scene, "--out", folder_->path().string(), "--quiet"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  static void TearDownTestSuite() { delete folder_; }

  /// Writes both scans again, changed by `change`, as "<name>-master.ply" and "<name>-slave.ply".
  template <typename Change>
  static void rewrite(const std::string& name, Change change) {
    for (const char* scan : {"master", "slave"}) {
      Cloud cloud = read_cloud(folder_->file(std::string(scan) + ".ply"));
      change(cloud);
      write_cloud(folder_->file(name + "-" + scan + ".ply"), cloud);
    }
  }

  static Eigen::Matrix4d registered(const std::string& prefix,
                                    const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"register",
                                       "die",
                                       folder_->file(prefix + "master.ply"),
                                       folder_->file(prefix + "slave.ply"),
                                       "--edge",
                                       "0.5",
                                       "--planes",
                                       GetParam(),
                                       "--method",
                                       "closed_form",
                                       "--quiet",
                                       "--json",
                                       "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_alea(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    Eigen::Matrix4d out = Eigen::Matrix4d::Zero();
    if (run.exit_code != 0) return out;
    const json result = json::parse(run.out);
    for (int i = 0; i < 16; ++i)
      out(i / 4, i % 4) = result["master_from_slave"]["matrix"][i / 4][i % 4];
    return out;
  }

  static TemporaryFolder* folder_;
};
TemporaryFolder* RegisterWithDetector::folder_ = nullptr;

INSTANTIATE_TEST_SUITE_P(Planes, RegisterWithDetector,
                         ::testing::Values("cells", "efficient_ransac", "region_growing",
                                           "ndt_ransac"),
                         [](const auto& each) { return each.param; });

TEST_P(RegisterWithDetector, GivesTheSameTransformInMillimetresAndFeet) {
  const Eigen::Matrix4d metres = registered("");
  for (const auto& [unit, length_m] : {std::pair("mm", 0.001), std::pair("ft", 0.3048)}) {
    rewrite(unit, [&](Cloud& cloud) {
      for (Eigen::Vector3d& p : cloud.positions) p /= length_m;
    });
    const Eigen::Matrix4d other = registered(std::string(unit) + "-", {"--unit", unit});
    EXPECT_LT((other - metres).cwiseAbs().maxCoeff(), 1e-7) << unit;
  }
}

TEST_P(RegisterWithDetector, FollowsScansThatAreMovedBy500Kilometres) {
  const Eigen::Vector3d shift(5e5, -5e5, 5e5);
  const Eigen::Matrix4d here = registered("");
  rewrite("far", [&](Cloud& cloud) {
    for (Eigen::Vector3d& p : cloud.positions) p += shift;
    cloud.scanner_position = shift;
  });
  const std::string origin = "=500000,-500000,500000";
  const Eigen::Matrix4d far =
      registered("far-", {"--master-origin" + origin, "--slave-origin" + origin});
  const double turned = (far - here).topLeftCorner<3, 3>().cwiseAbs().maxCoeff();
  EXPECT_LT(turned, 1e-9);
  const Eigen::Vector3d moved = far.topLeftCorner<3, 3>() * shift + far.topRightCorner<3, 1>();
  const Eigen::Vector3d expected = here.topRightCorner<3, 1>() + shift;
  // The rotation's own rounding, 5e5 m away.
  EXPECT_LT((moved - expected).norm(), 1e-6);
}

TEST_P(RegisterWithDetector, GivesTheSameBitsForAnyOrderAndThreadCount) {
  rewrite("mixed", [](Cloud& cloud) {
    std::vector<std::uint32_t> order(cloud.size());
    std::iota(order.begin(), order.end(), 0u);
    RandomStream random({1, 0, cloud.size(), 0, Purpose::test});
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    cloud = subset(cloud, order);
  });
  const Eigen::Matrix4d one = registered("", {"--threads", "1"});
  EXPECT_EQ(one, registered("", {"--threads", "2"}));
  EXPECT_EQ(one, registered("mixed-"));
}

}  // namespace
}  // namespace alea
