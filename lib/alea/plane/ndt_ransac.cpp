#include <algorithm>
#include <array>
#include <cmath>

#include "alea/core/seed.hpp"
#include "alea/plane/canonical_points.hpp"
#include "alea/plane/cell_tree.hpp"
#include "alea/plane/detectors.hpp"
#include "alea/plane/region_refit.hpp"

namespace alea {
namespace {

// More samples than this are never drawn for one plane.
constexpr std::uint64_t most_samples = 1000;

struct Consensus {
  MomentPlane plane;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::vector<std::uint32_t> cells;  ///< positions in the list of free cells
  double points = 0;
};

class NdtRansac {
 public:
  NdtRansac(const CellGrid& grid, const PlaneDetectionOptions& options)
      : grid_(grid),
        options_(options),
        least_cosine_(std::cos(options.normal_angle_rad)),
        random_(StreamKey{.seed = options.seed, .purpose = Purpose::plane_detector}) {}

  // The plane of each cell, or -1.
  std::vector<std::int32_t> run(const CellTree& tree) {
    std::vector<std::int32_t> plane_of_cell(grid_.cells.size(), -1);
    for (const Leaf& leaf : tree.leaves)
      if (is_planar(leaf)) free_.push_back(&leaf);
    for (;;) {
      const Consensus best = search();
      if (best.points < static_cast<double>(options_.min_points)) return plane_of_cell;
      for (const std::vector<std::uint32_t>& part : connected(best.cells))
        take(part, plane_of_cell);
      remove(best.cells);
    }
  }

  std::size_t planes() const { return static_cast<std::size_t>(planes_); }

 private:
  static bool is_planar(const Leaf& leaf) {
    return leaf.kind == LeafKind::planar && leaf.plane.thickness <= 0.2 * leaf.plane.breadth;
  }

  bool agrees(const Leaf& leaf, const MomentPlane& plane, const Eigen::Vector3d& point) const {
    return std::abs(leaf.plane.normal.dot(plane.normal)) >= least_cosine_ &&
           std::abs(plane.normal.dot(leaf.moments.mean - point)) <= options_.tolerance_m;
  }

  Consensus consensus(const MomentPlane& plane, const Eigen::Vector3d& point) const {
    Consensus out;
    out.plane = plane;
    out.point = point;
    for (std::uint32_t i = 0; i < free_.size(); ++i) {
      if (!agrees(*free_[i], plane, point)) continue;
      out.cells.push_back(i);
      out.points += free_[i]->moments.count;
    }
    return out;
  }

  // Draws cells until a better plane is unlikely: (1 - share)^n below the miss probability.
  Consensus search() {
    Consensus best;
    double needed = static_cast<double>(most_samples);
    for (std::uint64_t n = 0; !free_.empty() && static_cast<double>(n) < needed; ++n) {
      const Leaf& sample = *free_[random_.below(free_.size())];
      Consensus next = consensus(sample.plane, sample.moments.mean);
      if (next.points <= best.points) continue;
      best = std::move(next);
      const double share =
          static_cast<double>(best.cells.size()) / static_cast<double>(free_.size());
      if (share >= 1) break;
      needed = std::min(needed, std::log(options_.miss_probability) / std::log1p(-share));
    }
    return refined(best);
  }

  // Twice: least squares over the cells that agree, and the cells that agree with that.
  Consensus refined(Consensus best) const {
    for (int round = 0; round < 2 && !best.cells.empty(); ++round) {
      PointMoments moments;
      for (const std::uint32_t i : best.cells) moments = merged(moments, free_[i]->moments);
      Consensus next = consensus(plane_of(moments), moments.mean);
      if (next.points < best.points) break;
      best = std::move(next);
    }
    return best;
  }

  // The sets of cells that touch one another.
  std::vector<std::vector<std::uint32_t>> connected(const std::vector<std::uint32_t>& cells) const {
    std::vector<std::uint32_t> place_in_set(grid_.cells.size(), CellTable::none);
    for (const std::uint32_t i : cells) place_in_set[free_[i]->cell] = i;
    std::vector<std::vector<std::uint32_t>> parts;
    for (const std::uint32_t start : cells) {
      if (place_in_set[free_[start]->cell] == CellTable::none) continue;
      std::vector<std::uint32_t> part{start};
      place_in_set[free_[start]->cell] = CellTable::none;
      for (std::size_t next = 0; next < part.size(); ++next) {
        for (int step = 0; step < 27; ++step) {
          const auto& place = free_[part[next]]->place;
          const std::uint32_t cell = grid_.cell_beside(place, step);
          if (cell == CellTable::none || place_in_set[cell] == CellTable::none) continue;
          part.push_back(place_in_set[cell]);
          place_in_set[cell] = CellTable::none;
        }
      }
      parts.push_back(std::move(part));
    }
    return parts;
  }

  // Numbers the part where it is large enough.
  void take(const std::vector<std::uint32_t>& part, std::vector<std::int32_t>& plane_of_cell) {
    double points = 0;
    for (const std::uint32_t i : part) points += free_[i]->moments.count;
    if (points < static_cast<double>(options_.min_points)) return;
    for (const std::uint32_t i : part) plane_of_cell[free_[i]->cell] = planes_;
    ++planes_;
  }

  // Takes these (ascending) out of the free cells: they are spent, numbered or not.
  void remove(const std::vector<std::uint32_t>& cells) {
    for (const std::uint32_t i : cells) free_[i] = nullptr;
    std::erase(free_, nullptr);
  }

  const CellGrid& grid_;
  PlaneDetectionOptions options_;
  double least_cosine_;
  RandomStream random_;
  std::vector<const Leaf*> free_;
  std::int32_t planes_ = 0;
};

}  // namespace

std::vector<PlaneRegion> detect_by_ndt_ransac(const Cloud& cloud,
                                              const PlaneDetectionOptions& options) {
  CellGrid grid = make_cell_grid(cloud.positions, connection_length_m(cloud, options, 8), 0);
  const CellTree tree = make_cell_tree(grid, {options.tolerance_m, 0});
  NdtRansac ransac(grid, options);
  const std::vector<std::int32_t> plane_of_cell = ransac.run(tree);
  std::vector<std::int32_t> plane_of_point(cloud.size(), -1);
  for (std::size_t c = 0; c < grid.cells.size(); ++c)
    for (std::uint32_t k = grid.cells[c].begin; k < grid.cells[c].end; ++k)
      plane_of_point[grid.points[k].index] = plane_of_cell[c];
  return refitted_regions(cloud, std::move(plane_of_point), ransac.planes(), options, grid.cell);
}

}  // namespace alea
