#include "alea/checkerboard/saddle_search.hpp"

#include <tbb/parallel_sort.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "alea/core/parallel.hpp"
#include "alea/core/plane.hpp"

namespace alea {
namespace {

constexpr int bits = 21;
constexpr std::uint64_t most_cells = (1ull << bits) - 1;

std::uint64_t packed(const Eigen::Array3i& cell) {
  const auto held = [](int v) {
    return static_cast<std::uint64_t>(std::clamp<std::int64_t>(v, 0, most_cells));
  };
  return held(cell.x()) << (2 * bits) | held(cell.y()) << bits | held(cell.z());
}

/// Share of the variation of intensities over the angle about a cube, on the plane through the
/// cubes near it, that a second harmonic explains, and its axis.
struct SecondHarmonic {
  double strength = 0;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
};

SecondHarmonic second_harmonic(const std::vector<const CubeIndex::Cube*>& near,
                               const CubeIndex::Cube& centre, double radius_m) {
  const double n = static_cast<double>(near.size());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double mean = 0;
  for (const auto* cube : near) {
    const Eigen::Vector3d off = cube->mean - centre.mean;
    sum += off;
    squares += off * off.transpose();
    mean += cube->intensity / n;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / n -
                                                              sum * sum.transpose() / (n * n));
  const auto basis = tangent_basis(solver.eigenvectors().col(0));
  double cosine = 0, sine = 0, variation = 0, used = 0;
  for (const auto* cube : near) {
    const Eigen::Vector2d at = basis.transpose() * (cube->mean - centre.mean);
    const double value = cube->intensity - mean, squared = at.squaredNorm();
    if (squared < 0.1 * radius_m * radius_m) continue;  // the angle says nothing there
    cosine += value * (at.x() * at.x() - at.y() * at.y()) / squared;
    sine += value * 2 * at.x() * at.y() / squared;
    variation += value * value;
    used += 1;
  }
  if (used < 8 || !(variation > 0)) return {};
  const double angle = 0.5 * std::atan2(sine, cosine);
  return {2 * (cosine * cosine + sine * sine) / (used * variation),
          basis * Eigen::Vector2d(std::cos(angle), std::sin(angle))};
}

/// Sums over the cubes about a place, for a bound on what a second harmonic can explain.
struct QuadrupoleSums {
  double n = 0, value = 0, squares = 0;
  Eigen::Matrix3d shape = Eigen::Matrix3d::Zero();    ///< sum of o o' / |o|^2
  Eigen::Matrix3d weighed = Eigen::Matrix3d::Zero();  ///< the same times the intensity

  void add(const Eigen::Vector3d& off, double intensity) {
    const Eigen::Vector3d scaled = off / off.squaredNorm();
    const Eigen::Matrix3d outer = scaled * off.transpose();
    n += 1;
    value += intensity;
    squares += intensity * intensity;
    shape += outer;
    weighed += intensity * outer;
  }
  /// The share of the variation that the harmonic explains is 2 (c^2 + s^2) / (n variation), and
  /// c^2 + s^2 in any plane at most twice the squared norm of sum (i - mean) o o' / |o|^2.
  double most_strength() const {
    const double mean = value / n, variation = squares - n * mean * mean;
    if (!(variation > 0)) return 0;
    return 4 * (weighed - mean * shape).squaredNorm() / (n * variation);
  }
};

struct SaddleLimits {
  double radius_m, contrast, strength;
};

/// The saddle about one cube from the means of the cubes around it; strength 0 for none.
Saddle saddle_at(const std::vector<CubeIndex::Cube>& cubes,
                 const std::vector<std::uint32_t>& around, const CubeIndex::Cube& centre,
                 const SaddleLimits& limits) {
  const double radius2 = limits.radius_m * limits.radius_m;
  std::vector<const CubeIndex::Cube*> near;
  QuadrupoleSums outer;
  double low = centre.intensity, high = low;
  for (const std::uint32_t k : around) {
    const CubeIndex::Cube& cube = cubes[k];
    const Eigen::Vector3d off = cube.mean - centre.mean;
    const double squared = off.squaredNorm();
    if (squared > radius2) continue;
    near.push_back(&cube);
    low = std::min(low, cube.intensity);
    high = std::max(high, cube.intensity);
    if (squared >= 0.1 * radius2) outer.add(off, cube.intensity - centre.intensity);
  }
  Saddle saddle{centre.mean, 0, high - low, Eigen::Vector3d::UnitX()};
  // Off the surface the offsets of the bound differ a little from those of the harmonic.
  if (near.size() < 12 || outer.n < 8 || saddle.contrast < limits.contrast ||
      outer.most_strength() < 0.6 * limits.strength)
    return saddle;
  const SecondHarmonic harmonic = second_harmonic(near, centre, limits.radius_m);
  saddle.axis = harmonic.axis;
  if (harmonic.strength >= limits.strength) saddle.strength = harmonic.strength;
  return saddle;
}

}  // namespace

CubeIndex::CubeIndex(const Cloud& cloud, double cube_m) : cube_m_(cube_m), order_(cloud.size()) {
  struct Placed {
    std::uint64_t key;
    std::uint32_t index;
  };
  low_ = cloud.empty() ? Eigen::Vector3d::Zero() : cloud.positions[0];
  for (const Eigen::Vector3d& p : cloud.positions) low_ = low_.cwiseMin(p);
  std::vector<Placed> placed(cloud.size());
  parallel_chunks(cloud.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      placed[i] = {packed(cell_of(cloud.positions[i])), static_cast<std::uint32_t>(i)};
  });
  const auto place = [&](std::uint32_t i) {
    const Eigen::Vector3d& p = cloud.positions[i];
    return std::tuple(p.x(), p.y(), p.z(), cloud.intensity[i]);
  };
  tbb::parallel_sort(placed.begin(), placed.end(), [&](const Placed& a, const Placed& b) {
    return a.key != b.key ? a.key < b.key : place(a.index) < place(b.index);
  });
  for (std::uint32_t k = 0; k < order_.size(); ++k) {
    const std::uint32_t i = order_[k] = placed[k].index;
    if (keys_.empty() || keys_.back() != placed[k].key) {
      keys_.push_back(placed[k].key);
      cubes_.push_back({k, k});
    }
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

Eigen::Array3i CubeIndex::cell_of(const Eigen::Vector3d& place) const {
  return ((place - low_) / cube_m_).array().floor().max(-1).min(most_cells).cast<int>();
}

std::vector<std::uint32_t> CubeIndex::around(const Eigen::Vector3d& place, int reach) const {
  return CubeSurroundings(*this, reach).around(place);
}

std::vector<std::uint32_t> CubeIndex::points_of(const std::vector<std::uint32_t>& cubes) const {
  std::vector<std::uint32_t> points;
  for (const std::uint32_t k : cubes)
    points.insert(points.end(), order_.begin() + cubes_[k].first, order_.begin() + cubes_[k].last);
  return points;
}

CubeSurroundings::CubeSurroundings(const CubeIndex& index, int reach)
    : index_(index), reach_(reach), starts_((2 * reach + 1) * (2 * reach + 1)) {}

std::uint32_t CubeSurroundings::first_from(std::uint32_t from, std::uint64_t key) const {
  const auto& keys = index_.keys_;
  const auto count = static_cast<std::uint32_t>(keys.size());
  std::uint32_t low = from, high = from, step = 1;
  if (from < count && keys[from] < key) {
    for (; high < count && keys[high] < key; step *= 2) {
      low = high + 1;
      high = std::min(count, high + step);
    }
  } else {
    for (; low > 0 && keys[low - 1] >= key; step *= 2) {
      high = low - 1;
      low = low > step ? low - step : 0;
    }
  }
  return static_cast<std::uint32_t>(std::lower_bound(keys.begin() + low, keys.begin() + high, key) -
                                    keys.begin());
}

const std::vector<std::uint32_t>& CubeSurroundings::around(const Eigen::Vector3d& place) {
  const Eigen::Array3i at = index_.cell_of(place);
  found_.clear();
  std::size_t column = 0;
  for (int i = at.x() - reach_; i <= at.x() + reach_; ++i) {
    for (int j = at.y() - reach_; j <= at.y() + reach_; ++j, ++column) {
      if (i < 0 || j < 0) continue;
      // Along z the keys are consecutive: one search for a whole column.
      const std::uint64_t last = packed({i, j, at.z() + reach_});
      std::uint32_t cube = first_from(starts_[column], packed({i, j, at.z() - reach_}));
      starts_[column] = cube;
      for (; cube < index_.keys_.size() && index_.keys_[cube] <= last; ++cube)
        found_.push_back(cube);
    }
  }
  return found_;
}

std::vector<Saddle> find_saddles(const CubeIndex& index, double cube_m, double radius_m,
                                 double least_contrast, double least_strength) {
  const auto& cubes = index.cubes();
  const SaddleLimits limits{radius_m, least_contrast, least_strength};
  std::vector<Saddle> all(cubes.size());
  parallel_chunks(cubes.size(), 4096, [&](std::size_t begin, std::size_t end) {
    CubeSurroundings neighbours(index, 1);
    CubeSurroundings surroundings(index, static_cast<int>(std::ceil(radius_m / cube_m)));
    for (std::size_t k = begin; k < end; ++k) {
      double low = cubes[k].intensity, high = low;
      for (const std::uint32_t other : neighbours.around(cubes[k].mean)) {
        low = std::min(low, cubes[other].intensity);
        high = std::max(high, cubes[other].intensity);
      }
      if (high - low < 0.5 * least_contrast) continue;
      all[k] = saddle_at(cubes, surroundings.around(cubes[k].mean), cubes[k], limits);
    }
  });
  std::erase_if(all, [](const Saddle& saddle) { return saddle.strength == 0; });
  std::stable_sort(all.begin(), all.end(), [](const Saddle& a, const Saddle& b) {
    return a.strength * a.contrast > b.strength * b.contrast;
  });
  return all;
}

}  // namespace alea
