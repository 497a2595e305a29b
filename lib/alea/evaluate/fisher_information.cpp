#include "alea/evaluate/fisher_information.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

namespace alea {
namespace {

constexpr int order = 16;

struct GaussLegendre {
  std::array<double, order> node;    ///< in (0, 1)
  std::array<double, order> weight;  ///< sums to 1
};

/// Nodes as roots of the Legendre polynomial by Newton's method.
GaussLegendre gauss_legendre() {
  GaussLegendre rule{};
  for (int i = 0; i < order; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (order + 0.5));
    double slope = 1;
    for (int step = 0; step < 20; ++step) {
      double previous = 1, value = x;
      for (int k = 2; k <= order; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
        previous = value;
        value = next;
      }
      slope = order * (x * value - previous) / (x * x - 1);
      x -= value / slope;
    }
    rule.node[i] = (1 + x) / 2;
    rule.weight[i] = 1 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

const GaussLegendre& rule() {
  static const GaussLegendre shared = gauss_legendre();
  return shared;
}

/// Cosine of the elevation of a ray (unit vector, scene frame) in the station's own grid.
double cos_elevation(const Eigen::Vector3d& ray, const FisherStation& station) {
  return ray.cross(station.scene_from_scan.rotation.col(2)).norm();
}

}  // namespace

Eigen::Vector3d facet_centre(const FisherFacet& facet) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : facet.corners_m) sum += corner;
  return sum / static_cast<double>(facet.corners_m.size());
}

Eigen::Matrix3d facet_information(const FisherFacet& facet, const FisherStation& station,
                                  const NoiseModel& noise) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  if (!faces(facet, station)) return information;
  const Eigen::Vector3d q = facet_centre(facet);
  const auto basis = tangent_basis(facet.plane.normal);
  const Eigen::Vector3d& eye = station.scene_from_scan.translation;
  for (std::size_t k = 1; k + 1 < facet.corners_m.size(); ++k) {
    const Eigen::Vector3d& a = facet.corners_m[0];
    const Eigen::Vector3d ab = facet.corners_m[k] - a, ac = facet.corners_m[k + 1] - a;
    const double twice_area = ab.cross(ac).norm();
    for (int i = 0; i < order; ++i) {
      for (int j = 0; j < order; ++j) {
        // The square (s, t) folded onto the triangle; the Jacobian is s.
        const double s = rule().node[i], t = rule().node[j];
        const Eigen::Vector3d x = a + s * ((1 - t) * ab + t * ac);
        if (station.sees && !station.sees(x)) continue;
        const double area = rule().weight[i] * rule().weight[j] * s * twice_area;
        const double range = (x - eye).norm();
        const Eigen::Vector3d ray = (x - eye) / range;
        const double cosine = std::abs(ray.dot(facet.plane.normal));
        const double rays =
            area * cosine /
            (range * range * station.step_rad * station.step_rad * cos_elevation(ray, station));
        const double sd = noise.normal_sd_m(range, cosine);
        const Eigen::Vector3d z(1, (x - q).dot(basis.col(0)), (x - q).dot(basis.col(1)));
        information += rays / (sd * sd) * z * z.transpose();
      }
    }
  }
  return information;
}

Eigen::Matrix4d sphere_information(const FisherSphere& sphere, const FisherStation& station,
                                   const NoiseModel& noise) {
  constexpr int directions = 32;
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  const Eigen::Vector3d& eye = station.scene_from_scan.translation;
  const double distance = (sphere.centre_m - eye).norm();
  if (distance <= sphere.radius_m) return information;
  const Eigen::Vector3d axis = (sphere.centre_m - eye) / distance;
  const auto basis = tangent_basis(axis);
  const double ratio = sphere.radius_m / distance;
  for (int i = 0; i < order; ++i) {
    // Over the incidence angle, in which the integrand is smooth up to the limb: the ray leaves the
    // axis by theta with sin(theta) = ratio sin(incidence).
    const double incidence = rule().node[i] * std::numbers::pi / 2;
    const double sine = std::sin(incidence), cosine = std::cos(incidence);
    const double sin_theta = ratio * sine;
    const double cos_theta = std::sqrt(1 - sin_theta * sin_theta);
    const double solid_angle = rule().weight[i] * std::numbers::pi / 2 * sin_theta * ratio *
                               cosine / cos_theta * 2 * std::numbers::pi / directions;
    const double range = distance * cos_theta - sphere.radius_m * cosine;
    const double sd = noise.normal_sd_m(range, cosine);
    for (int j = 0; j < directions; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / directions;
      const Eigen::Vector3d ray = cos_theta * axis + sin_theta * (std::cos(phi) * basis.col(0) +
                                                                  std::sin(phi) * basis.col(1));
      if (station.sees && !station.sees(eye + range * ray)) continue;
      const double rays =
          solid_angle / (station.step_rad * station.step_rad * cos_elevation(ray, station));
      Eigen::Vector4d m;
      m << (eye + range * ray - sphere.centre_m) / sphere.radius_m, 1;
      information += rays / (sd * sd) * m * m.transpose();
    }
  }
  return information;
}

}  // namespace alea
