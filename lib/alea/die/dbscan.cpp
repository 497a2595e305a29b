#include "alea/die/dbscan.hpp"

// Boost.Geometry still includes a header that Boost itself calls deprecated.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <boost/geometry/algorithms/disjoint.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>

#include "alea/core/error.hpp"

namespace alea {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 2, bg::cs::cartesian>;
using Entry = std::pair<Point, std::size_t>;
using Tree = bg::index::rtree<Entry, bg::index::rstar<16>>;

std::vector<std::size_t> neighbours(const Tree& tree, std::span<const Eigen::Vector2d> points,
                                    std::size_t of, double radius) {
  const Eigen::Vector2d& c = points[of];
  const bg::model::box<Point> box({c.x() - radius, c.y() - radius},
                                  {c.x() + radius, c.y() + radius});
  std::vector<std::size_t> found;
  for (auto it = tree.qbegin(bg::index::intersects(box)); it != tree.qend(); ++it)
    if ((points[it->second] - c).squaredNorm() <= radius * radius) found.push_back(it->second);
  return found;
}

}  // namespace

std::vector<int> dbscan(std::span<const Eigen::Vector2d> points, const DbscanOptions& options) {
  if (!(options.radius > 0)) throw usage_error("dbscan: the radius must be positive");
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < points.size(); ++i)
    entries.emplace_back(Point(points[i].x(), points[i].y()), i);
  const Tree tree(entries.begin(), entries.end());

  constexpr int unseen = -2, noise = -1;
  std::vector<int> labels(points.size(), unseen);
  int clusters = 0;
  for (std::size_t start = 0; start < points.size(); ++start) {
    if (labels[start] != unseen) continue;
    std::vector<std::size_t> reached = neighbours(tree, points, start, options.radius);
    labels[start] = noise;
    if (reached.size() < options.min_points) continue;
    labels[start] = clusters;
    while (!reached.empty()) {
      const std::size_t i = reached.back();
      reached.pop_back();
      const bool expand = labels[i] == unseen;
      if (labels[i] < 0) labels[i] = clusters;
      if (!expand) continue;
      const std::vector<std::size_t> more = neighbours(tree, points, i, options.radius);
      if (more.size() >= options.min_points)
        reached.insert(reached.end(), more.begin(), more.end());
    }
    ++clusters;
  }
  return labels;
}

}  // namespace alea
