#include "alea/sphere/sphere_match.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

namespace alea {
namespace {

constexpr std::size_t most_sets = 1000;
constexpr std::size_t most_visits = 2'000'000;

struct Distance {
  double length_m, variance;
};

Distance distance_of(const SphereFit& a, const SphereFit& b) {
  const Eigen::Vector3d between = b.centre_m - a.centre_m;
  const Eigen::Vector3d along = between.normalized();
  return {between.norm(), along.dot((a.covariance + b.covariance) * along)};
}

using Distances = std::vector<std::vector<Distance>>;

Distances distances_of(std::span<const SphereFit> spheres) {
  Distances table(spheres.size(), std::vector<Distance>(spheres.size()));
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = 0; j < spheres.size(); ++j)
      if (i != j) table[i][j] = distance_of(spheres[i], spheres[j]);
  return table;
}

/// Depth-first search over the master's spheres: each is left out or paired with a free slave
/// sphere that agrees with all pairs so far. Keeps every set of the largest size.
class ConsistentSets {
 public:
  ConsistentSets(std::span<const SphereFit> master, std::span<const SphereFit> slave,
                 const SphereMatchOptions& options)
      : options_(options), master_(distances_of(master)), slave_(distances_of(slave)) {
    visit(0);
  }

  const std::vector<std::vector<SpherePair>>& largest() const { return largest_; }
  bool exhausted() const { return visits_ >= most_visits || largest_.size() >= most_sets; }

 private:
  bool agrees(const SpherePair& pair) const {
    return std::all_of(chosen_.begin(), chosen_.end(), [&](const SpherePair& other) {
      if (other.slave == pair.slave) return false;
      const Distance& m = master_[other.master][pair.master];
      const Distance& s = slave_[other.slave][pair.slave];
      const double tolerance =
          options_.tolerance_m + options_.tolerance_sd * std::sqrt(m.variance + s.variance);
      return std::abs(m.length_m - s.length_m) <= tolerance;
    });
  }

  void keep() {
    const std::size_t size = largest_.empty() ? 3 : largest_[0].size();
    if (chosen_.size() > size) largest_.clear();
    if (chosen_.size() >= size) largest_.push_back(chosen_);
  }

  void visit(std::uint32_t master) {
    if (++visits_ >= most_visits || exhausted()) return;
    const std::size_t least = largest_.empty() ? 3 : largest_[0].size();
    if (chosen_.size() + master_.size() - master < least) return;
    if (master == master_.size()) return keep();
    for (std::uint32_t slave = 0; slave < slave_.size(); ++slave) {
      const SpherePair pair{master, slave};
      if (!agrees(pair)) continue;
      chosen_.push_back(pair);
      visit(master + 1);
      chosen_.pop_back();
    }
    visit(master + 1);
  }

  const SphereMatchOptions& options_;
  Distances master_, slave_;
  std::vector<SpherePair> chosen_;
  std::vector<std::vector<SpherePair>> largest_;
  std::size_t visits_ = 0;
};

Refusal no_match(const std::string& message) {
  return {RefusalCode::no_match, message};
}

}  // namespace

Result<SphereRegistration> match_and_register(std::span<const SphereFit> master,
                                              std::span<const SphereFit> slave,
                                              const SphereMatchOptions& options) {
  if (master.size() < 3 || slave.size() < 3)
    return Refusal{RefusalCode::too_few_points,
                   std::to_string(master.size()) + " spheres in the master and " +
                       std::to_string(slave.size()) +
                       " in the slave, three are needed in each; place more of them"};
  const auto used_master = master.first(std::min(master.size(), options.most_targets));
  const auto used_slave = slave.first(std::min(slave.size(), options.most_targets));
  const ConsistentSets sets(used_master, used_slave, options);
  if (sets.exhausted())
    return no_match("too many sets of spheres have equal distances; place them irregularly");
  if (sets.largest().empty())
    return no_match("no three spheres have the same mutual distances in both scans");
  std::vector<SphereRegistration> fits;
  for (const auto& pairs : sets.largest()) {
    auto fit = register_sphere_pairs(master, slave, pairs);
    if (!fit) return fit.refusal();
    fits.push_back(std::move(*fit));
  }
  std::stable_sort(fits.begin(), fits.end(),
                   [](const auto& a, const auto& b) { return a.chi_squared < b.chi_squared; });
  const SphereRegistration& best = fits[0];
  for (std::size_t k = 0; k < best.pairs.size(); ++k) {
    const Eigen::Matrix3d covariance =
        master[best.pairs[k].master].covariance + slave[best.pairs[k].slave].covariance;
    if (best.residual_m[k] >
        options.tolerance_m + options.tolerance_sd * std::sqrt(covariance.trace()))
      return no_match("the distances between the spheres agree, their places do not");
  }
  if (fits.size() > 1 && (fits[1].chi_squared - best.chi_squared) / 2 < options.least_margin)
    return no_match(std::to_string(fits.size()) + " ways to pair " +
                    std::to_string(best.pairs.size()) +
                    " spheres by their distances fit about as well; place them irregularly");
  return best;
}

}  // namespace alea
