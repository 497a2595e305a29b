#include "alea/sphere/sphere_finder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "alea/core/error.hpp"
#include "alea/core/plane.hpp"
#include "alea/sphere/sphere_votes.hpp"
#include "alea/sphere/surface_cells.hpp"

namespace alea {
namespace {

constexpr double cells_per_radius = 3;
/// A half sphere gives about 50, a plane 9, an edge of a room 18 (which the checks then dismiss).
constexpr int min_votes = 14;
constexpr double checked_sine = 0.9;  // of the incidence: the limb is left out of the checks
constexpr int rings = 3, sectors = 8;

/// What the rays towards a fitted sphere met.
struct Evidence {
  double coverage = 0, purity = 0;
  std::vector<std::uint32_t> on_sphere;
};

Evidence evidence_of(const SphereFit& fit, const std::vector<std::uint32_t>& near,
                     const std::vector<Eigen::Vector3d>& points, const SphereFitOptions& options) {
  Evidence evidence;
  const Eigen::Vector3d centre = fit.centre_m - options.scanner_position;
  const double distance = centre.norm();
  const auto across = tangent_basis(centre / distance);
  const double sd = options.noise.normal_sd_m(distance, 1) * std::sqrt(fit.variance_factor);
  std::array<bool, rings * sectors> filled{};
  double before = 0, on = 0;
  for (const std::uint32_t index : near) {
    const Eigen::Vector3d p = points[index] - options.scanner_position;
    const Eigen::Vector3d ray = p.normalized();
    const bool on_surface = std::abs((p - centre).norm() - fit.radius_m) <= options.gate_sd * sd;
    if (on_surface && ray.dot(p - centre) < 0) evidence.on_sphere.push_back(index);
    const double sine = ray.cross(centre).norm() / fit.radius_m;
    if (sine >= checked_sine) continue;
    ++before;
    if (!on_surface) continue;
    ++on;
    const Eigen::Vector2d place = across.transpose() * ray;
    const double turn = std::atan2(place.y(), place.x()) / (2 * std::numbers::pi) + 0.5;
    const double area = sine * sine / (checked_sine * checked_sine);
    const int ring = std::min(rings - 1, static_cast<int>(area * rings));
    const int sector = std::min(sectors - 1, static_cast<int>(turn * sectors));
    filled[static_cast<std::size_t>(ring * sectors + sector)] = true;
  }
  evidence.coverage =
      static_cast<double>(std::count(filled.begin(), filled.end(), true)) / (rings * sectors);
  evidence.purity = before > 0 ? on / before : 0;
  std::sort(evidence.on_sphere.begin(), evidence.on_sphere.end());
  return evidence;
}

/// True where a fit of the other kind of radius agrees that this is the sphere looked for.
bool radius_agrees(const std::vector<Eigen::Vector3d>& near, const SphereFit& fit,
                   const SphereFinderOptions& options) {
  SphereFitOptions free = options.fit;
  free.radius_known = false;
  const auto free_fit = fit_sphere(near, fit.centre_m, free);
  if (!free_fit) return false;
  const double tolerance =
      std::max(5 * free_fit->radius_sd_m, options.radius_tolerance * free.radius_m);
  return std::abs(free_fit->radius_m - free.radius_m) <= tolerance;
}

std::optional<SphereTarget> target_at(const Eigen::Vector3d& start_m, const SurfaceCells& cells,
                                      const std::vector<Eigen::Vector3d>& points,
                                      const SphereFinderOptions& options) {
  const double radius = options.fit.radius_m;
  const std::vector<std::uint32_t> near = points_near(cells, points, start_m, 2 * radius);
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(near.size());
  for (const std::uint32_t index : near) positions.push_back(points[index]);
  SphereFitOptions known = options.fit;
  known.radius_known = true;
  const auto rough = fit_sphere(positions, start_m, known);
  if (!rough || (rough->centre_m - start_m).norm() > radius / 2) return std::nullopt;
  const double expected_m =
      known.noise.normal_sd_m((rough->centre_m - known.scanner_position).norm(), 1);
  if (rough->rmse_m > std::max(3 * expected_m, 0.03 * radius)) return std::nullopt;
  Evidence evidence = evidence_of(*rough, near, points, known);
  if (evidence.coverage < options.min_coverage || evidence.purity < options.min_purity ||
      !radius_agrees(positions, *rough, options))
    return std::nullopt;
  const auto fit = fit_sphere(positions, rough->centre_m, options.fit);
  if (!fit) return std::nullopt;
  return SphereTarget{*fit, std::move(evidence.on_sphere)};
}

}  // namespace

Result<std::vector<SphereTarget>> find_spheres(const Cloud& cloud,
                                               const SphereFinderOptions& options) {
  SphereFinderOptions settings = options;
  settings.fit.scanner_position =
      options.scanner_position.value_or(cloud.scanner_position.value_or(Eigen::Vector3d(0, 0, 0)));
  const double radius = settings.fit.radius_m;
  if (!(radius > 0)) throw usage_error("spheres: give a positive radius in metres");
  const SurfaceCells cells =
      surface_cells(cloud.positions, settings.fit.scanner_position, radius / cells_per_radius);
  std::vector<SphereTarget> targets;
  for (const CentreCandidate& candidate :
       vote_for_centres(cells, cloud.positions, settings.fit.scanner_position, radius, min_votes)) {
    const auto taken = [&](const SphereTarget& target) {
      return (target.fit.centre_m - candidate.centre_m).norm() < radius;
    };
    if (std::any_of(targets.begin(), targets.end(), taken)) continue;
    auto target = target_at(candidate.centre_m, cells, cloud.positions, settings);
    if (target) targets.push_back(std::move(*target));
  }
  if (targets.empty())
    return Refusal{RefusalCode::no_target, "no sphere with a radius of " + std::to_string(radius) +
                                               " m found; check the radius in metres"};
  std::stable_sort(targets.begin(), targets.end(),
                   [](const auto& a, const auto& b) { return a.fit.points > b.fit.points; });
  return targets;
}

}  // namespace alea
