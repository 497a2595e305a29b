#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "alea/core/noise_model.hpp"
#include "alea/core/plane.hpp"
#include "alea/core/rigid_transform.hpp"

namespace alea {

/// Marks a quantity that nothing is known of before the measurement.
inline constexpr double unknown_sd = std::numeric_limits<double>::infinity();

/// A scanner position of a Fisher bound: where it stands and how densely it looks.
struct FisherStation {
  RigidTransform scene_from_scan;  ///< z of the scan's frame is the axis of the azimuth
  double step_rad = 3e-4;          ///< of the azimuth and of the elevation
  /// Standard deviation of the levelling about the scene's x and y each (rad); unknown_sd: none.
  double level_sd_rad = unknown_sd;
  /// This station's own noise; empty: the scene's.
  std::optional<NoiseModel> noise;
  /// Whether a point of a target (scene frame, metres) is seen; empty: everything that faces.
  std::function<bool(const Eigen::Vector3d&)> sees;
};

/// A flat convex piece of surface, scene frame, metres.
struct FisherFacet {
  Plane plane;                             ///< outward normal
  std::vector<Eigen::Vector3d> corners_m;  ///< in order round the polygon
};

/// The length from corner to corner along the line of facets `first` and `second`, between facets
/// `from` and `to` (indices into FisherBody::facets).
struct FisherEdge {
  int first = 0, second = 0, from = 0, to = 0;
  double sd_m = 0;  ///< 0: exactly known
};

/// A set of facets with a shape. Its place is always unknown. Each facet deviates from the nominal
/// shape by two tilts about its centre and an offset; a standard deviation of 0 fixes them, one of
/// unknown_sd frees them. A calibration plane is a body with one facet.
struct FisherBody {
  std::vector<FisherFacet> facets;
  double tilt_sd_rad = unknown_sd;
  double offset_sd_m = unknown_sd;
  std::vector<FisherEdge> edges;
};

/// A sphere target, scene frame, metres.
struct FisherSphere {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0725;
  bool radius_known = true;
};

struct FisherScene {
  std::vector<FisherStation> stations;
  std::vector<FisherBody> bodies;
  std::vector<FisherSphere> spheres;
  NoiseModel noise;
};

/// A facet bounded by its neighbours: the part of plane `index` that lies behind all the others.
/// Throws a usage error where the planes leave nothing of it.
FisherFacet facet_of_planes(const std::vector<Plane>& outward_planes, std::size_t index);

/// The body of a die from its outward planes in the scene frame (index = place in the list), with
/// free shape and no edge known. Facets keep the order of the planes.
FisherBody free_body(const std::vector<Plane>& outward_planes);

/// The same with the shape exactly known (bound K of the die study).
FisherBody known_body(const std::vector<Plane>& outward_planes);

/// A flat convex patch, e.g. a wall or a board, of unknown place and tilt.
FisherBody calibration_plane(const FisherFacet& patch);

/// Outward planes (+x, +y, +z, -z, -y, -x) of a cube that stands on the floor z = 0 with its centre
/// over the origin.
std::vector<Plane> cube_on_floor(double edge_m);

/// The first edge, by index, between the two facets that both stations see, ended by one facet that
/// each sees alone. Throws a usage error where the stations do not share exactly two facets.
FisherEdge shared_edge(const FisherBody& body, const FisherStation& master,
                       const FisherStation& slave);

/// True where the facet faces the station.
bool faces(const FisherFacet& facet, const FisherStation& station);

/// A levelled station at a horizontal distance and azimuth from the scene's z axis, at a height
/// above z = 0, looking with a step.
FisherStation station_at(double distance_m, double azimuth_rad, double height_m, double step_rad);

}  // namespace alea
