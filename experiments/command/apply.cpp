#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/cloud_file.hpp"
#include "experiments/command/command.hpp"
#include "experiments/command/reading.hpp"
#include "experiments/command/registration_json.hpp"

namespace alea::command {
namespace {

struct ApplyArguments {
  std::string registration, scan, out;
  CommonOptions common;
  ReadingOptions reading;
};

/// E57 and PTX carry a pose, so their points can stay as the scanner gave them.
bool carries_pose(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".e57" || extension == ".ptx";
}

void check_poses(const std::string& path, const std::vector<ScanFile>& scans) {
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (scans[i].pose && !is_rigid(*scans[i].pose))
      throw input_error(
          fmt::format("{}: the pose of scan {} is not rigid, so a registration cannot be joined to "
                      "it; convert it with --apply-pose first",
                      path, i + 1));
}

void write_with_pose(const RigidTransform& master_from_slave, std::vector<ScanFile> scans,
                     const std::string& out) {
  for (ScanFile& scan : scans)
    scan.pose = master_from_slave.matrix() * scan.pose.value_or(Eigen::Matrix4d::Identity());
  write_scans(out, std::move(scans));
}

void write_moved(const RigidTransform& master_from_slave, Cloud cloud, const std::string& out) {
  for (Eigen::Vector3d& p : cloud.positions) p = master_from_slave * p;
  const Eigen::Matrix3f rotation = master_from_slave.rotation.cast<float>();
  for (Eigen::Vector3f& normal : cloud.normals) normal = rotation * normal;
  if (cloud.scanner_position) cloud.scanner_position = master_from_slave * *cloud.scanner_position;
  write_cloud(out, cloud);
}

int run(const ApplyArguments& arguments) {
  const ThreadLimit limit(arguments.common.threads);
  const RigidTransform master_from_slave = read_transform(arguments.registration);
  const ReadOptions options = read_options(arguments.reading);
  std::vector<ScanFile> scans = read_scans(arguments.scan, options);
  check_poses(arguments.scan, scans);
  if (carries_pose(arguments.out))
    write_with_pose(master_from_slave, std::move(scans), arguments.out);
  else
    write_moved(master_from_slave, merged_scans(std::move(scans), options), arguments.out);
  return exit_done;
}

}  // namespace

void add_apply(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<ApplyArguments>();
  CLI::App* command =
      app.add_subcommand("apply", "Moves a slave scan into the master's frame by a registration");
  command
      ->add_option("REGISTRATION", arguments->registration,
                   "JSON of `alea register`, or 16 numbers row by row (master_from_slave, metres)")
      ->required();
  command->add_option("SCAN", arguments->scan, "The slave scan")->required();
  command
      ->add_option("OUT", arguments->out,
                   "File to write: E57 and PTX get the pose and keep their points, other formats "
                   "get moved points")
      ->required();
  add_reading_options(*command, arguments->reading);
  command->add_option("--threads", arguments->common.threads, "Threads (0: all cores)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
