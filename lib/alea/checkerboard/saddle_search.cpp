#include "alea/checkerboard/saddle_search.hpp"

#include <tbb/parallel_sort.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "alea/core/parallel.hpp"
#include "alea/core/plane.hpp"

namespace alea {
namespace {

constexpr int bits = 21;
constexpr std::uint64_t most_cells = (1ull << bits) - 1;

std::uint64_t packed(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto held = [](std::int64_t v) {
    return static_cast<std::uint64_t>(std::clamp<std::int64_t>(v, 0, most_cells));
  };
  return held(x) << (2 * bits) | held(y) << bits | held(z);
}

/// The saddle about one cube from the means of the cubes around it.
Saddle saddle_at(const CubeIndex& index, const CubeIndex::Cube& centre, double cube_m,
                 double radius_m) {
  const int reach = static_cast<int>(std::ceil(radius_m / cube_m));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  std::vector<const CubeIndex::Cube*> near;
  for (const std::uint32_t k : index.around(centre.mean, reach)) {
    const CubeIndex::Cube& cube = index.cubes()[k];
    const Eigen::Vector3d off = cube.mean - centre.mean;
    if (off.squaredNorm() > radius_m * radius_m) continue;
    near.push_back(&cube);
    sum += off;
    squares += off * off.transpose();
  }
  Saddle saddle;
  if (near.size() < 12) return saddle;
  const double n = static_cast<double>(near.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / n -
                                                              sum * sum.transpose() / (n * n));
  const auto basis = tangent_basis(solver.eigenvectors().col(0));
  double mean = 0;
  for (const auto* cube : near) mean += cube->intensity / n;
  double cosine = 0, sine = 0, variance = 0, used = 0;
  double low = near[0]->intensity, high = low;
  for (const auto* cube : near) {
    const Eigen::Vector2d at = basis.transpose() * (cube->mean - centre.mean);
    const double value = cube->intensity - mean, squared = at.squaredNorm();
    low = std::min(low, cube->intensity);
    high = std::max(high, cube->intensity);
    if (squared < 0.1 * radius_m * radius_m) continue;  // the angle says nothing there
    cosine += value * (at.x() * at.x() - at.y() * at.y()) / squared;
    sine += value * 2 * at.x() * at.y() / squared;
    variance += value * value;
    used += 1;
  }
  saddle.place_m = centre.mean;
  saddle.contrast = high - low;
  if (used >= 8 && variance > 0)
    saddle.strength = 2 * (cosine * cosine + sine * sine) / (used * variance);
  return saddle;
}

}  // namespace

CubeIndex::CubeIndex(const Cloud& cloud, double cube_m) : cube_m_(cube_m), order_(cloud.size()) {
  low_ = cloud.empty() ? Eigen::Vector3d::Zero() : cloud.positions[0];
  for (const Eigen::Vector3d& p : cloud.positions) low_ = low_.cwiseMin(p);
  std::vector<std::uint64_t> keys(cloud.size());
  parallel_chunks(cloud.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) keys[i] = key_of(cloud.positions[i]);
  });
  std::iota(order_.begin(), order_.end(), 0u);
  const auto place = [&](std::uint32_t i) {
    const Eigen::Vector3d& p = cloud.positions[i];
    return std::tuple(keys[i], p.x(), p.y(), p.z(), cloud.intensity[i]);
  };
  tbb::parallel_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return keys[a] != keys[b] ? keys[a] < keys[b] : place(a) < place(b);
  });
  for (std::uint32_t k = 0; k < order_.size(); ++k) {
    const std::uint32_t i = order_[k];
    if (cubes_.empty() || cubes_.back().key != keys[i]) cubes_.push_back({keys[i], k, k});
    Cube& cube = cubes_.back();
    cube.last = k + 1;
    cube.mean += cloud.positions[i] - low_;
    cube.intensity += cloud.intensity[i];
  }
  for (Cube& cube : cubes_) {
    const double n = cube.last - cube.first;
    cube.mean = low_ + cube.mean / n;
    cube.intensity /= n;
  }
}

std::uint64_t CubeIndex::key_of(const Eigen::Vector3d& place) const {
  const Eigen::Vector3d at = ((place - low_) / cube_m_).array().floor();
  return packed(static_cast<std::int64_t>(at.x()), static_cast<std::int64_t>(at.y()),
                static_cast<std::int64_t>(at.z()));
}

std::vector<std::uint32_t> CubeIndex::around(const Eigen::Vector3d& place, int reach) const {
  const Eigen::Vector3d at = ((place - low_) / cube_m_).array().floor();
  const auto x = static_cast<std::int64_t>(at.x()), y = static_cast<std::int64_t>(at.y());
  const auto z = static_cast<std::int64_t>(at.z());
  std::vector<std::uint32_t> found;
  for (std::int64_t i = x - reach; i <= x + reach; ++i) {
    for (std::int64_t j = y - reach; j <= y + reach; ++j) {
      if (i < 0 || j < 0) continue;
      // Along z the keys are consecutive: one search for a whole column.
      const std::uint64_t first = packed(i, j, z - reach), last = packed(i, j, z + reach);
      auto cube = std::lower_bound(cubes_.begin(), cubes_.end(), first,
                                   [](const Cube& c, std::uint64_t key) { return c.key < key; });
      for (; cube != cubes_.end() && cube->key <= last; ++cube)
        found.push_back(static_cast<std::uint32_t>(cube - cubes_.begin()));
    }
  }
  return found;
}

std::vector<std::uint32_t> CubeIndex::points_of(const std::vector<std::uint32_t>& cubes) const {
  std::vector<std::uint32_t> points;
  for (const std::uint32_t k : cubes)
    points.insert(points.end(), order_.begin() + cubes_[k].first, order_.begin() + cubes_[k].last);
  return points;
}

std::vector<Saddle> find_saddles(const CubeIndex& index, double cube_m, double radius_m,
                                 double least_contrast, double least_strength) {
  const auto& cubes = index.cubes();
  std::vector<Saddle> all(cubes.size());
  parallel_chunks(cubes.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      double low = cubes[k].intensity, high = low;
      for (const std::uint32_t other : index.around(cubes[k].mean, 1)) {
        low = std::min(low, cubes[other].intensity);
        high = std::max(high, cubes[other].intensity);
      }
      if (high - low < 0.5 * least_contrast) continue;
      const Saddle saddle = saddle_at(index, cubes[k], cube_m, radius_m);
      if (saddle.contrast >= least_contrast && saddle.strength >= least_strength) all[k] = saddle;
    }
  });
  std::erase_if(all, [](const Saddle& saddle) { return saddle.strength == 0; });
  std::stable_sort(all.begin(), all.end(), [](const Saddle& a, const Saddle& b) {
    return a.strength * a.contrast > b.strength * b.contrast;
  });
  return all;
}

}  // namespace alea
