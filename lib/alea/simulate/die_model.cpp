#include "alea/simulate/die_model.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "alea/core/error.hpp"

namespace alea {
namespace {

/// Outward normals of the nominal cuboid's facets in the die frame, that of alea::cube.
std::array<Eigen::Vector3d, 6> nominal_normals(Chirality chirality) {
  const DieShape nominal = cube(1, chirality);
  std::array<Eigen::Vector3d, 6> normals;
  for (int f = 0; f < 6; ++f) normals[f] = nominal.facets[f]->normal;
  return normals;
}

/// The other two axes of the die as seen on a facet: u towards the next lower-pip facet, v towards
/// the one after it (in the circle 1, 2, 3).
int u_facet(int facet) {
  return (die_axis(facet + 1) + 1) % 3;
}
int v_facet(int facet) {
  return (die_axis(facet + 1) + 2) % 3;
}

/// Centres of the pips in units of the row spacing.
std::vector<Eigen::Vector2d> pip_pattern(int pips, const PipStyle& style) {
  std::vector<Eigen::Vector2d> centres;
  if (pips % 2 == 1) centres.emplace_back(0, 0);
  if (pips == 2 || pips == 3) {
    const double side = (pips == 2 ? style.turned_2 : style.turned_3) ? -1 : 1;
    centres.emplace_back(-1, -side);
    centres.emplace_back(1, side);
  }
  if (pips >= 4)
    for (const double u : {-1.0, 1.0})
      for (const double v : {-1.0, 1.0}) centres.emplace_back(u, v);
  if (pips == 6)
    for (const double side : {-1.0, 1.0})
      centres.push_back(style.turned_6 ? Eigen::Vector2d(0, side) : Eigen::Vector2d(side, 0));
  return centres;
}

DieFacet build_facet(const DieModel& model, int facet, const Plane& plane) {
  const std::array<Eigen::Vector3d, 6> normals = nominal_normals(model.chirality);
  const Eigen::Matrix3d& turn = model.scene_from_die.rotation;
  const Eigen::Vector3d centre =
      model.scene_from_die * (normals[facet] * model.size_m[die_axis(facet + 1)] / 2);
  DieFacet out;
  out.plane = plane;
  out.centre_m = centre - plane.normal * plane.signed_distance(centre);
  const Eigen::Vector3d u = turn * normals[u_facet(facet)];
  out.u = (u - plane.normal * plane.normal.dot(u)).normalized();
  out.v = plane.normal.cross(out.u);
  if (out.v.dot(turn * normals[v_facet(facet)]) < 0) out.v = -out.v;
  const double edge = std::min(model.size_m[u_facet(facet)], model.size_m[v_facet(facet)]);
  out.half_m = edge / 2;
  out.bow_m = model.facets[facet].bow_m;
  if (model.pips.painted)
    for (const Eigen::Vector2d& at : pip_pattern(facet + 1, model.pips))
      out.pip_centres_m.push_back(at * model.pips.spacing_share * edge);
  out.pip_radius_m = model.pips.radius_share * edge;
  return out;
}

void check_neighbours(int pips_a, int pips_b) {
  if (pips_a < 1 || pips_a > 6 || pips_b < 1 || pips_b > 6 || pips_a == pips_b ||
      pips_a + pips_b == 7)
    throw usage_error(
        fmt::format("facets {} and {}: name two of 1 to 6 that meet in an edge", pips_a, pips_b));
}

void check_sizes(const DieModel& model) {
  if (!(model.size_m.minCoeff() > 0) || !model.size_m.allFinite())
    throw usage_error(fmt::format("die: sizes {} x {} x {} m; give three positive lengths",
                                  model.size_m[0], model.size_m[1], model.size_m[2]));
  if (!(model.edge_radius_m >= 0) || 2 * model.edge_radius_m >= model.size_m.minCoeff())
    throw usage_error(fmt::format("die: edge radius {} m; give 0 to less than half the edge",
                                  model.edge_radius_m));
}

Hexahedron closed_body(std::array<Plane, 6> planes, double inset_m, Chirality chirality) {
  for (Plane& plane : planes) plane.offset_m -= inset_m;
  const auto body = assemble_hexahedron(planes);
  if (!body || (body->orientation < 0) != (chirality == Chirality::clockwise))
    throw usage_error(
        "die: its six planes do not close to a convex hexahedron; use smaller tilts, offsets or "
        "edge radius");
  return *body;
}

}  // namespace

std::array<Plane, 6> die_planes(const DieModel& model) {
  const std::array<Eigen::Vector3d, 6> normals = nominal_normals(model.chirality);
  std::array<Plane, 6> planes;
  for (int f = 0; f < 6; ++f) {
    const FacetShape& shape = model.facets[f];
    const double half = model.size_m[die_axis(f + 1)] / 2 + shape.offset_m;
    planes[f].normal = (normals[f] + std::tan(shape.tilt_u_rad) * normals[u_facet(f)] +
                        std::tan(shape.tilt_v_rad) * normals[v_facet(f)])
                           .normalized();
    planes[f].offset_m = planes[f].normal.dot(normals[f]) * half;
  }
  return planes;
}

RigidTransform standing_pose(Chirality chirality, int pips_up, int pips_front,
                             double front_azimuth_rad, const Eigen::Vector3d& centre_m) {
  check_neighbours(pips_up, pips_front);
  const std::array<Eigen::Vector3d, 6> normals = nominal_normals(chirality);
  const Eigen::Vector3d up = normals[pips_up - 1], front = normals[pips_front - 1];
  Eigen::Matrix3d upright_from_die;  // front to x, up to z
  upright_from_die << front.transpose(), up.cross(front).transpose(), up.transpose();
  const Eigen::AngleAxisd turn(front_azimuth_rad, Eigen::Vector3d::UnitZ());
  return {turn * upright_from_die, centre_m};
}

Die build_die(const DieModel& model) {
  check_sizes(model);
  std::array<Plane, 6> planes = die_planes(model);
  for (Plane& plane : planes) {
    plane.normal = (model.scene_from_die.rotation * plane.normal).normalized();
    plane.offset_m += plane.normal.dot(model.scene_from_die.translation);
  }
  Die die;
  die.model = model;
  die.body = closed_body(planes, 0, model.chirality);
  die.core = model.edge_radius_m > 0 ? closed_body(planes, model.edge_radius_m, model.chirality)
                                     : die.body;
  for (int f = 0; f < 6; ++f) die.facets[f] = build_facet(model, f, planes[f]);
  return die;
}

double edge_length_m(const Hexahedron& body, int pips_a, int pips_b) {
  check_neighbours(pips_a, pips_b);
  std::vector<Eigen::Vector3d> ends;
  for (int c = 0; c < 8; ++c) {
    const auto facets = facets_of_corner(c);
    if (std::count(facets.begin(), facets.end(), pips_a - 1) == 1 &&
        std::count(facets.begin(), facets.end(), pips_b - 1) == 1)
      ends.push_back(body.corners_m[c]);
  }
  return (ends[0] - ends[1]).norm();
}

DieModel with_random_shape(const DieModel& model, const DieSpread& spread, std::uint64_t seed,
                           std::uint32_t experiment, std::uint64_t trial) {
  RandomStream stream({seed, experiment, trial, 0, Purpose::die_shape});
  DieModel out = model;
  for (FacetShape& facet : out.facets) {
    facet.tilt_u_rad += spread.tilt_sd_rad * stream.normal();
    facet.tilt_v_rad += spread.tilt_sd_rad * stream.normal();
    facet.offset_m += spread.offset_sd_m * stream.normal();
  }
  for (double& size : out.size_m) size *= 1 + spread.size_sd_share * stream.normal();
  return out;
}

}  // namespace alea
