#include "alea/pipeline/site_tie.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "alea/core/error.hpp"
#include "alea/transform/horn.hpp"

namespace alea {
namespace {

constexpr double least_spread = 0.01;  // across the line of the points, of their extent along it

struct Pairs {
  std::vector<ControlResidual> points;
  std::vector<double> variances_m2;  ///< of the difference of each pair; empty where unknown
};

void require_distinct(const std::vector<NamedPoint>& points, const char* list) {
  std::vector<std::string> names;
  for (const NamedPoint& point : points) names.push_back(point.name);
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end())
    throw input_error(
        fmt::format("{}: the name '{}' occurs twice; names must differ", list, *twice));
}

Pairs pair_by_name(const std::vector<NamedPoint>& site, const std::vector<NamedPoint>& measured) {
  Pairs pairs;
  bool all_known = true;
  for (const NamedPoint& given : site)
    for (const NamedPoint& seen : measured) {
      if (seen.name != given.name) continue;
      pairs.points.push_back({given.name, given.point_m, seen.point_m, Eigen::Vector3d::Zero()});
      all_known = all_known && given.sd_m && seen.sd_m;
      if (all_known)
        pairs.variances_m2.push_back(*given.sd_m * *given.sd_m + *seen.sd_m * *seen.sd_m);
    }
  if (!all_known) pairs.variances_m2.clear();
  return pairs;
}

bool on_a_line(const std::vector<ControlResidual>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const ControlResidual& p : points) mean += p.site_m / static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const ControlResidual& p : points)
    scatter += (p.site_m - mean) * (p.site_m - mean).transpose();
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
  return values[1] <= least_spread * least_spread * values[2];
}

/// Covariance for unit weights of the pairs' differences, or for their weights.
TransformCovariance covariance_of(const SiteTie& tie, const std::vector<double>& weights) {
  TransformCovariance out;
  for (const ControlResidual& p : tie.points)
    out.about_m += p.site_m / static_cast<double>(tie.points.size());
  Matrix6d information = Matrix6d::Zero();
  for (std::size_t k = 0; k < tie.points.size(); ++k) {
    Eigen::Matrix<double, 3, 6> rows;
    rows << -skew(tie.site_from_master * tie.points[k].master_m - out.about_m),
        Eigen::Matrix3d::Identity();
    information += weights[k] * rows.transpose() * rows;
  }
  out.covariance = information.inverse();
  return out;
}

}  // namespace

Result<SiteTie> tie_to_site(const std::vector<NamedPoint>& site,
                            const std::vector<NamedPoint>& measured) {
  require_distinct(site, "control points");
  require_distinct(measured, "measured points");
  const Pairs pairs = pair_by_name(site, measured);
  if (pairs.points.size() < 3)
    return Refusal{RefusalCode::too_few_points,
                   fmt::format("{} of {} control points have the name of a measured point; three "
                               "are needed to tie the scans to the site's system",
                               pairs.points.size(), site.size())};
  if (on_a_line(pairs.points))
    return Refusal{RefusalCode::collinear,
                   "the control points lie on a line, which leaves the turn about it open; add one "
                   "beside it"};
  SiteTie tie;
  tie.points = pairs.points;
  std::vector<Eigen::Vector3d> given, seen;
  std::vector<double> weights;
  for (const ControlResidual& p : tie.points) {
    given.push_back(p.site_m);
    seen.push_back(p.master_m);
  }
  for (const double variance : pairs.variances_m2) weights.push_back(1 / variance);
  if (weights.empty()) weights.assign(tie.points.size(), 1);
  tie.site_from_master = horn(given, seen, weights);
  double squares = 0;
  for (ControlResidual& p : tie.points) {
    p.residual_m = tie.site_from_master * p.master_m - p.site_m;
    squares += p.residual_m.squaredNorm();
  }
  const auto count = static_cast<double>(tie.points.size());
  tie.rmse_m = std::sqrt(squares / count);
  tie.covariance = covariance_of(tie, weights);
  if (pairs.variances_m2.empty()) tie.covariance.covariance *= squares / (3 * count - 6);
  return tie;
}

}  // namespace alea
