#include "alea/simulate/die_ray.hpp"

#include <algorithm>
#include <cmath>

#include "alea/simulate/primitive_ray.hpp"

namespace alea {
namespace {

struct Entry {
  double range_m = never_m;
  int facet = -1;
};

/// Where the ray enters the six half spaces together (slab method, Kay and Kajiya 1986).
Entry enter_body(const std::array<Plane, 6>& planes, const Ray& ray) {
  Entry entry{-never_m, -1};
  double leave = never_m;
  for (int f = 0; f < 6; ++f) {
    const double approach = planes[f].normal.dot(ray.direction);
    const double height = planes[f].signed_distance(ray.origin);
    if (approach == 0) {
      if (height > 0) return {};
      continue;
    }
    const double range = -height / approach;
    if (approach > 0) {
      leave = std::min(leave, range);
    } else if (range > entry.range_m) {
      entry = {range, f};
    }
  }
  return entry.range_m < leave && entry.range_m > 0 ? entry : Entry{};
}

/// Whether a point of a facet lies on its flat part, off the rounding.
bool on_flat_part(const Die& die, int facet, const Eigen::Vector3d& point) {
  const Eigen::Vector3d below = point - die.model.edge_radius_m * die.body.planes[facet].normal;
  for (int f = 0; f < 6; ++f)
    if (f != facet && f != 5 - facet && die.core.planes[f].signed_distance(below) > 0) return false;
  return true;
}

/// The nearest entry into the twelve rounded edges and eight rounded corners.
void intersect_rounding(const Die& die, std::uint32_t index, const Ray& ray, Hit& hit) {
  for (int c = 0; c < 8; ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      const int other = c | 1 << axis;
      if (other == c) continue;
      const Eigen::Vector3d& a = die.core.corners_m[c];
      const Eigen::Vector3d& b = die.core.corners_m[other];
      const double range = enter_capsule(ray, a, b, die.model.edge_radius_m);
      if (!(range > 0 && range < hit.range_m)) continue;
      const Eigen::Vector3d point = ray.at(range);
      const double along = std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      hit = {range,
             (point - a - along * (b - a)).normalized(),
             die.model.intensity,
             {SurfaceKind::die, index, 0}};
    }
  }
}

/// The crossing of the bowed facet that tends to the plane's as the bow vanishes.
double bowed_range(const DieFacet& facet, const Ray& ray, double plane_range) {
  const Eigen::Vector3d from = ray.at(plane_range) - facet.centre_m;
  const double k = facet.bow_m / (2 * facet.half_m * facet.half_m);
  const double du = facet.u.dot(ray.direction), dv = facet.v.dot(ray.direction);
  const double u = facet.u.dot(from), v = facet.v.dot(from);
  // height + bow's parabola along the ray: a t^2 + b t + c = 0
  const double a = k * (du * du + dv * dv);
  const double b = facet.plane.normal.dot(ray.direction) + 2 * k * (u * du + v * dv);
  const double c = k * (u * u + v * v) - facet.bow_m;
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return plane_range;
  return plane_range + 2 * c / (-b + std::copysign(std::sqrt(discriminant), -b));
}

/// Where a ray that meets the facet in `at` inside a pip ends: on the pip's sunken floor, or on its
/// wall.
double recessed_range(const DieFacet& facet, const Ray& ray, double range_m,
                      const Eigen::Vector2d& from_centre, double recess_m) {
  const double to_floor = recess_m / -facet.plane.normal.dot(ray.direction);
  const Eigen::Vector2d slope(facet.u.dot(ray.direction), facet.v.dot(ray.direction));
  const double a = slope.squaredNorm();
  const double b = slope.dot(from_centre);
  const double c = from_centre.squaredNorm() - facet.pip_radius_m * facet.pip_radius_m;
  const double to_wall = a > 0 ? (-b + std::sqrt(std::max(0.0, b * b - a * c))) / a : never_m;
  return range_m + std::min(to_floor, to_wall);
}

Hit hit_on_facet(const Die& die, std::uint32_t index, int number, const Ray& ray, double range) {
  const DieFacet& facet = die.facets[number];
  if (facet.bow_m != 0) range = bowed_range(facet, ray, range);
  Hit hit{range,
          facet.plane.normal,
          die.model.intensity,
          {SurfaceKind::die, index, static_cast<std::uint8_t>(number + 1)}};
  const Eigen::Vector3d from = ray.at(range) - facet.centre_m;
  const Eigen::Vector2d at(facet.u.dot(from), facet.v.dot(from));
  if (facet.bow_m != 0) {
    const Eigen::Vector2d lean = at * (facet.bow_m / (facet.half_m * facet.half_m));
    hit.normal = (hit.normal + lean.x() * facet.u + lean.y() * facet.v).normalized();
  }
  for (const Eigen::Vector2d& centre : facet.pip_centres_m) {
    const Eigen::Vector2d from_centre = at - centre;
    if (from_centre.squaredNorm() > facet.pip_radius_m * facet.pip_radius_m) continue;
    hit.intensity = die.model.pips.intensity;
    if (die.model.pips.recess_m > 0)
      hit.range_m = recessed_range(facet, ray, range, from_centre, die.model.pips.recess_m);
    break;
  }
  return hit;
}

}  // namespace

bool passes(const Die& die, double margin_m, const Ray& ray) {
  double enter = 0, leave = never_m;
  for (const Plane& plane : die.body.planes) {
    const double approach = plane.normal.dot(ray.direction);
    const double height = plane.signed_distance(ray.origin) - margin_m;
    if (approach == 0) {
      if (height > 0) return false;
      continue;
    }
    const double range = -height / approach;
    if (approach > 0)
      leave = std::min(leave, range);
    else
      enter = std::max(enter, range);
  }
  return enter <= leave;
}

void intersect(const Die& die, std::uint32_t index, const Ray& ray, Hit& hit) {
  const Entry entry = enter_body(die.body.planes, ray);
  if (entry.facet < 0 || entry.range_m >= hit.range_m) return;
  if (die.model.edge_radius_m > 0 && !on_flat_part(die, entry.facet, ray.at(entry.range_m))) {
    intersect_rounding(die, index, ray, hit);
    return;
  }
  const Hit found = hit_on_facet(die, index, entry.facet, ray, entry.range_m);
  if (found.range_m < hit.range_m) hit = found;
}

}  // namespace alea
