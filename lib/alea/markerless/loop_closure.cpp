#include "alea/markerless/loop_closure.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

namespace alea {
namespace {

constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();

/// A pose with the covariance of its left perturbation about the origin of the frame it maps to.
struct UncertainPose {
  RigidTransform pose;
  Matrix6d covariance = Matrix6d::Zero();
};

/// What a perturbation in the inner frame does in the outer one.
Matrix6d adjoint(const RigidTransform& outer_from_inner) {
  Matrix6d a = Matrix6d::Zero();
  a.topLeftCorner<3, 3>() = outer_from_inner.rotation;
  a.bottomRightCorner<3, 3>() = outer_from_inner.rotation;
  a.bottomLeftCorner<3, 3>() = skew(outer_from_inner.translation) * outer_from_inner.rotation;
  return a;
}

UncertainPose operator*(const UncertainPose& a, const UncertainPose& b) {
  const Matrix6d carry = adjoint(a.pose);
  return {a.pose * b.pose, a.covariance + carry * b.covariance * carry.transpose()};
}

UncertainPose inverse(const UncertainPose& a) {
  const RigidTransform back = a.pose.inverse();
  const Matrix6d carry = adjoint(back);
  return {back, carry * a.covariance * carry.transpose()};
}

class Network {
 public:
  Network(std::size_t stations, const std::vector<PoseEdge>& edges, const PoseGraphOptions& options)
      : stations_(stations), edges_(edges), options_(options), at_(stations) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      poses_.push_back({edges[e].a_from_b, grown_covariance(edges[e], options)});
      at_[edges[e].a].push_back(e);
      at_[edges[e].b].push_back(e);
    }
    dropped_.assign(edges.size(), false);
  }

  LoopClosure run() {
    const std::vector<int> votes = triangles();
    while (true) {
      LoopClosure closure = grow(votes);
      const std::size_t worst = test(closure);
      if (worst == nobody) return closure;
      dropped_[worst] = true;
    }
  }

 private:
  std::size_t other(std::size_t edge, std::size_t station) const {
    return edges_[edge].a == station ? edges_[edge].b : edges_[edge].a;
  }
  /// From the other end of the edge to `station`.
  UncertainPose to(std::size_t station, std::size_t edge) const {
    return edges_[edge].a == station ? poses_[edge] : inverse(poses_[edge]);
  }
  bool closes(const UncertainPose& around) const {
    const Vector6d off = left_difference({}, around.pose, Eigen::Vector3d::Zero());
    return off.dot(around.covariance.ldlt().solve(off)) < options_.largest_closure;
  }

  /// For each edge, triangles that close minus triangles that do not.
  std::vector<int> triangles() const {
    std::vector<int> votes(edges_.size(), 0);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const std::size_t a = edges_[e].a, b = edges_[e].b;
      for (const std::size_t f : at_[b]) {
        const std::size_t c = other(f, b);
        if (f == e || c == a) continue;
        for (const std::size_t g : at_[c]) {
          if (other(g, c) != a || g == e || g == f) continue;
          votes[e] += closes(poses_[e] * to(b, f) * to(c, g)) ? 2 : -1;
        }
      }
    }
    return votes;
  }

  /// Prim's tree by most votes, then least depth, then least number.
  LoopClosure grow(const std::vector<int>& votes) {
    LoopClosure closure;
    closure.accepted.assign(edges_.size(), false);
    closure.in_tree.assign(edges_.size(), false);
    closure.reached.assign(stations_, false);
    closure.network_from_scan.assign(stations_, {});
    parent_.assign(stations_, nobody);
    depth_.assign(stations_, 0);
    std::set<std::tuple<int, std::size_t, std::size_t, std::size_t>> front;  // edge, from
    const auto reach = [&](std::size_t station) {
      closure.reached[station] = true;
      for (const std::size_t e : at_[station])
        if (!dropped_[e] && !closure.reached[other(e, station)])
          front.insert({-votes[e], depth_[station], e, station});
    };
    reach(0);
    while (!front.empty()) {
      const auto [vote, depth, e, from] = *front.begin();
      front.erase(front.begin());
      const std::size_t station = other(e, from);
      if (closure.reached[station]) continue;
      parent_[station] = e;
      depth_[station] = depth_[from] + 1;
      closure.in_tree[e] = closure.accepted[e] = true;
      closure.network_from_scan[station] = closure.network_from_scan[from] * to(from, e).pose;
      reach(station);
    }
    return closure;
  }

  /// The path from one station to another through the tree, and its edges.
  UncertainPose path(std::size_t from, std::size_t until, std::vector<std::size_t>& edges) const {
    UncertainPose up, down;  // meeting_from_`from`... grown from both ends
    std::size_t a = from, b = until;
    while (a != b) {
      std::size_t& lower = depth_[a] >= depth_[b] ? a : b;
      const std::size_t e = parent_[lower], above = other(e, lower);
      UncertainPose& side = &lower == &a ? up : down;
      side = to(above, e) * side;
      edges.push_back(e);
      lower = above;
    }
    return inverse(up) * down;  // from_`until`
  }

  /// Accepts what closes against the tree; returns the tree edge that loops contradict most and
  /// none supports, or nobody.
  std::size_t test(LoopClosure& closure) const {
    std::vector<int> support(edges_.size(), 0), against(edges_.size(), 0);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const PoseEdge& edge = edges_[e];
      if (dropped_[e] || closure.in_tree[e] || !closure.reached[edge.a]) continue;
      std::vector<std::size_t> along;
      const UncertainPose around = path(edge.a, edge.b, along) * inverse(poses_[e]);
      closure.accepted[e] = closes(around);
      for (const std::size_t t : along) ++(closure.accepted[e] ? support : against)[t];
    }
    std::size_t worst = nobody;
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (closure.in_tree[e] && support[e] == 0 && against[e] > 1 &&
          (worst == nobody || against[e] > against[worst]))
        worst = e;
    return worst;
  }

  std::size_t stations_;
  const std::vector<PoseEdge>& edges_;
  const PoseGraphOptions& options_;
  std::vector<std::vector<std::size_t>> at_;  // edges of each station
  std::vector<UncertainPose> poses_;
  std::vector<bool> dropped_;
  std::vector<std::size_t> parent_, depth_;
};

}  // namespace

Matrix6d grown_covariance(const PoseEdge& edge, const PoseGraphOptions& options) {
  Vector6d floor;
  floor << Eigen::Vector3d::Constant(options.rotation_floor_rad * options.rotation_floor_rad),
      Eigen::Vector3d::Constant(options.translation_floor_m * options.translation_floor_m);
  return edge.covariance + Matrix6d(floor.asDiagonal());
}

LoopClosure close_loops(std::size_t stations, const std::vector<PoseEdge>& edges,
                        const PoseGraphOptions& options) {
  return Network(stations, edges, options).run();
}

}  // namespace alea
