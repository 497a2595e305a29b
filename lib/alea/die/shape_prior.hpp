#pragma once

#include <Eigen/Core>
#include <array>

#include "alea/core/plane.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/die/closed_form.hpp"
#include "alea/die/die_shape.hpp"
#include "alea/facet/plane_fit.hpp"

namespace alea {

/// Departures of a die from its nominal planes: a, b (rad), c (m) of the facets with 1 to 6 pips in
/// turn. A normal n becomes normalised(n + a e1 + b e2) with tangent_basis(n) = [e1 e2], turned
/// about the facet's centre (the foot of the die frame's origin); then the plane moves outward by
/// c.
using ShapeVector = Eigen::Matrix<double, 18, 1>;
using ShapeMatrix = Eigen::Matrix<double, 18, 18>;

/// What is known of a die's shape before it is measured. The origin of the nominal planes' frame
/// lies in the die's middle.
struct ShapePrior {
  std::array<Plane, 6> nominal;  ///< [pips - 1], outward
  std::array<bool, 6> exact{};   ///< facets without any departure
  /// Inverse covariance of the departures; zero where nothing is known. The part of exact facets
  /// has no meaning.
  ShapeMatrix information = ShapeMatrix::Zero();
};

/// Nothing known but which facet lies opposite which: the nominal planes are a start only. Facets
/// that the shape lacks are guessed from the others.
ShapePrior free_shape(const DieShape& nominal);

/// The given facets exactly known; those that the shape lacks are free.
ShapePrior exact_shape(const DieShape& shape);

/// Independent normal departures of every facet: two tilts and an offset. An infinite standard
/// deviation leaves them free. Throws Error(usage) for deviations that are not positive.
ShapePrior normal_shape(const DieShape& nominal, double tilt_sd_rad, double offset_sd_m);

/// A calibrated shape whose frame has its origin in the die's middle, with the covariance of its
/// departures. Zero variance in a direction means that nothing is known there (the motions of the
/// die as a whole, and what the calibration left open), so that only what was determined counts.
ShapePrior calibrated_shape(const DieShape& shape, const ShapeMatrix& covariance);

/// The shape in a frame with the same axes and its origin in the middle of the known facets, and
/// where that is in the old frame (m).
struct CentredShape {
  DieShape shape;
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
};
CentredShape centred(const DieShape& shape);

/// A facet after its departure.
struct DepartedFacet {
  PlaneFit fit;                  ///< plane, centroid and orthonormal tangent; no covariance
  Eigen::Matrix3d by_departure;  ///< a, b, c of `fit` by the departure's
};
DepartedFacet departed_facet(const Plane& nominal, const Eigen::Vector3d& abc);
std::array<DepartedFacet, 6> departed_facets(const ShapePrior& prior, const ShapeVector& departure);

/// Length of an edge from corner to corner (m) and its derivative by the departures.
struct EdgeByShape {
  double length_m = 0;
  Eigen::Matrix<double, 1, 18> by_departure = Eigen::Matrix<double, 1, 18>::Zero();
};
EdgeByShape edge_of(const std::array<DepartedFacet, 6>& facets, const EdgeName& edge);

/// Departures that a small motion of the whole die makes: columns are rotation x, y, z (rad) and
/// translation x, y, z (m) in the die frame.
Eigen::Matrix<double, 18, 6> rigid_departures(const ShapePrior& prior);

}  // namespace alea
