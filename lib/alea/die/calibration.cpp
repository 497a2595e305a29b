#include "alea/die/calibration.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "alea/core/error.hpp"

namespace alea {
namespace {

/// Offset of one pair and how it depends on everything, at the slave's centroid.
struct PairOffset {
  double offset_m = 0;
  Eigen::Vector3d normal;  // of the master's plane
  Eigen::Vector3d at_m;    // slave's centroid in the master frame
  double variance_m2 = 0;  // of the two planes
};

PairOffset offset_of(const PlanePair& pair, const RigidTransform& master_from_slave) {
  PairOffset out;
  out.normal = pair.master.plane.normal;
  out.at_m = master_from_slave * pair.slave.centroid_m;
  const Eigen::Vector3d lever = out.at_m - pair.master.centroid_m;
  out.offset_m = out.normal.dot(lever);
  // The master's plane at that point: its own shift and its tilts times the lever.
  const Eigen::Vector3d master(lever.dot(pair.master.tangent.col(0)),
                               lever.dot(pair.master.tangent.col(1)), -1);
  out.variance_m2 = master.dot(pair.master.covariance * master) + pair.slave.covariance(2, 2);
  return out;
}

void check_model(const std::vector<PlanePair>& pairs, const LengthModel& model) {
  if (model.directions.rows() != 3 || model.directions.cols() != model.lengths_m.size() ||
      model.lengths_m.size() == 0)
    throw usage_error("calibration: directions must be 3 x k for k >= 1 lengths");
  if (pairs.empty())
    throw usage_error("calibration: no plane pairs given; find planes that both scans see");
}

/// Covariance of the offsets: planes apart, the transform common to all.
Eigen::MatrixXd offset_covariance(const std::vector<PairOffset>& offsets,
                                  const LengthModel& model) {
  const auto n = static_cast<Eigen::Index>(offsets.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd by_transform = Eigen::MatrixXd::Zero(n, 6);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PairOffset& offset = offsets[static_cast<std::size_t>(i)];
    // Noise-free planes still need a weight.
    out(i, i) = std::max(offset.variance_m2, 1e-18);
    if (!model.covariance) continue;
    const Eigen::Vector3d lever = offset.at_m - model.covariance->about_m;
    by_transform.row(i).head<3>() = lever.cross(offset.normal);
    by_transform.row(i).tail<3>() = offset.normal;
  }
  if (model.covariance)
    out += by_transform * model.covariance->covariance * by_transform.transpose();
  return out;
}

/// Component j is observable where its unit vector has no part in the null space of the normal
/// matrix.
std::vector<bool> observable_components(const Eigen::MatrixXd& sensitivity, double least) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(sensitivity, Eigen::ComputeFullV);
  std::vector<bool> out(static_cast<std::size_t>(sensitivity.cols()), true);
  for (Eigen::Index c = 0; c < sensitivity.cols(); ++c) {
    const double strength = c < svd.singularValues().size() ? svd.singularValues()[c] : 0;
    if (strength >= least) continue;
    for (Eigen::Index j = 0; j < sensitivity.cols(); ++j)
      if (std::abs(svd.matrixV()(j, c)) > 1e-3) out[static_cast<std::size_t>(j)] = false;
  }
  return out;
}

Eigen::MatrixXd columns_of(const Eigen::MatrixXd& matrix, const std::vector<bool>& kept) {
  Eigen::MatrixXd out(matrix.rows(), std::count(kept.begin(), kept.end(), true));
  for (Eigen::Index j = 0, to = 0; j < matrix.cols(); ++j)
    if (kept[static_cast<std::size_t>(j)]) out.col(to++) = matrix.col(j);
  return out;
}

void solve(const Eigen::VectorXd& offsets, const Eigen::MatrixXd& weights, LengthCalibration& out) {
  const Eigen::MatrixXd design = columns_of(out.sensitivity, out.observable);
  const Eigen::MatrixXd information = design.transpose() * weights * design;
  const Eigen::MatrixXd covariance =
      information.ldlt().solve(Eigen::MatrixXd::Identity(design.cols(), design.cols()));
  const Eigen::VectorXd correction = -covariance * design.transpose() * weights * offsets;
  const auto k = out.lengths_m.size();
  out.covariance = Eigen::MatrixXd::Zero(k, k);
  std::vector<Eigen::Index> places;
  for (Eigen::Index j = 0; j < k; ++j) {
    if (out.observable[static_cast<std::size_t>(j)])
      places.push_back(j);
    else
      out.covariance(j, j) = std::numeric_limits<double>::infinity();
  }
  for (Eigen::Index a = 0; a < design.cols(); ++a) {
    const Eigen::Index j = places[static_cast<std::size_t>(a)];
    out.lengths_m[j] += correction[a];
    for (Eigen::Index b = 0; b < design.cols(); ++b)
      out.covariance(j, places[static_cast<std::size_t>(b)]) = covariance(a, b);
  }
  out.offsets_m = offsets + design * correction;
  out.redundancy = static_cast<int>(offsets.size() - design.cols());
  if (out.redundancy > 0)
    out.variance_factor = out.offsets_m.dot(weights * out.offsets_m) / out.redundancy;
}

}  // namespace

RigidTransform at_lengths(const LengthModel& model, const Eigen::VectorXd& lengths_m) {
  RigidTransform out = model.master_from_slave;
  out.translation += model.directions * (lengths_m - model.lengths_m);
  return out;
}

Result<LengthCalibration> calibrate_lengths(const std::vector<PlanePair>& pairs,
                                            const LengthModel& model,
                                            const CalibrationOptions& options) {
  check_model(pairs, model);
  std::vector<PairOffset> offsets;
  Eigen::VectorXd values(static_cast<Eigen::Index>(pairs.size()));
  LengthCalibration out;
  out.sensitivity.resize(values.size(), model.lengths_m.size());
  for (const PlanePair& pair : pairs) {
    const auto i = static_cast<Eigen::Index>(offsets.size());
    offsets.push_back(offset_of(pair, model.master_from_slave));
    values[i] = offsets.back().offset_m;
    out.sensitivity.row(i) = offsets.back().normal.transpose() * model.directions;
  }
  out.observable = observable_components(out.sensitivity, options.min_sensitivity);
  if (std::count(out.observable.begin(), out.observable.end(), true) == 0)
    return Refusal{RefusalCode::unobservable,
                   "no plane common to both scans is inclined to the die's edge, so its length "
                   "cannot be calibrated; add a plane across the edge or measure the edge"};
  out.lengths_m = model.lengths_m;
  const Eigen::MatrixXd covariance = offset_covariance(offsets, model);
  const Eigen::MatrixXd weights =
      covariance.ldlt().solve(Eigen::MatrixXd::Identity(values.size(), values.size()));
  solve(values, weights, out);
  out.master_from_slave = at_lengths(model, out.lengths_m);
  return out;
}

double rms_offset_m(const std::vector<PlanePair>& pairs, const RigidTransform& master_from_slave) {
  double sum = 0;
  for (const PlanePair& pair : pairs)
    sum += std::pow(offset_of(pair, master_from_slave).offset_m, 2);
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

GoldenSection golden_section(const std::function<double(double)>& objective, double low,
                             double high, double tolerance) {
  if (!(low < high) || !(tolerance > 0))
    throw usage_error("golden section: needs low < high and a positive tolerance");
  constexpr double ratio = 1 / std::numbers::phi;
  const double first = low, last = high;
  const double worse_end = std::max(objective(low), objective(high));
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double at_a = objective(a), at_b = objective(b);
  GoldenSection out;
  out.evaluations = 4;
  while (high - low > tolerance) {
    const bool left = at_a < at_b;
    if (left) {
      high = b, b = a, at_b = at_a;
      a = high - ratio * (high - low);
      at_a = objective(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + ratio * (high - low);
      at_b = objective(b);
    }
    ++out.evaluations;
  }
  out.argument = at_a < at_b ? a : b;
  out.value = std::min(at_a, at_b);
  out.rise = out.value > 0 ? worse_end / out.value - 1
                           : (worse_end > 0 ? std::numeric_limits<double>::infinity() : 0);
  out.at_border = out.argument - first < 2 * tolerance || last - out.argument < 2 * tolerance;
  return out;
}

}  // namespace alea
