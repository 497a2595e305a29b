#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "alea/core/noise_model.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/simulate/die_model.hpp"
#include "alea/simulate/mesh.hpp"

namespace alea {

/// What a flat patch is for in an experiment.
enum class PatchRole { scenery, check, calibration };

/// A rectangle corner + s side_u + t side_v, s and t in [0, 1]; seen from both sides. The two sides
/// are at right angles. Its plane's normal is side_u x side_v.
struct Patch {
  std::string id;
  Eigen::Vector3d corner_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d side_u_m = Eigen::Vector3d::UnitX();
  Eigen::Vector3d side_v_m = Eigen::Vector3d::UnitY();
  double intensity = 0.5;
  PatchRole role = PatchRole::scenery;
};

/// A solid box, centred in its own frame.
struct Box {
  std::string id;
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();
  RigidTransform scene_from_box;
  double intensity = 0.5;
};

/// A solid round cylinder with flat ends; with a radius of its own at the top, a frustum of a cone.
struct Cylinder {
  std::string id;
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();   ///< centre of one end
  Eigen::Vector3d axis_m = Eigen::Vector3d::UnitZ();  ///< to the centre of the other end
  double radius_m = 0.5;
  std::optional<double> top_radius_m = {};  ///< at the other end; empty: the same
  double intensity = 0.5;
};

struct Sphere {
  std::string id;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0725;
  double intensity = 0.9;
};

/// A checkerboard on a flat plate (or, with a wide margin, in a wall), seen from both sides. Board
/// frame: x along the columns, y along the rows, the pattern's centre at the origin.
struct Checkerboard {
  std::string id;
  RigidTransform scene_from_board;
  int columns = 2;
  int rows = 2;
  double cell_m = 0.075;        ///< side of one square cell
  double margin_m = 0;          ///< plate beyond the pattern, all around
  double dark_intensity = 0.1;  ///< cell (0, 0), at the least x and y, is dark
  double light_intensity = 0.9;
  double plate_intensity = 0.5;
};

/// Angles start, start + step, ... up to stop (a share of 1e-9 of a step beyond is still in).
struct AngleRange {
  double start_rad = 0;
  double stop_rad = 0;
  double step_rad = 1e-3;
  std::size_t count() const;
};

/// The instrument: each cause of error has its own number, and zero switches it off.
struct Scanner {
  NoiseModel noise;
  /// Diameter of the beam at distance r: beam_diameter_m + beam_divergence_rad * r.
  double beam_diameter_m = 0;
  double beam_divergence_rad = 0;
  int beam_rings = 1;              ///< sub-rays: 1 + 3 k (k + 1) for k rings, in hexagonal order
  bool mixed_pixels = true;        ///< range is the mean over the beam; false: that of its centre
  double intensity_noise = 0.102;  ///< standard deviation; 0.17 of the pips' contrast of 0.6
  double min_range_m = 0.1;
  double max_range_m = 350;
};

/// A place of the scanner: pose and grid. Azimuth runs from +x to +y about +z of the scan frame,
/// elevation from the xy plane to +z; rows are elevations, columns azimuths.
struct Station {
  std::string name;
  RigidTransform scene_from_scan;
  AngleRange azimuth{-3.14159265358979323846, 3.14159265358979323846, 1e-3};
  AngleRange elevation{-1.0, 1.5, 1e-3};
  Scanner scanner;
};

struct Scene {
  std::vector<Die> dice;
  std::vector<Patch> patches;
  std::vector<Box> boxes;
  std::vector<Cylinder> cylinders;
  std::vector<Sphere> spheres;
  std::vector<Checkerboard> checkerboards;
  std::vector<Mesh> meshes;
  std::vector<Station> stations;
};

/// A ball about everything of one object (metres, scene frame).
struct BoundingBall {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

BoundingBall bounding_ball(const Die& die);
BoundingBall bounding_ball(const Patch& patch);
BoundingBall bounding_ball(const Box& box);
BoundingBall bounding_ball(const Cylinder& cylinder);
BoundingBall bounding_ball(const Sphere& sphere);
BoundingBall bounding_ball(const Checkerboard& board);
BoundingBall bounding_ball(const Mesh& mesh);

/// Upright pose at `position_m`; the scan's x axis points to `heading_rad` (from scene x to y).
RigidTransform levelled_pose(const Eigen::Vector3d& position_m, double heading_rad);

/// A station at `scene_from_scan` whose grid is just the window around a ball: what a die-only or
/// sphere-only scan needs. Grid angles are multiples of `step_rad` plus `phase` (shares of a step).
Station aimed_station(const RigidTransform& scene_from_scan, const BoundingBall& target,
                      double step_rad, const Eigen::Vector2d& phase = Eigen::Vector2d::Zero());

/// Half the size of a checkerboard's plate along its x and y (m).
Eigen::Vector2d half_plate_m(const Checkerboard& board);

/// The plane of a patch, normal side_u x side_v.
Plane plane_of(const Patch& patch);
Eigen::Vector3d centre_of(const Patch& patch);

}  // namespace alea
