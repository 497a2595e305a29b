#include "alea/pipeline/die_calibration.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "alea/core/error.hpp"
#include "alea/die/calibration.hpp"
#include "alea/pipeline/check_plane_roles.hpp"

namespace alea {
namespace {

constexpr double search_half_width = 0.1;  // of the nominal length; the paper names no interval
constexpr double search_tolerance_m = 1e-5;

/// Count, mean and scatter of points: enough for the RMSE of a plane through any rigid union of
/// them.
struct Moments {
  double count = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
};

Moments moments_of(const Cloud& cloud, const std::vector<std::uint32_t>& indices) {
  Moments out;
  out.count = static_cast<double>(indices.size());
  for (const std::uint32_t i : indices) out.mean += cloud.positions[i] / out.count;
  for (const std::uint32_t i : indices) {
    const Eigen::Vector3d d = cloud.positions[i] - out.mean;
    out.scatter += d * d.transpose();
  }
  return out;
}

double union_squared_residuals(const Moments& master, const Moments& slave,
                               const RigidTransform& master_from_slave) {
  const Eigen::Vector3d apart = master_from_slave * slave.mean - master.mean;
  const double reduced = master.count * slave.count / (master.count + slave.count);
  const Eigen::Matrix3d scatter =
      master.scatter +
      master_from_slave.rotation * slave.scatter * master_from_slave.rotation.transpose() +
      reduced * apart * apart.transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter, Eigen::EigenvaluesOnly)
      .eigenvalues()[0];
}

/// Equation (9) of the die paper: golden section on the RMSE of the planes, which are the check
/// planes too. The search is one-dimensional and the paper has several lengths, so the side length
/// and the lift take turns.
Eigen::VectorXd golden_section_lengths(const Cloud& master, const Cloud& slave, const DiePair& pair,
                                       const std::vector<CommonPlane>& planes,
                                       const DieRegistrationOptions& options) {
  std::vector<std::pair<Moments, Moments>> moments;
  for (const CommonPlane& plane : planes)
    moments.emplace_back(moments_of(master, plane.indices_master),
                         moments_of(slave, plane.indices_slave));
  const auto rmse_m = [&](const Eigen::VectorXd& lengths_m) {
    const Result<DieTransform> at = transform_by_die(pair.master, pair.slave, options, lengths_m);
    double squares = 0, count = 0;
    for (const auto& [of_master, of_slave] : moments) {
      squares += union_squared_residuals(of_master, of_slave, at->master_from_slave);
      count += of_master.count + of_slave.count;
    }
    return std::sqrt(squares / count);
  };
  Eigen::VectorXd lengths_m = pair.transform.lengths_m;
  const double half_width_m = search_half_width * lengths_m[0];
  for (int turn = 0; turn < 4; ++turn) {
    const int k = turn % 2;
    Eigen::VectorXd tried = lengths_m;
    lengths_m[k] = golden_section(
                       [&](double length_m) {
                         tried[k] = length_m;
                         return rmse_m(tried);
                       },
                       lengths_m[k] - half_width_m, lengths_m[k] + half_width_m, search_tolerance_m)
                       .argument;
  }
  return lengths_m;
}

Result<DieTransform> calibrate_like_the_paper(const Cloud& master, const Cloud& slave,
                                              const DiePair& pair,
                                              const std::vector<CommonPlane>& planes,
                                              const DieRegistrationOptions& options) {
  if (planes.empty())
    return Refusal{RefusalCode::unobservable,
                   "no plane is seen in both scans, so the length cannot be calibrated"};
  Result<DieTransform> out =
      transform_by_die(pair.master, pair.slave, options,
                       golden_section_lengths(master, slave, pair, planes, options));
  if (out)
    out->warnings.push_back(
        "circular_calibration: the length was calibrated on the very planes that check it, as "
        "published; their residuals prove nothing");
  return out;
}

Result<DieTransform> calibrate_linearly(const DiePair& pair, const std::vector<CommonPlane>& planes,
                                        const std::vector<CheckPlaneRole>& roles,
                                        const DieRegistrationOptions& options) {
  std::vector<PlanePair> calibration;
  for (const CommonPlane& plane : planes_with_role(planes, roles, CheckPlaneRole::calibration))
    calibration.push_back({plane.fit_master, plane.fit_slave});
  if (calibration.empty())
    return Refusal{
        RefusalCode::unobservable,
        fmt::format("no plane to calibrate the length on ({} planes that both scans see, "
                    "none left for it); scan walls or floor too, or measure the edge",
                    planes.size())};
  // A length taken as exact is only an initial value here, so its variance must not enter twice.
  DieRegistrationOptions exact = options;
  exact.edge_sd_m.reset();
  const Result<DieTransform> initial = transform_by_die(pair.master, pair.slave, exact);
  if (!initial) return initial.refusal();
  const LengthModel model{initial->master_from_slave, initial->covariance, initial->lengths_m,
                          initial->directions};
  const Result<LengthCalibration> calibrated = calibrate_lengths(calibration, model);
  if (!calibrated)
    return Refusal{calibrated.refusal().code,
                   fmt::format("{} ({} calibration planes of {} planes that both scans see)",
                               calibrated.refusal().message, calibration.size(), planes.size())};
  const double sd_m =
      std::sqrt(calibrated->covariance(0, 0) * std::max(1.0, calibrated->variance_factor));
  return transform_by_die(pair.master, pair.slave, options, calibrated->lengths_m, sd_m);
}

}  // namespace

std::vector<CheckPlaneRole> plane_roles(const std::vector<CommonPlane>& planes,
                                        const DieRegistrationOptions& options) {
  const bool for_lengths =
      (options.calibrate || options.join_planes) && !is_published(options.method);
  const bool uses_planes = for_lengths || options.refine != Refinement::none;
  std::vector<CheckPlaneRole> roles(planes.size(), CheckPlaneRole::check);
  if (!options.check_plane_centroids_m.empty()) {
    const auto named = named_check_planes(planes, options.check_plane_centroids_m);
    return uses_planes ? named : roles;
  }
  if (!uses_planes) return roles;
  for (std::size_t rank = 1; rank <= planes.size(); rank += 2)
    roles[rank - 1] = CheckPlaneRole::calibration;
  return roles;
}

Result<DieTransform> calibrate_die(const Cloud& master, const Cloud& slave, const DiePair& pair,
                                   const std::vector<CommonPlane>& planes,
                                   const std::vector<CheckPlaneRole>& roles,
                                   const DieRegistrationOptions& options) {
  if (pair.transform.lengths_m.size() == 0)
    return pair.transform;  // the transform rests on no length
  return is_published(options.method)
             ? calibrate_like_the_paper(master, slave, pair, planes, options)
             : calibrate_linearly(pair, planes, roles, options);
}

}  // namespace alea
