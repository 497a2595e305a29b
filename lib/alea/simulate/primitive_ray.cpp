#include "alea/simulate/primitive_ray.hpp"

#include <cmath>

namespace alea {
namespace {

bool nearer(double range_m, const Hit& hit) {
  return range_m > 0 && range_m < hit.range_m;
}

}  // namespace

double enter_ball(const Ray& ray, const Eigen::Vector3d& centre_m, double radius_m) {
  const Eigen::Vector3d to_centre = centre_m - ray.origin;
  const double along = to_centre.dot(ray.direction);
  // The distance of the centre from the ray, not from the origin: no cancellation at long range.
  const double off_squared = (to_centre - along * ray.direction).squaredNorm();
  const double half_squared = radius_m * radius_m - off_squared;
  return half_squared < 0 ? never_m : along - std::sqrt(half_squared);
}

double enter_capsule(const Ray& ray, const Eigen::Vector3d& a_m, const Eigen::Vector3d& b_m,
                     double radius_m) {
  const double length = (b_m - a_m).norm();
  const Eigen::Vector3d axis = (b_m - a_m) / length;
  const Eigen::Vector3d from = ray.origin - a_m;
  const double slope = ray.direction.dot(axis);
  const double height = from.dot(axis);
  const Eigen::Vector3d across = ray.direction - slope * axis;
  const Eigen::Vector3d off = from - height * axis;
  const double a = across.squaredNorm();
  if (a < 1e-24) return std::min(enter_ball(ray, a_m, radius_m), enter_ball(ray, b_m, radius_m));
  const double nearest = -off.dot(across) / a;
  const double half_squared = (radius_m * radius_m - (off + nearest * across).squaredNorm()) / a;
  if (half_squared < 0) return never_m;
  const double range = nearest - std::sqrt(half_squared);
  const double at = height + range * slope;
  if (at >= 0 && at <= length) return range;
  return enter_ball(ray, at < 0 ? a_m : b_m, radius_m);
}

void intersect(const Patch& patch, std::uint32_t index, const Ray& ray, Hit& hit) {
  const Eigen::Vector3d across = patch.side_u_m.cross(patch.side_v_m);
  const double approach = across.dot(ray.direction);
  if (approach == 0) return;
  const double range = across.dot(patch.corner_m - ray.origin) / approach;
  if (!nearer(range, hit)) return;
  const Eigen::Vector3d from = ray.at(range) - patch.corner_m;
  const double u = from.dot(patch.side_u_m), v = from.dot(patch.side_v_m);
  if (u < 0 || u > patch.side_u_m.squaredNorm() || v < 0 || v > patch.side_v_m.squaredNorm())
    return;
  hit = {range, across.normalized(), patch.intensity, {SurfaceKind::patch, index, 0}};
}

void intersect(const Box& box, std::uint32_t index, const Ray& ray, Hit& hit) {
  const Eigen::Matrix3d& turn = box.scene_from_box.rotation;
  const Eigen::Vector3d origin = turn.transpose() * (ray.origin - box.scene_from_box.translation);
  const Eigen::Vector3d direction = turn.transpose() * ray.direction;
  double enter = -never_m, leave = never_m;
  int axis = -1;
  for (int a = 0; a < 3; ++a) {
    const double half = box.size_m[a] / 2;
    if (direction[a] == 0) {
      if (std::abs(origin[a]) > half) return;
      continue;
    }
    const double near = (std::copysign(half, -direction[a]) - origin[a]) / direction[a];
    const double far = (std::copysign(half, direction[a]) - origin[a]) / direction[a];
    if (near > enter) {
      enter = near;
      axis = a;
    }
    leave = std::min(leave, far);
  }
  if (axis < 0 || enter >= leave || !nearer(enter, hit)) return;
  const double side = direction[axis] > 0 ? -1 : 1;
  hit = {enter,
         side * turn.col(axis),
         box.intensity,
         {SurfaceKind::box, index, static_cast<std::uint8_t>(2 * axis + (side > 0 ? 2 : 1))}};
}

namespace {

/// A ray in the frame of an axis: along it, and across it.
struct AxisRay {
  Eigen::Vector3d axis, across, off;  ///< unit axis; parts of direction and origin across it
  double length, slope, height;
};

/// The mantle of a frustum: |off + t across| = r0 + k (height + t slope), entered from outside.
void intersect_frustum(const Cylinder& cylinder, std::uint32_t index, const AxisRay& ray,
                       Hit& hit) {
  const double k = (*cylinder.top_radius_m - cylinder.radius_m) / ray.length;
  const double radius_here = cylinder.radius_m + k * ray.height;
  const double a = ray.across.squaredNorm() - k * k * ray.slope * ray.slope;
  const double b = ray.off.dot(ray.across) - k * ray.slope * radius_here;
  const double c = ray.off.squaredNorm() - radius_here * radius_here;
  const double discriminant = b * b - a * c;
  if (a == 0 || discriminant < 0) return;
  for (const double sign : {-1.0, 1.0}) {
    const double range = (-b + sign * std::sqrt(discriminant)) / a;
    const double at = ray.height + range * ray.slope;
    if (at < 0 || at > ray.length || !nearer(range, hit)) continue;
    const Eigen::Vector3d radial = (ray.off + range * ray.across).normalized();
    if (radial.dot(ray.across) - k * ray.slope >= 0) continue;  // leaves the body here
    hit = {range,
           (radial - k * ray.axis).normalized(),
           cylinder.intensity,
           {SurfaceKind::cylinder, index, 0}};
  }
}

}  // namespace

void intersect(const Cylinder& cylinder, std::uint32_t index, const Ray& ray, Hit& hit) {
  const double length = cylinder.axis_m.norm();
  const Eigen::Vector3d axis = cylinder.axis_m / length;
  const Eigen::Vector3d from = ray.origin - cylinder.base_m;
  const double slope = ray.direction.dot(axis), height = from.dot(axis);
  const Eigen::Vector3d across = ray.direction - slope * axis;
  const Eigen::Vector3d off = from - height * axis;
  const double radius_squared = cylinder.radius_m * cylinder.radius_m;
  const double a = across.squaredNorm();
  if (cylinder.top_radius_m) {
    intersect_frustum(cylinder, index, {axis, across, off, length, slope, height}, hit);
  } else if (a > 0) {
    const double nearest = -off.dot(across) / a;
    const double half_squared = (radius_squared - (off + nearest * across).squaredNorm()) / a;
    if (half_squared < 0) return;
    const double range = nearest - std::sqrt(half_squared);
    const double at = height + range * slope;
    if (at >= 0 && at <= length && nearer(range, hit))
      hit = {range,
             (off + range * across) / cylinder.radius_m,
             cylinder.intensity,
             {SurfaceKind::cylinder, index, 0}};
  }
  if (slope == 0) return;
  const bool enters_base = slope > 0;
  const double range = ((enters_base ? 0 : length) - height) / slope;
  const double end_radius =
      enters_base ? cylinder.radius_m : cylinder.top_radius_m.value_or(cylinder.radius_m);
  if (nearer(range, hit) && (off + range * across).squaredNorm() <= end_radius * end_radius)
    hit = {range,
           enters_base ? Eigen::Vector3d(-axis) : axis,
           cylinder.intensity,
           {SurfaceKind::cylinder, index, static_cast<std::uint8_t>(enters_base ? 1 : 2)}};
}

void intersect(const Sphere& sphere, std::uint32_t index, const Ray& ray, Hit& hit) {
  const double range = enter_ball(ray, sphere.centre_m, sphere.radius_m);
  if (!nearer(range, hit)) return;
  hit = {range,
         (ray.at(range) - sphere.centre_m) / sphere.radius_m,
         sphere.intensity,
         {SurfaceKind::sphere, index, 0}};
}

void intersect(const Checkerboard& board, std::uint32_t index, const Ray& ray, Hit& hit) {
  const Eigen::Matrix3d& turn = board.scene_from_board.rotation;
  const Eigen::Vector3d normal = turn.col(2);
  const double approach = normal.dot(ray.direction);
  if (approach == 0) return;
  const double range = normal.dot(board.scene_from_board.translation - ray.origin) / approach;
  if (!nearer(range, hit)) return;
  const Eigen::Vector3d from = ray.at(range) - board.scene_from_board.translation;
  const double x = turn.col(0).dot(from), y = turn.col(1).dot(from);
  const Eigen::Vector2d half = half_plate_m(board);
  if (std::abs(x) > half.x() || std::abs(y) > half.y()) return;
  const int column = static_cast<int>(std::floor(x / board.cell_m + 0.5 * board.columns));
  const int row = static_cast<int>(std::floor(y / board.cell_m + 0.5 * board.rows));
  double intensity = board.plate_intensity;
  if (column >= 0 && column < board.columns && row >= 0 && row < board.rows)
    intensity = (column + row) % 2 == 0 ? board.dark_intensity : board.light_intensity;
  hit = {range, normal, intensity, {SurfaceKind::checkerboard, index, 0}};
}

}  // namespace alea
