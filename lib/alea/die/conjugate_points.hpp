#pragma once

#include <Eigen/Core>
#include <array>

#include "alea/core/rigid_transform.hpp"
#include "alea/die/corner_frame.hpp"

namespace alea {

/// The lengths of a die along its three axes (m), from one facet to the opposite one.
struct DieDimensions {
  double from_1_to_6_m = 0;
  double from_2_to_5_m = 0;
  double from_3_to_4_m = 0;
  /// l_z of equation (4), zero in theory: lifts the second frame along Z. The paper calibrates it.
  double lift_m = 0;
};

/// Misprints of equations (3) to (8) that can be put back one by one, to show what each does. All
/// false: the corrected equations.
struct PrintedErrors {
  bool left_handed_axes = false;  ///< (3): V_y = V_x x V_z
  bool no_corner = false;         ///< (5), (8): the points are bare directions
  bool reversed_turn = false;     ///< (4): R3 turns the wrong way (the text maps V to U)
  bool opposite_offset = false;   ///< (7): (l_x, l_y, 0) whatever the corners are
  /// Scanner to scanner in one step. Otherwise as in the text: two fits, through the die's space.
  bool direct_pairing = false;

  /// The equations exactly as they stand in print.
  static PrintedErrors as_printed() { return {true, true, true, true, false}; }
};

/// Equation (4): from coordinates in the frame U (second station) to those in V (first station).
/// Rotation and offset follow from the labels of the two corners, for any pair of them. Stations a
/// quarter turn apart get one horizontal length, opposite stations two; nothing is typed in.
RigidTransform v_from_u(const FrameLabel& v, const FrameLabel& u, const DieDimensions& dimensions,
                        const PrintedErrors& errors = {});

/// Three pairs of conjugate points at unit length along the axes (m).
struct ConjugatePoints {
  std::array<Eigen::Vector3d, 3> v_in_master;  ///< (5): corner plus V_x, V_y, V_z
  std::array<Eigen::Vector3d, 3> v_in_die;     ///< (6): their coordinates in V
  std::array<Eigen::Vector3d, 3> u_in_die;     ///< (7): (4) applied to (1,0,0), (0,1,0), (0,0,1)
  std::array<Eigen::Vector3d, 3> u_in_slave;   ///< (8): corner plus U_x, U_y, U_z
};

/// A corner with orthonormal axes (columns), in the frame of its scan (m).
struct OrthogonalFrame {
  FrameLabel label;
  Eigen::Vector3d corner_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// Equations (4) to (8) of Chan et al. 2023.
ConjugatePoints conjugate_points(const OrthogonalFrame& v, const OrthogonalFrame& u,
                                 const DieDimensions& dimensions, const PrintedErrors& errors = {});

/// Horn's method on the conjugate points: first (8) to (7) and (6) to (5), joined. Three points at
/// unit length leave no redundancy: the residual is zero whatever the error.
RigidTransform register_conjugate(const ConjugatePoints& points, const PrintedErrors& errors = {});

}  // namespace alea
