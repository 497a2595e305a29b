#include "alea/evaluate/noise_tiles.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "alea/core/error.hpp"
#include "alea/core/median.hpp"
#include "alea/core/parallel.hpp"

namespace alea {
namespace {

constexpr double mad_to_sd = 1.4826;
constexpr double least_slenderness = 0.05;  // of a tile: smaller over larger in-plane variance

struct TilePlane {
  Eigen::Vector3d centroid, normal;
  bool flat = false;  ///< spread in two directions
};

TilePlane plane_through(const std::vector<Eigen::Vector3d>& points) {
  TilePlane plane;
  plane.centroid.setZero();
  for (const Eigen::Vector3d& p : points) plane.centroid += p;
  plane.centroid /= static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points)
    scatter += (p - plane.centroid) * (p - plane.centroid).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spectrum(scatter);
  plane.normal = spectrum.eigenvectors().col(0);
  plane.flat = spectrum.eigenvalues()[1] > least_slenderness * spectrum.eigenvalues()[2] &&
               spectrum.eigenvalues()[0] < 0.25 * spectrum.eigenvalues()[1];
  return plane;
}

/// Points within so many robust standard deviations of the plane.
std::vector<Eigen::Vector3d> without_outliers(const std::vector<Eigen::Vector3d>& points,
                                              const TilePlane& plane, double sigmas) {
  std::vector<double> distances;
  for (const Eigen::Vector3d& p : points)
    distances.push_back(std::abs(plane.normal.dot(p - plane.centroid)));
  const double gate = sigmas * mad_to_sd * median(distances);
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (distances[i] <= gate) kept.push_back(points[i]);
  return kept;
}

/// Variance of a standard normal number that is known to lie within +-k.
double variance_within(double k) {
  const double density = std::exp(-k * k / 2) / std::sqrt(2 * std::numbers::pi);
  return 1 - 2 * k * density / std::erf(k / std::numbers::sqrt2);
}

std::optional<NoiseTile> tile_of(const std::vector<Eigen::Vector3d>& all,
                                 const Eigen::Vector3d& scanner, const NoiseTileOptions& options) {
  const std::size_t least = std::max<std::size_t>(options.min_points / 2, 8);
  if (all.size() < least) return std::nullopt;
  const auto points = without_outliers(all, plane_through(all), options.outlier_sigmas);
  if (points.size() < least) return std::nullopt;
  const TilePlane plane = plane_through(points);
  if (!plane.flat) return std::nullopt;
  NoiseTile tile;
  tile.cos2 = 0;
  tile.points = points.size();
  const auto n = static_cast<double>(points.size());
  double square = 0;
  for (const Eigen::Vector3d& p : points) {
    square += std::pow(plane.normal.dot(p - plane.centroid), 2);
    const double range2 = (p - scanner).squaredNorm();
    const double cos2 = std::min(1.0, std::pow(plane.normal.dot(p - scanner), 2) / range2);
    tile.cos2 += cos2 / n;
    tile.sin2 += (1 - cos2) / n;
    tile.range2_cos2_m2 += range2 * cos2 / n;
    tile.range2_sin2_m2 += range2 * (1 - cos2) / n;
  }
  if (tile.cos2 < options.least_cosine * options.least_cosine) return std::nullopt;
  tile.variance_m2 = square / (n - 3) / variance_within(options.outlier_sigmas);
  return tile;
}

/// A plane's points in its own two coordinates.
struct Sheet {
  const std::vector<Eigen::Vector3d>& points;
  std::vector<Eigen::Vector2d> uv;
  Eigen::Vector3d scanner;
  NoiseTileOptions options;
};

void cut(const Sheet& sheet, const std::vector<std::uint32_t>& members,
         const Eigen::Vector2d& corner, double side_m, std::vector<NoiseTile>& tiles) {
  const NoiseTileOptions& options = sheet.options;
  if (members.size() >= 4 * options.min_points && side_m / 2 >= options.smallest_m) {
    const double half = side_m / 2;
    std::array<std::vector<std::uint32_t>, 4> parts;
    for (const std::uint32_t i : members) {
      const Eigen::Vector2d from = sheet.uv[i] - corner;
      parts[(from.x() >= half ? 1 : 0) + (from.y() >= half ? 2 : 0)].push_back(i);
    }
    for (int k = 0; k < 4; ++k)
      cut(sheet, parts[k], corner + half * Eigen::Vector2d(k % 2, k / 2), half, tiles);
    return;
  }
  std::vector<Eigen::Vector3d> points;
  for (const std::uint32_t i : members) points.push_back(sheet.points[i]);
  if (const auto tile = tile_of(points, sheet.scanner, options)) tiles.push_back(*tile);
}

std::vector<NoiseTile> tiles_of_region(const Cloud& cloud, const PlaneRegion& region,
                                       const NoiseTileOptions& options) {
  std::vector<Eigen::Vector3d> points;
  for (const std::uint32_t i : region.indices) points.push_back(cloud.positions[i]);
  Sheet sheet{points, {}, *cloud.scanner_position, options};
  const auto basis = tangent_basis(region.plane.normal);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300);
  Eigen::Vector2d high = -low;
  for (const Eigen::Vector3d& p : points) {
    sheet.uv.push_back(basis.transpose() * (p - region.centroid_m));
    low = low.cwiseMin(sheet.uv.back());
    high = high.cwiseMax(sheet.uv.back());
  }
  const double side = options.largest_m;
  const auto columns = static_cast<std::size_t>((high - low).x() / side) + 1;
  const auto rows = static_cast<std::size_t>((high - low).y() / side) + 1;
  std::vector<std::vector<std::uint32_t>> squares(columns * rows);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d at = (sheet.uv[i] - low) / side;
    squares[static_cast<std::size_t>(at.y()) * columns + static_cast<std::size_t>(at.x())]
        .push_back(i);
  }
  std::vector<NoiseTile> tiles;
  for (std::size_t k = 0; k < squares.size(); ++k)
    cut(sheet, squares[k],
        low + side * Eigen::Vector2d(static_cast<double>(k % columns),
                                     static_cast<double>(k / columns)),
        side, tiles);
  return tiles;
}

}  // namespace

std::vector<NoiseTile> noise_tiles(const Cloud& cloud, const std::vector<PlaneRegion>& regions,
                                   const NoiseTileOptions& options) {
  if (!cloud.scanner_position)
    throw usage_error("noise: ranges and incidence angles need the scanner's position");
  std::vector<std::vector<NoiseTile>> of_region(regions.size());
  parallel_chunks(regions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r)
      of_region[r] = tiles_of_region(cloud, regions[r], options);
  });
  std::vector<NoiseTile> tiles;
  for (const auto& part : of_region) tiles.insert(tiles.end(), part.begin(), part.end());
  return tiles;
}

}  // namespace alea
