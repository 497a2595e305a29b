#include "alea/die/shape_prior.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <string>

#include "alea/core/error.hpp"

namespace alea {
namespace {

/// Half of the mean distance between opposite facets, as far as they are known (m).
double half_size_m(const DieShape& shape) {
  double sum = 0;
  int count = 0;
  for (int pips = 1; pips <= 3; ++pips) {
    const auto &near = shape.facet(pips), &far = shape.facet(opposite_pips(pips));
    if (!near || !far) continue;
    sum += (near->offset_m + far->offset_m) / 2;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// Normal of a facet from its opposite, else from its neighbours' axes.
Eigen::Vector3d guessed_normal(const DieShape& shape, int pips) {
  if (const auto& far = shape.facet(opposite_pips(pips))) return -far->normal;
  throw usage_error("die shape: neither facet " + std::to_string(pips) +
                    " nor its opposite is known; a shape needs one facet of each axis");
}

ShapePrior prior_about(const DieShape& shape) {
  ShapePrior prior;
  const double half_m = half_size_m(shape);
  for (int pips = 1; pips <= 6; ++pips) {
    const auto& known = shape.facet(pips);
    prior.nominal[pips - 1] = known ? *known : Plane{guessed_normal(shape, pips), half_m};
  }
  return prior;
}

/// A corner of three departed facets and its derivative by all departures.
struct CornerByDeparture {
  Eigen::Vector3d point_m;
  Eigen::Matrix<double, 3, 18> by_departure;
};

CornerByDeparture corner_of(const std::array<DepartedFacet, 6>& facets,
                            const std::array<int, 3>& pips) {
  Eigen::Matrix3d normals;
  Eigen::Vector3d offsets;
  for (int k = 0; k < 3; ++k) {
    const Plane& plane = facets[pips[k] - 1].fit.plane;
    normals.row(k) = plane.normal;
    offsets[k] = plane.offset_m;
  }
  const Eigen::PartialPivLU<Eigen::Matrix3d> solver(normals);
  CornerByDeparture corner{solver.solve(offsets), Eigen::Matrix<double, 3, 18>::Zero()};
  Eigen::Matrix<double, 3, 18> shift = Eigen::Matrix<double, 3, 18>::Zero();
  for (int k = 0; k < 3; ++k) {
    const DepartedFacet& facet = facets[pips[k] - 1];
    Eigen::RowVector3d row;
    row << -(corner.point_m - facet.fit.centroid_m).transpose() * facet.fit.tangent, 1;
    shift.block<1, 3>(k, 3 * (pips[k] - 1)) = row * facet.by_departure;
  }
  corner.by_departure = solver.solve(shift);
  return corner;
}

}  // namespace

CentredShape centred(const DieShape& shape) {
  const double half_m = half_size_m(shape);
  // One mid-plane for each axis: between opposite facets, or half a size inside a lone one.
  Eigen::Matrix3d normals;
  Eigen::Vector3d offsets;
  for (int axis = 0; axis < 3; ++axis) {
    const auto &near = shape.facet(axis + 1), &far = shape.facet(opposite_pips(axis + 1));
    if (near && far) {
      normals.row(axis) = (near->normal - far->normal) / 2;
      offsets[axis] = (near->offset_m - far->offset_m) / 2;
    } else {
      const Plane plane = near ? *near : Plane{guessed_normal(shape, axis + 1), 0};
      normals.row(axis) = plane.normal;
      offsets[axis] = near ? near->offset_m - half_m : half_m - far->offset_m;
    }
  }
  CentredShape out{shape, normals.partialPivLu().solve(offsets)};
  for (auto& facet : out.shape.facets)
    if (facet) facet->offset_m -= facet->normal.dot(out.middle_m);
  return out;
}

ShapePrior free_shape(const DieShape& nominal) {
  return prior_about(centred(nominal).shape);
}

ShapePrior exact_shape(const DieShape& shape) {
  ShapePrior prior = prior_about(centred(shape).shape);
  for (int pips = 1; pips <= 6; ++pips) prior.exact[pips - 1] = shape.facet(pips).has_value();
  return prior;
}

ShapePrior normal_shape(const DieShape& nominal, double tilt_sd_rad, double offset_sd_m) {
  if (!(tilt_sd_rad > 0 && offset_sd_m > 0))
    throw usage_error("die shape: standard deviations of tilts and offsets must be positive");
  ShapePrior prior = prior_about(centred(nominal).shape);
  const Eigen::Vector3d sd(tilt_sd_rad, tilt_sd_rad, offset_sd_m);
  prior.information = sd.cwiseAbs2().cwiseInverse().replicate<6, 1>().asDiagonal();
  return prior;
}

ShapePrior calibrated_shape(const DieShape& shape, const ShapeMatrix& covariance) {
  ShapePrior prior = prior_about(shape);
  const Eigen::SelfAdjointEigenSolver<ShapeMatrix> spectrum(covariance);
  // Rounding of a written covariance is 1e-16 of its largest value; tilts are known to 1e-6 rad.
  const double least = 1e-12 * spectrum.eigenvalues().tail<1>()[0];
  for (int k = 0; k < 18; ++k) {
    if (spectrum.eigenvalues()[k] <= least) continue;
    const ShapeVector direction = spectrum.eigenvectors().col(k);
    prior.information += direction * direction.transpose() / spectrum.eigenvalues()[k];
  }
  return prior;
}

DepartedFacet departed_facet(const Plane& nominal, const Eigen::Vector3d& abc) {
  const auto basis = tangent_basis(nominal.normal);
  const Eigen::Vector3d leaning = nominal.normal + basis * abc.head<2>();
  DepartedFacet out;
  PlaneFit& fit = out.fit;
  fit.plane.normal = leaning.normalized();
  fit.centroid_m = nominal.offset_m * nominal.normal + abc[2] * fit.plane.normal;
  fit.plane.offset_m = fit.plane.normal.dot(fit.centroid_m);
  fit.tangent = tangent_basis(fit.plane.normal);
  out.by_departure.setIdentity();
  out.by_departure.topLeftCorner<2, 2>() = fit.tangent.transpose() * basis / leaning.norm();
  return out;
}

std::array<DepartedFacet, 6> departed_facets(const ShapePrior& prior,
                                             const ShapeVector& departure) {
  std::array<DepartedFacet, 6> facets;
  for (int f = 0; f < 6; ++f)
    facets[f] = departed_facet(prior.nominal[f], departure.segment<3>(3 * f));
  return facets;
}

EdgeByShape edge_of(const std::array<DepartedFacet, 6>& facets, const EdgeName& edge) {
  const int end = 4 - die_axis(edge.first_pips) - die_axis(edge.second_pips);
  const CornerByDeparture from = corner_of(facets, {edge.first_pips, edge.second_pips, end});
  const CornerByDeparture to =
      corner_of(facets, {edge.first_pips, edge.second_pips, opposite_pips(end)});
  const Eigen::Vector3d apart = to.point_m - from.point_m;
  return {apart.norm(), apart.normalized().transpose() * (to.by_departure - from.by_departure)};
}

Eigen::Matrix<double, 18, 6> rigid_departures(const ShapePrior& prior) {
  Eigen::Matrix<double, 18, 6> motions = Eigen::Matrix<double, 18, 6>::Zero();
  for (int f = 0; f < 6; ++f) {
    const Plane& plane = prior.nominal[f];
    const auto basis = tangent_basis(plane.normal);
    const Eigen::Vector3d centre = plane.offset_m * plane.normal;
    for (int k = 0; k < 2; ++k)
      motions.block<1, 3>(3 * f + k, 0) = plane.normal.cross(basis.col(k)).transpose();
    motions.block<1, 6>(3 * f + 2, 0) << centre.cross(plane.normal).transpose(),
        plane.normal.transpose();
  }
  return motions;
}

}  // namespace alea
