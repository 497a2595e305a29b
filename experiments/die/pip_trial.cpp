#include "experiments/die/pip_trial.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "alea/die/pip_layout.hpp"

namespace alea::die {
namespace {

/// The die fills [-edge/2, edge/2]^2 x [0, edge]; facets 0, 1, 2 look along +x, +y, +z.
struct Setting {
  Eigen::Vector3d scanner;
  Eigen::Vector3d corner;
  std::array<PipPattern, 3> patterns;
};

/// Facet k runs along axes (k+1)%3 and (k+2)%3, away from the corner.
Eigen::Vector2d along_edges(const Eigen::Vector3d& p, const Setting& setting, std::size_t facet) {
  const auto u = static_cast<Eigen::Index>((facet + 1) % 3);
  const auto v = static_cast<Eigen::Index>((facet + 2) % 3);
  return {setting.corner[u] - p[u], setting.corner[v] - p[v]};
}

PipPattern random_form(int pips, RandomStream& stream) {
  std::vector<PipPattern> forms;
  for (const PipPattern& pattern : pip_patterns)
    if (pattern.pips == pips) forms.push_back(pattern);
  return forms[stream.below(forms.size())];
}

/// Metres from the nearest pip's rim, positive inside.
double depth_in_pip(const Eigen::Vector2d& uv_m, const PipPattern& pattern,
                    const PipTrialOptions& options) {
  double nearest_square = 1e9;
  for (int place = 0; place < pip_places; ++place) {
    if (!pattern.has(place)) continue;
    const Eigen::Vector2d centre = pip_place(place, options.pip_offset) * options.edge_m;
    nearest_square = std::min(nearest_square, (uv_m - centre).squaredNorm());
  }
  return options.pip_radius * options.edge_m - std::sqrt(nearest_square);
}

/// Share of the laser spot that lies on pips: seven sub-rays, the spot drawn out by the incidence.
double pip_share(const Eigen::Vector3d& p, const Eigen::Vector3d& ray, std::size_t facet,
                 const Setting& setting, const PipTrialOptions& options) {
  const auto axis = static_cast<Eigen::Index>(facet);
  const auto depth = [&](const Eigen::Vector3d& q) {
    return depth_in_pip(along_edges(q, setting, facet), setting.patterns[facet], options);
  };
  constexpr double ring = 0.35;  // radius over diameter of the spot
  const double at_centre = depth(p);
  if (std::abs(at_centre) > ring * options.footprint_m / std::abs(ray[axis]))
    return at_centre > 0 ? 1 : 0;
  const Eigen::Vector3d side = ray.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d up = side.cross(ray);
  int hits = at_centre > 0 ? 1 : 0;
  for (int i = 0; i < 6; ++i) {
    const double angle = i * std::numbers::pi / 3;
    const Eigen::Vector3d offset =
        ring * options.footprint_m * (std::cos(angle) * side + std::sin(angle) * up);
    hits += depth(p + offset - ray * (offset[axis] / ray[axis])) > 0 ? 1 : 0;
  }
  return hits / 7.0;
}

/// The facet that the ray meets and where; the die is convex, so the farthest of the three facing
/// planes is the one it enters by.
std::optional<std::pair<std::size_t, Eigen::Vector3d>> hit(const Setting& setting,
                                                           const Eigen::Vector3d& ray,
                                                           const PipTrialOptions& options) {
  std::size_t facet = 0;
  double distance = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double t = (setting.corner[axis] - setting.scanner[axis]) / ray[axis];
    if (t > distance) {
      distance = t;
      facet = k;
    }
  }
  const Eigen::Vector3d p = setting.scanner + distance * ray;
  const Eigen::Vector2d uv = along_edges(p, setting, facet);
  const double from = options.trim_m, to = options.edge_m - options.trim_m;
  if (distance <= 0 || (uv.array() < from).any() || (uv.array() > to).any()) return std::nullopt;
  return std::pair{facet, p};
}

Eigen::Vector2d slope_of_view(const Setting& setting, std::size_t facet, double edge_m) {
  Eigen::Vector3d centre = setting.corner - Eigen::Vector3d::Constant(edge_m / 2);
  const auto axis = static_cast<Eigen::Index>(facet);
  centre[axis] = setting.corner[axis];
  const Eigen::Vector3d ray = (centre - setting.scanner).normalized();
  const Eigen::Vector3d in_facet = ray / std::abs(ray[axis]);
  const auto u = static_cast<Eigen::Index>((facet + 1) % 3);
  const auto v = static_cast<Eigen::Index>((facet + 2) % 3);
  return {-in_facet[u], -in_facet[v]};
}

}  // namespace

PipTrial make_pip_trial(const PipTrialOptions& options, const StreamKey& key) {
  RandomStream stream(key);
  PipTrial trial;
  trial.pips = orientations_of(options.chirality)[stream.below(24)];
  const double half = options.edge_m / 2, across = options.range_m / std::numbers::sqrt2;
  Setting setting{{across, across, options.scanner_height_m}, {half, half, options.edge_m}, {}};
  std::array<Eigen::Vector2d, 3> jitter;
  for (std::size_t k = 0; k < 3; ++k) {
    setting.patterns[k] = random_form(trial.pips[k], stream);
    jitter[k] = options.frame_jitter_m * Eigen::Vector2d(stream.normal(), stream.normal());
    trial.images[k].edge_u_m = trial.images[k].edge_v_m = options.edge_m;
    trial.images[k].view_slope = slope_of_view(setting, k, options.edge_m);
  }
  const double nearest = options.range_m - half * std::numbers::sqrt2;
  const double half_width = std::atan2(half * std::numbers::sqrt2, nearest);
  const double top = std::atan2(options.edge_m - options.scanner_height_m,
                                options.range_m + half * std::numbers::sqrt2);
  const double bottom = std::atan2(-options.scanner_height_m, nearest);
  const double middle = -0.75 * std::numbers::pi;
  const double noise = options.noise_over_contrast * 0.6;
  for (double elevation = bottom + stream.uniform() * options.step_rad; elevation < top;
       elevation += options.step_rad) {
    const double phase = stream.uniform() * options.step_rad;
    for (double azimuth = middle - half_width + phase; azimuth < middle + half_width;
         azimuth += options.step_rad) {
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const auto seen = hit(setting, ray, options);
      if (!seen) continue;
      const auto& [facet, p] = *seen;
      const double share = pip_share(p, ray, facet, setting, options);
      const double clean = options.background + share * (options.pip - options.background);
      const double cosine = std::abs(ray[static_cast<Eigen::Index>(facet)]);
      const double falloff =
          options.incidence_exponent > 0 ? std::pow(cosine, options.incidence_exponent) : 1;
      trial.images[facet].uv_m.push_back(along_edges(p, setting, facet) + jitter[facet]);
      trial.images[facet].intensity.push_back(
          static_cast<float>(clean * falloff + noise * stream.normal()));
    }
  }
  return trial;
}

}  // namespace alea::die
