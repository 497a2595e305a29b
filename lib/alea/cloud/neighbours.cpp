#include "alea/cloud/neighbours.hpp"

#include <algorithm>
#include <array>
#include <concepts>

namespace alea {
namespace {

constexpr std::size_t leaf_size = 18;

// Among the collected neighbours `index` is the place in the order, so that ties do not depend on
// the order of the cloud.
bool nearer(const Neighbour& a, const Neighbour& b) {
  return a.squared_distance_m2 != b.squared_distance_m2
             ? a.squared_distance_m2 < b.squared_distance_m2
             : a.index < b.index;
}

/// The k nearest so far, in order, in memory of the caller's.
struct NearestK {
  std::span<Neighbour> out;
  std::size_t count = 0;
  double limit() const {
    return count < out.size() ? std::numeric_limits<double>::infinity()
                              : out.back().squared_distance_m2;
  }
  void add(const Neighbour& found) {
    if (count == out.size() && !nearer(found, out.back())) return;
    std::size_t i = count < out.size() ? count++ : count - 1;
    for (; i > 0 && nearer(found, out[i - 1]); --i) out[i] = out[i - 1];
    out[i] = found;
  }
};

struct NearestOne {
  Neighbour best;
  double limit() const { return best.squared_distance_m2; }
  void add(const Neighbour& found) {
    if (nearer(found, best)) best = found;
  }
};

struct Within {
  double squared_distance_m2;
  std::vector<Neighbour> found;
  double limit() const { return squared_distance_m2; }
  void add(const Neighbour& neighbour) { found.push_back(neighbour); }
};

/// Descends to the leaf of the point, then to every node that may hold a nearer one, the last that
/// was passed by first (Arya and Mount 1993, Algorithms for fast vector quantization, DCC '93).
template <typename Collector>
class Search {
 public:
  Search(const KdOrder& order, const Eigen::Vector3d& point, Collector& collector)
      : order_(order), point_(point), collector_(collector) {}

  void run() {
    if (order_.points.empty()) return;
    Node node{{}, 0, 0, 0};
    do {
      while (node.level < order_.levels) to_nearer_half(node);
      scan(order_.first(node.level, node.place), order_.first(node.level, node.place + 1));
    } while (take_open(node));
  }

 private:
  /// `offsets_m`: from the point to the node's box along each axis; `squared_m2`: their sum of
  /// squares. Without initial values: a query does not clear what it will not use.
  struct Node {
    std::array<double, 3> offsets_m;
    double squared_m2;
    std::size_t place;  ///< in its level
    int level;
  };

  bool may_hold(const Node& node) const {
    return node.squared_m2 * (1 - 1e-14) <= collector_.limit();
  }

  /// To the half that the point is in or nearer to; the other one is left open.
  void to_nearer_half(Node& node) {
    const KdSplit& split = order_.splits[(std::size_t{1} << node.level) - 1 + node.place];
    const double value = point_[split.axis];
    const double above_low = value - split.low_m, below_high = split.high_m - value;
    const bool left_first = above_low < below_high;
    const double offset = left_first ? below_high : above_low;
    Node& other = open_[open_count_];
    other = node;
    other.level = ++node.level;
    other.place = 2 * node.place + (left_first ? 1 : 0);
    node.place = 2 * node.place + (left_first ? 0 : 1);
    // Inside the gap between the halves the far half may be nearer than the node's box.
    if (offset > 0) {
      double& old = other.offsets_m[static_cast<std::size_t>(split.axis)];
      other.squared_m2 += offset * offset - old * old;
      old = offset;
    }
    if (may_hold(other)) ++open_count_;
  }

  bool take_open(Node& node) {
    while (open_count_ > 0)
      if (may_hold(open_[--open_count_])) {
        node = open_[open_count_];
        return true;
      }
    return false;
  }

  /// Those within the limit are picked without a branch, which would be foretold wrongly half the
  /// time.
  void scan(std::size_t first, std::size_t last) {
    const double limit = collector_.limit();
    const Eigen::Vector3d point = point_;
    const KdPoint* const points = order_.points.data();
    std::array<Neighbour, leaf_size> within;
    std::size_t count = 0;
    for (std::size_t place = first; place < last; ++place) {
      const double squared = (points[place].position - point).squaredNorm();
      within[count] = {static_cast<std::uint32_t>(place), squared};
      count += squared <= limit ? 1 : 0;
    }
    for (std::size_t i = 0; i < count; ++i) collector_.add(within[i]);
  }

  /// The limit falls with most points that it lets in: few are.
  void scan(std::size_t first, std::size_t last) requires std::same_as<Collector, NearestOne> {
    for (std::size_t place = first; place < last; ++place) {
      const double squared = (order_.points[place].position - point_).squaredNorm();
      if (squared <= collector_.limit())
        collector_.add({static_cast<std::uint32_t>(place), squared});
    }
  }

  const KdOrder& order_;
  const Eigen::Vector3d& point_;
  Collector& collector_;
  std::array<Node, 33> open_;  ///< at most one for each level of 2^32 points
  std::size_t open_count_ = 0;
};

}  // namespace

NeighbourIndex::NeighbourIndex(std::span<const Eigen::Vector3d> points)
    : order_(kd_order(points, leaf_size)) {}

std::size_t NeighbourIndex::nearest_places(const Eigen::Vector3d& point,
                                           std::span<Neighbour> out) const {
  if (out.empty()) return 0;
  NearestK collector{out};
  Search(order_, point, collector).run();
  return collector.count;
}

std::size_t NeighbourIndex::nearest(const Eigen::Vector3d& point, std::span<Neighbour> out) const {
  const std::size_t count = nearest_places(point, out);
  for (Neighbour& neighbour : out.first(count))
    neighbour.index = order_.points[neighbour.index].index;
  return count;
}

std::vector<Neighbour> NeighbourIndex::nearest(const Eigen::Vector3d& point, std::size_t k) const {
  std::vector<Neighbour> found(std::min(k, order_.points.size()));
  found.resize(nearest(point, std::span<Neighbour>(found)));
  return found;
}

std::optional<Neighbour> NeighbourIndex::nearest_one(const Eigen::Vector3d& point,
                                                     double distance_m) const {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  NearestOne collector{{none, distance_m * distance_m}};
  Search(order_, point, collector).run();
  if (collector.best.index == none) return std::nullopt;
  return Neighbour{order_.points[collector.best.index].index, collector.best.squared_distance_m2};
}

std::vector<Neighbour> NeighbourIndex::within(const Eigen::Vector3d& point,
                                              double distance_m) const {
  Within collector{distance_m * distance_m, {}};
  Search(order_, point, collector).run();
  std::sort(collector.found.begin(), collector.found.end(), nearer);
  for (Neighbour& neighbour : collector.found)
    neighbour.index = order_.points[neighbour.index].index;
  return std::move(collector.found);
}

}  // namespace alea
