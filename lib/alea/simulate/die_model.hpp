#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "alea/core/plane.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/core/seed.hpp"
#include "alea/die/die_shape.hpp"
#include "alea/die/hexahedron.hpp"

namespace alea {

/// How one facet departs from that of the nominal cuboid.
struct FacetShape {
  double tilt_u_rad = 0;  ///< the normal leans towards the facet's u axis
  double tilt_v_rad = 0;  ///< and towards its v axis
  double offset_m = 0;    ///< the facet's centre moves outward
  /// Outward bow: bow_m (1 - (u^2 + v^2) / 2) in units of the half edge, so bow_m at the centre,
  /// 2/3 of it on average, nothing at the corners. The outline stays that of the planes.
  double bow_m = 0;
};

/// Round marks of the usual layout. Lengths are shares of the edge.
struct PipStyle {
  bool painted = true;  ///< false: a blank cube
  double radius_share = 0.09;
  double spacing_share = 0.25;  ///< the rows lie at +- this share from the centre
  double recess_m = 0;          ///< depth of the marks
  double intensity = 0.2;
  bool turned_2 = false;  ///< two pips on the other diagonal; the way it is turned varies by maker
  bool turned_3 = false;
  bool turned_6 = false;
};

/// A die before it is built: a cuboid whose six planes are then tilted and shifted, each on its
/// own. Facet index = pips - 1; opposite facets sum to seven.
struct DieModel {
  std::string id = "die";
  /// Distances between the facets 1 and 6, 2 and 5, 3 and 4 (metres).
  Eigen::Vector3d size_m = Eigen::Vector3d::Constant(0.5);
  Chirality chirality = Chirality::clockwise;
  std::array<FacetShape, 6> facets;
  double edge_radius_m = 0;  ///< edges and corners rounded by a rolling sphere
  double intensity = 0.8;
  PipStyle pips;
  RigidTransform scene_from_die;  ///< the die frame has its origin in the nominal centre
};

/// A facet of a built die, scene frame.
struct DieFacet {
  Plane plane;  ///< outward
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();  ///< in the plane
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();  ///< in the plane, normal to u
  double half_m = 0;                             ///< half the nominal edge, the unit of the bow
  double bow_m = 0;
  std::vector<Eigen::Vector2d> pip_centres_m;  ///< in (u, v)
  double pip_radius_m = 0;
};

/// A die ready for rays: exact corners, scene frame.
struct Die {
  DieModel model;
  Hexahedron body;  ///< of the six planes, without rounding and bow
  std::array<DieFacet, 6> facets;
  Hexahedron core;  ///< the body inset by the edge radius; the surface is core + sphere
};

/// The six outward planes of the model in the die frame (facet index = pips - 1).
std::array<Plane, 6> die_planes(const DieModel& model);

/// The pose of a die that stands upright: the facet with `pips_up` pips looks along scene +z, the
/// one with `pips_front` to the azimuth `front_azimuth_rad` (from scene x to y), before tilts.
/// Throws Error(usage) for two equal or opposite facets.
RigidTransform standing_pose(Chirality chirality, int pips_up, int pips_front,
                             double front_azimuth_rad, const Eigen::Vector3d& centre_m);

/// Builds the die; the exact kernel checks that its planes close to a convex hexahedron of the
/// model's hand. Throws Error(usage) where they do not, or where a size is not positive.
Die build_die(const DieModel& model);

/// Length of the edge in which the facets with `pips_a` and `pips_b` pips meet, from corner to
/// corner (m). Throws Error(usage) for equal or opposite facets.
double edge_length_m(const Hexahedron& body, int pips_a, int pips_b);

/// Normal random departures from the cuboid (standard deviations).
struct DieSpread {
  double tilt_sd_rad = 0;    ///< each facet, two directions
  double offset_sd_m = 0;    ///< each facet
  double size_sd_share = 0;  ///< each of the three sizes, as a share of itself
};

/// The model with random tilts, offsets and sizes; the same key (purpose die_shape) gives the same
/// die.
DieModel with_random_shape(const DieModel& model, const DieSpread& spread, std::uint64_t seed,
                           std::uint32_t experiment, std::uint64_t trial);

}  // namespace alea
