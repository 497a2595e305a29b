#include <fmt/format.h>

#include <Eigen/LU>
#include <utility>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/cloud_file.hpp"

namespace alea {
namespace {

// Moves positions and the scanner by the pose, normals by its inverse transpose.
void apply_pose(Cloud& cloud, const Eigen::Matrix4d& pose) {
  const Eigen::Matrix3d linear = pose.topLeftCorner<3, 3>();
  const Eigen::Vector3d shift = pose.topRightCorner<3, 1>();
  const Eigen::Matrix3f turn = linear.inverse().transpose().cast<float>();
  parallel_chunks(cloud.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      cloud.positions[i] = (linear * cloud.positions[i] + shift).eval();
      if (!cloud.normals.empty()) cloud.normals[i] = (turn * cloud.normals[i]).normalized().eval();
    }
  });
  if (cloud.scanner_position)
    cloud.scanner_position = (linear * *cloud.scanner_position + shift).eval();
}

template <typename T>
void append(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
  std::vector<T>().swap(from);
}

// Keeps an optional array only where every non-empty scan has it.
template <typename T>
void merge_channel(Cloud& out, std::vector<ScanFile>& scans, std::vector<T> Cloud::*channel) {
  for (const ScanFile& scan : scans)
    if (!scan.cloud.empty() && (scan.cloud.*channel).empty()) return;
  for (ScanFile& scan : scans) append(out.*channel, scan.cloud.*channel);
}

}  // namespace

bool is_rigid(const Eigen::Matrix4d& pose) {
  const Eigen::Matrix3d r = pose.topLeftCorner<3, 3>();
  const bool orthogonal =
      ((r.transpose() * r - Eigen::Matrix3d::Identity()).array().abs() <= 1e-3).all();
  return pose.allFinite() && orthogonal && r.determinant() > 0 &&
         pose.row(3) == Eigen::RowVector4d(0, 0, 0, 1);
}

std::vector<std::string> pose_warnings(const std::vector<ScanFile>& scans) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (scans[i].pose && !is_rigid(*scans[i].pose))
      warnings.push_back(
          fmt::format("pose_not_rigid: the pose of scan {} scales, shears or mirrors", i + 1));
  return warnings;
}

Cloud merged_scans(std::vector<ScanFile> scans, const ReadOptions& options) {
  if (scans.empty()) return {};
  for (std::size_t i = 0; i < scans.size(); ++i) {
    ScanFile& scan = scans[i];
    if (!scan.pose || (scans.size() == 1 && !options.apply_pose)) continue;
    if (!options.accept_non_rigid_pose && !is_rigid(*scan.pose))
      throw input_error(fmt::format(
          "scan {}: its pose is not rigid (R'R is not the identity to 1e-3); read the scan "
          "alone in its own frame with #{}",
          i + 1, i + 1));
    apply_pose(scan.cloud, *scan.pose);
  }
  if (scans.size() == 1) return std::move(scans[0].cloud);
  Cloud out;
  out.scanner_position = scans[0].cloud.scanner_position;
  for (const ScanFile& scan : scans) {
    out.dropped.non_finite += scan.cloud.dropped.non_finite;
    out.dropped.invalid += scan.cloud.dropped.invalid;
    out.dropped.missing += scan.cloud.dropped.missing;
    if (scan.cloud.scanner_position != out.scanner_position) out.scanner_position.reset();
  }
  merge_channel(out, scans, &Cloud::intensity);
  merge_channel(out, scans, &Cloud::normals);
  merge_channel(out, scans, &Cloud::colours);
  merge_channel(out, scans, &Cloud::positions);
  return out;
}

}  // namespace alea
