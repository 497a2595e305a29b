#include "alea/evaluate/fisher_scene.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "alea/core/error.hpp"

namespace alea {
namespace {

using Polygon = std::vector<Eigen::Vector3d>;

/// The part of a polygon on the inner side of a plane (Sutherland and Hodgman 1974).
Polygon clipped(const Polygon& polygon, const Plane& plane) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& a = polygon[i];
    const Eigen::Vector3d& b = polygon[(i + 1) % polygon.size()];
    const double da = plane.signed_distance(a), db = plane.signed_distance(b);
    if (da <= 0) kept.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

FisherBody body_of_planes(const std::vector<Plane>& planes, double sd) {
  FisherBody body;
  body.tilt_sd_rad = body.offset_sd_m = sd;
  for (std::size_t i = 0; i < planes.size(); ++i) body.facets.push_back(facet_of_planes(planes, i));
  return body;
}

}  // namespace

FisherFacet facet_of_planes(const std::vector<Plane>& planes, std::size_t index) {
  constexpr double reach_m = 1e3;  // larger than any target
  const Plane& plane = planes.at(index);
  const auto basis = tangent_basis(plane.normal);
  const Eigen::Vector3d foot = plane.normal * plane.offset_m;
  Polygon polygon;
  for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    polygon.push_back(foot + reach_m * (s * basis.col(0) + t * basis.col(1)));
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (i != index) polygon = clipped(polygon, planes[i]);
  if (polygon.size() < 3)
    throw usage_error("Fisher bound: plane " + std::to_string(index) +
                      " is no facet of the body; give outward planes that close it");
  return {plane, polygon};
}

FisherBody free_body(const std::vector<Plane>& outward_planes) {
  return body_of_planes(outward_planes, unknown_sd);
}

FisherBody known_body(const std::vector<Plane>& outward_planes) {
  return body_of_planes(outward_planes, 0);
}

FisherBody calibration_plane(const FisherFacet& patch) {
  FisherBody body;
  body.facets.push_back(patch);
  return body;
}

std::vector<Plane> cube_on_floor(double edge_m) {
  const Eigen::Vector3d centre(0, 0, edge_m / 2);
  std::vector<Plane> planes;
  for (const Eigen::Vector3d& n :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1),
        Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(-1, 0, 0)})
    planes.push_back({n, n.dot(centre) + edge_m / 2});
  return planes;
}

bool faces(const FisherFacet& facet, const FisherStation& station) {
  return facet.plane.signed_distance(station.scene_from_scan.translation) > 0;
}

FisherEdge shared_edge(const FisherBody& body, const FisherStation& master,
                       const FisherStation& slave) {
  std::vector<int> both, master_only, slave_only;
  for (int f = 0; f < static_cast<int>(body.facets.size()); ++f) {
    const bool in_master = faces(body.facets[f], master), in_slave = faces(body.facets[f], slave);
    if (in_master && in_slave) both.push_back(f);
    if (in_master && !in_slave) master_only.push_back(f);
    if (!in_master && in_slave) slave_only.push_back(f);
  }
  if (both.size() != 2 || master_only.size() != 1 || slave_only.size() != 1)
    throw usage_error("Fisher bound: the stations share " + std::to_string(both.size()) +
                      " facets; a shared edge needs two, and one more for each station");
  return {both[0], both[1], master_only[0], slave_only[0], 0.0};
}

FisherStation station_at(double distance_m, double azimuth_rad, double height_m, double step_rad) {
  FisherStation station;
  station.scene_from_scan.translation = {distance_m * std::cos(azimuth_rad),
                                         distance_m * std::sin(azimuth_rad), height_m};
  station.step_rad = step_rad;
  return station;
}

}  // namespace alea
