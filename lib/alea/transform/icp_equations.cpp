#include "alea/transform/icp_equations.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "alea/core/parallel.hpp"
#include "alea/transform/horn.hpp"

namespace alea {
namespace {

constexpr std::size_t chunk = 2048;

/// Adds what `part` finds in each chunk, chunk by chunk: the same bits for any thread count.
template <typename Sums, typename Part>
Sums sum_in_order(std::size_t count, const Part& part) {
  std::vector<Sums> parts((count + chunk - 1) / chunk);
  parallel_chunks(count, chunk, [&](std::size_t begin, std::size_t end) {
    part(begin, end, parts[begin / chunk]);
  });
  Sums total;
  for (const Sums& one : parts) total.add(one);
  return total;
}

struct Extent {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0, distance_squares = 0;
  void add(const Extent& other) {
    sum += other.sum;
    squares += other.squares;
    distance_squares += other.distance_squares;
  }
};

struct TwoTerms {
  IcpSums geometric, photometric;
  void add(const TwoTerms& other) {
    for (const auto& [to, from] :
         {std::pair{&geometric, &other.geometric}, std::pair{&photometric, &other.photometric}}) {
      to->normal_matrix += from->normal_matrix;
      to->gradient += from->gradient;
      to->squares += from->squares;
    }
  }
};

struct IntensityMoments {
  double source = 0, source_squared = 0, target = 0, target_squared = 0;
  void add(const IntensityMoments& other) {
    source += other.source;
    source_squared += other.source_squared;
    target += other.target;
    target_squared += other.target_squared;
  }
};

void add_row(const Vector6d& jacobian, double residual, double weight, IcpSums& sums) {
  sums.normal_matrix.noalias() += (weight * jacobian) * jacobian.transpose();
  sums.gradient += (weight * residual) * jacobian;
  sums.squares += weight * residual * residual;
}

/// d of (a . q) for a moved point q, turned about `about`: (q - about) x a, a.
Vector6d row_along(const Eigen::Vector3d& arm, const Eigen::Vector3d& direction) {
  Vector6d row;
  row << arm.cross(direction), direction;
  return row;
}

double normal_residual(const IcpTarget::Data& target, const IcpPairs& pairs, std::size_t i) {
  const std::uint32_t p = pairs.target[i];
  return (pairs.moved[i] - target.points.positions[p]).dot(target.points.normals[p]);
}

/// The target's intensity continued to the foot of q on the tangent plane of p: C_p(f(q)) =
/// C(p) + d_p . (f(q) - p). The gradient lies in the plane, so f needs no projection. Equation
/// (12).
double continued_intensity(const IcpTarget::Data& target, const IcpPairs& pairs, std::size_t i) {
  const std::uint32_t p = pairs.target[i];
  return target.points.intensity[p] +
         target.gradients[p].dot(pairs.moved[i] - target.points.positions[p]);
}

/// Square residuals to weights, from their own scale.
class Kernel {
 public:
  template <typename Residual>
  Kernel(RobustKernel kernel, const IcpPairs& pairs, const Residual& residual) : kernel_(kernel) {
    if (kernel == RobustKernel::none || pairs.count == 0) return;
    std::vector<double> sizes;
    sizes.reserve(pairs.count);
    for (std::size_t i = 0; i < pairs.used.size(); ++i)
      if (pairs.used[i]) sizes.push_back(std::abs(residual(i)));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double scale = std::max(1.4826 * *middle, 1e-12);
    bound_ = scale * (kernel == RobustKernel::huber ? 1.345 : 4.685);
  }
  double weight(double residual) const {
    const double size = std::abs(residual);
    if (kernel_ == RobustKernel::none) return 1;
    if (kernel_ == RobustKernel::huber) return size <= bound_ ? 1 : bound_ / size;
    const double share = 1 - (size / bound_) * (size / bound_);
    return share > 0 ? share * share : 0;
  }

 private:
  RobustKernel kernel_;
  double bound_ = 0;
};

void add_extent(const IcpPairs& pairs, IcpSystem& system) {
  const auto extent = sum_in_order<Extent>(pairs.used.size(),
                                           [&](std::size_t begin, std::size_t end, Extent& sums) {
                                             for (std::size_t i = begin; i < end; ++i) {
                                               if (!pairs.used[i]) continue;
                                               sums.sum += pairs.moved[i];
                                               sums.squares += pairs.moved[i].squaredNorm();
                                               sums.distance_squares += pairs.squared_m2[i];
                                             }
                                           });
  const auto n = static_cast<double>(pairs.count);
  system.about = extent.sum / n;
  system.radius_m = std::sqrt(std::max(extent.squares / n - system.about.squaredNorm(), 0.0));
  system.distance_squares = extent.distance_squares;
}

void match_intensities(const IcpTarget::Data& target, const IcpPoints& source,
                       const IcpPairs& pairs, IcpSystem& system) {
  const auto moments = sum_in_order<IntensityMoments>(
      pairs.used.size(), [&](std::size_t begin, std::size_t end, IntensityMoments& sums) {
        for (std::size_t i = begin; i < end; ++i) {
          if (!pairs.used[i]) continue;
          const double s = source.intensity[i], t = target.points.intensity[pairs.target[i]];
          sums.source += s;
          sums.source_squared += s * s;
          sums.target += t;
          sums.target_squared += t * t;
        }
      });
  const auto n = static_cast<double>(pairs.count);
  const double mean_s = moments.source / n, mean_t = moments.target / n;
  const double variance_s = moments.source_squared / n - mean_s * mean_s;
  const double variance_t = moments.target_squared / n - mean_t * mean_t;
  if (!(variance_s > 0) || !(variance_t > 0)) return;
  system.gain = std::sqrt(variance_t / variance_s);
  system.offset = mean_t - system.gain * mean_s;
}

void weigh_terms(const IcpOptions& options, double pairs, IcpSystem& system) {
  if (options.objective != IcpObjective::coloured) return;
  if (options.weighting == ColourWeighting::published) {
    system.geometric_weight = options.lambda;  // Equation (13)
    system.photometric_weight = 1 - options.lambda;
    return;
  }
  // Data without noise would drive a weight to infinity and hide the other term: neither standard
  // deviation counts as less than 1e-4 of its scale.
  const double least_m2 = 1e-8 * system.radius_m * system.radius_m, least_intensity = 1e-8;
  system.geometric_weight = 1 / std::max(system.geometric.squares / pairs, least_m2);
  system.photometric_weight = 1 / std::max(system.photometric.squares / pairs, least_intensity);
}

}  // namespace

Matrix6d IcpSystem::normal_matrix() const {
  return geometric_weight * geometric.normal_matrix +
         photometric_weight * photometric.normal_matrix;
}

Vector6d IcpSystem::gradient() const {
  return geometric_weight * geometric.gradient + photometric_weight * photometric.gradient;
}

IcpSystem icp_system(const IcpTarget::Data& target, const IcpPoints& source, const IcpPairs& pairs,
                     const IcpOptions& options) {
  IcpSystem system;
  add_extent(pairs, system);
  const bool to_points = options.objective == IcpObjective::point_to_point;
  const bool coloured = options.objective == IcpObjective::coloured;
  if (coloured && options.match_intensity) match_intensities(target, source, pairs, system);
  const auto geometric = [&](std::size_t i) {
    return to_points ? std::sqrt(pairs.squared_m2[i]) : normal_residual(target, pairs, i);
  };
  const auto photometric = [&](std::size_t i) {
    return continued_intensity(target, pairs, i) -
           (system.gain * source.intensity[i] + system.offset);
  };
  const Kernel geometric_kernel(options.kernel, pairs, geometric);
  const Kernel photometric_kernel(coloured ? options.kernel : RobustKernel::none, pairs,
                                  photometric);
  const auto add_pair = [&](std::size_t i, TwoTerms& sums) {
    const std::uint32_t p = pairs.target[i];
    const Eigen::Vector3d arm = pairs.moved[i] - system.about;
    const double residual = geometric(i), weight = geometric_kernel.weight(residual);
    if (to_points) {
      const Eigen::Vector3d off = pairs.moved[i] - target.points.positions[p];
      for (int a = 0; a < 3; ++a)
        add_row(row_along(arm, Eigen::Vector3d::Unit(a)), off[a], weight, sums.geometric);
      return;
    }
    // Equation (15): r_G = (s(q, T) - p) . n_p
    add_row(row_along(arm, target.points.normals[p]), residual, weight, sums.geometric);
    if (!coloured) return;
    // Equation (14): r_C = C_p(f(s(q, T))) - C(q)
    const double difference = photometric(i);
    add_row(row_along(arm, target.gradients[p]), difference, photometric_kernel.weight(difference),
            sums.photometric);
  };
  const auto terms = sum_in_order<TwoTerms>(
      pairs.used.size(), [&](std::size_t begin, std::size_t end, TwoTerms& sums) {
        for (std::size_t i = begin; i < end; ++i)
          if (pairs.used[i]) add_pair(i, sums);
      });
  system.geometric = terms.geometric;
  system.photometric = terms.photometric;
  weigh_terms(options, static_cast<double>(pairs.count), system);
  return system;
}

IcpStep solve(const IcpSystem& system, double null_space_share) {
  Vector6d unit = Vector6d::Ones();  // rotations in units of the radius: all six are lengths
  unit.head<3>() /= std::max(system.radius_m, 1e-12);
  const Matrix6d scaled = unit.asDiagonal() * system.normal_matrix() * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(scaled);
  const Vector6d right = -(unit.asDiagonal() * system.gradient());
  IcpStep step;
  const double least = std::max(null_space_share * solver.eigenvalues()[5], 1e-300);
  for (int k = 0; k < 6; ++k) {
    if (!(solver.eigenvalues()[k] > least)) continue;
    const Vector6d direction = solver.eigenvectors().col(k);
    step.delta += direction * (direction.dot(right) / solver.eigenvalues()[k]);
    ++step.determined;
  }
  step.delta = unit.asDiagonal() * step.delta;
  return step;
}

RigidTransform closed_form_step(const IcpTarget::Data& target, const IcpPairs& pairs,
                                const IcpOptions& options) {
  const auto distance = [&](std::size_t i) { return std::sqrt(pairs.squared_m2[i]); };
  const Kernel kernel(options.kernel, pairs, distance);
  std::vector<Eigen::Vector3d> to, from;
  std::vector<double> weights;
  for (std::size_t i = 0; i < pairs.used.size(); ++i) {
    const double weight = pairs.used[i] ? kernel.weight(distance(i)) : 0;
    if (!(weight > 0)) continue;
    to.push_back(target.points.positions[pairs.target[i]]);
    from.push_back(pairs.moved[i]);
    weights.push_back(weight);
  }
  return to.size() < 3 ? RigidTransform{} : horn(to, from, weights);
}

}  // namespace alea
