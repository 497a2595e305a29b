#include "alea/markerless/feature_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "alea/transform/horn.hpp"

namespace alea {
namespace {

struct Nearest {
  std::uint32_t index = 0;
  float first = std::numeric_limits<float>::infinity();
  float second = std::numeric_limits<float>::infinity();
};

float squared_distance(const Fpfh& a, const Fpfh& b) {
  float sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

std::vector<Nearest> nearest_of(const std::vector<Fpfh>& from, const std::vector<Fpfh>& to) {
  std::vector<Nearest> nearest(from.size());
  parallel_chunks(from.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::uint32_t j = 0; j < to.size(); ++j) {
        const float d = squared_distance(from[i], to[j]);
        if (d < nearest[i].first)
          nearest[i] = {j, d, nearest[i].first};
        else
          nearest[i].second = std::min(nearest[i].second, d);
      }
  });
  return nearest;
}

/// Features of the coarse points that are not plain: those of flat surfaces say nothing.
struct Described {
  std::vector<Eigen::Vector3d> places;
  std::vector<Fpfh> features;
};

Described described(const PreparedScan& scan) {
  const NeighbourIndex index(scan.coarse.positions);
  const std::vector<Fpfh> all = fpfh(scan.coarse, index, 15 * scan.cell_m);
  // Distance from the mean feature: the most common surface is the least telling.
  Fpfh mean{};
  for (const Fpfh& f : all)
    for (std::size_t k = 0; k < f.size(); ++k) mean[k] += f[k] / static_cast<float>(all.size());
  std::vector<std::uint32_t> order(all.size());
  std::vector<float> off(all.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    order[i] = i;
    off[i] = squared_distance(all[i], mean);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return off[a] > off[b]; });
  order.resize(std::min<std::size_t>(order.size(), 1500));
  Described out;
  for (const std::uint32_t i : order) {
    out.places.push_back(scan.coarse.positions[i]);
    out.features.push_back(all[i]);
  }
  return out;
}

class Consensus {
 public:
  Consensus(const Described& fixed, const Described& moving, std::vector<FeatureMatch> matches,
            double tolerance_m)
      : fixed_(fixed), moving_(moving), matches_(std::move(matches)), tolerance_m_(tolerance_m) {}

  std::size_t size() const { return matches_.size(); }

  /// The pose of three matches, where their sides agree and are long enough.
  std::optional<PoseCandidate> pose_of(const std::array<std::size_t, 3>& drawn) const {
    std::array<Eigen::Vector3d, 3> to, from;
    for (std::size_t k = 0; k < 3; ++k) {
      to[k] = fixed_.places[matches_[drawn[k]].a];
      from[k] = moving_.places[matches_[drawn[k]].b];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const double in_fixed = (to[k] - to[(k + 1) % 3]).norm();
      const double in_moving = (from[k] - from[(k + 1) % 3]).norm();
      if (std::min(in_fixed, in_moving) < 3 * tolerance_m_ ||
          std::abs(in_fixed - in_moving) > tolerance_m_)
        return std::nullopt;
    }
    const RigidTransform pose = horn(to, from);
    std::size_t agree = 0;
    for (const FeatureMatch& match : matches_)
      if ((pose * moving_.places[match.b] - fixed_.places[match.a]).squaredNorm() <
          tolerance_m_ * tolerance_m_)
        ++agree;
    if (agree < 4) return std::nullopt;
    return PoseCandidate{pose, static_cast<double>(agree), CandidateSource::features};
  }

 private:
  const Described& fixed_;
  const Described& moving_;
  std::vector<FeatureMatch> matches_;
  double tolerance_m_;
};

}  // namespace

std::vector<FeatureMatch> match_features(const std::vector<Fpfh>& a, const std::vector<Fpfh>& b,
                                         double largest_ratio) {
  const std::vector<Nearest> forward = nearest_of(a, b), backward = nearest_of(b, a);
  std::vector<FeatureMatch> matches;
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    const Nearest& found = forward[i];
    if (b.empty() || backward[found.index].index != i) continue;
    const float ratio = found.second > 0 ? found.first / found.second : 1;
    if (ratio <= largest_ratio) matches.push_back({i, found.index, ratio});
  }
  return matches;
}

std::vector<PoseCandidate> feature_candidates(const PreparedScan& fixed, const PreparedScan& moving,
                                              const FeatureMatchOptions& options) {
  const Described of_fixed = described(fixed), of_moving = described(moving);
  const double tolerance_m = 6 * std::max(fixed.cell_m, moving.cell_m);
  const Consensus consensus(
      of_fixed, of_moving, match_features(of_fixed.features, of_moving.features, 1.0), tolerance_m);
  if (consensus.size() < 4) return {};
  RandomStream stream({options.seed, 0, 0, 0, Purpose::sampling});
  std::vector<PoseCandidate> found;
  for (std::size_t draw = 0; draw < options.draws; ++draw) {
    const std::array<std::size_t, 3> drawn{stream.below(consensus.size()),
                                           stream.below(consensus.size()),
                                           stream.below(consensus.size())};
    if (drawn[0] == drawn[1] || drawn[1] == drawn[2] || drawn[0] == drawn[2]) continue;
    if (const auto pose = consensus.pose_of(drawn)) found.push_back(*pose);
  }
  return distinct(std::move(found), 5 * std::numbers::pi / 180, 2 * tolerance_m,
                  options.candidates);
}

}  // namespace alea
