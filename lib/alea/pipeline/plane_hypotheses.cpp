#include "alea/pipeline/plane_hypotheses.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>

namespace alea {
namespace {

constexpr std::size_t seed_planes = 8, partner_planes = 12, compared_planes = 25, most_seeds = 8;
constexpr double least_volume = 0.3;     // |det| of three normals
constexpr double same_angle_rad = 0.02;  // between two planes in both scans
constexpr double agree_angle_rad = 0.035, agree_offset_m = 0.1;
constexpr std::size_t most_hypotheses = 12;

using Triple = std::array<std::size_t, 3>;

Eigen::Matrix3d normals_of(std::span<const PlaneRegion> planes, const Triple& triple) {
  Eigen::Matrix3d normals;
  for (int k = 0; k < 3; ++k) normals.col(k) = planes[triple[k]].plane.normal;
  return normals;
}

/// The master's triples with the most points first; the regions come largest first.
std::vector<Triple> seed_triples(std::span<const PlaneRegion> planes) {
  std::vector<Triple> seeds;
  const std::size_t count = std::min(planes.size(), seed_planes);
  for (std::size_t k = 2; k < count; ++k)
    for (std::size_t j = 1; j < k; ++j)
      for (std::size_t i = 0; i < j; ++i)
        if (std::abs(normals_of(planes, {i, j, k}).determinant()) > least_volume)
          seeds.push_back({i, j, k});
  if (seeds.size() > most_seeds) seeds.resize(most_seeds);
  return seeds;
}

bool same_shape(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  for (int k = 0; k < 3; ++k) {
    const double angle_a = std::acos(std::clamp(a.col(k).dot(a.col((k + 1) % 3)), -1.0, 1.0));
    const double angle_b = std::acos(std::clamp(b.col(k).dot(b.col((k + 1) % 3)), -1.0, 1.0));
    if (std::abs(angle_a - angle_b) > same_angle_rad) return false;
  }
  return a.determinant() * b.determinant() > 0;
}

/// Rotation by the normals (Kabsch 1976), translation by the three offsets.
RigidTransform carry(std::span<const PlaneRegion> master, const Triple& in_master,
                     std::span<const PlaneRegion> slave, const Triple& in_slave) {
  const Eigen::Matrix3d to = normals_of(master, in_master), from = normals_of(slave, in_slave);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(to * from.transpose(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  RigidTransform out;
  out.rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  Eigen::Vector3d offsets;
  for (int k = 0; k < 3; ++k)
    offsets[k] = master[in_master[k]].plane.offset_m - slave[in_slave[k]].plane.offset_m;
  out.translation = to.transpose().partialPivLu().solve(offsets);
  return out;
}

double agreeing_points(std::span<const PlaneRegion> master, std::span<const PlaneRegion> slave,
                       const RigidTransform& master_from_slave) {
  double points = 0;
  for (const PlaneRegion& target : master.first(std::min(master.size(), compared_planes))) {
    double best = 0;
    for (const PlaneRegion& source : slave.first(std::min(slave.size(), compared_planes))) {
      const Eigen::Vector3d normal = master_from_slave.rotation * source.plane.normal;
      if (normal.dot(target.plane.normal) < std::cos(agree_angle_rad)) continue;
      const Eigen::Vector3d centroid = master_from_slave * source.centroid_m;
      if (std::abs(target.plane.signed_distance(centroid)) > agree_offset_m) continue;
      best = std::max(best,
                      static_cast<double>(std::min(target.indices.size(), source.indices.size())));
    }
    points += best;
  }
  return points;
}

bool same_transform(const RigidTransform& a, const RigidTransform& b,
                    std::span<const PlaneRegion> master) {
  const RigidTransform change = a * b.inverse();
  if (rotation_angle_rad(change.rotation) > agree_angle_rad) return false;
  const Eigen::Vector3d& at = master.front().centroid_m;
  return (change * at - at).norm() < agree_offset_m;
}

}  // namespace

std::vector<PlaneHypothesis> plane_hypotheses(std::span<const PlaneRegion> master,
                                              std::span<const PlaneRegion> slave) {
  std::vector<PlaneHypothesis> found;
  const std::size_t partners = std::min(slave.size(), partner_planes);
  for (const Triple& seed : seed_triples(master)) {
    const Eigen::Matrix3d shape = normals_of(master, seed);
    for (std::size_t code = 0; code < partners * partners * partners; ++code) {
      const Triple triple{code % partners, code / partners % partners,
                          code / (partners * partners)};
      if (triple[0] == triple[1] || triple[1] == triple[2] || triple[0] == triple[2]) continue;
      if (!same_shape(shape, normals_of(slave, triple))) continue;
      const RigidTransform transform = carry(master, seed, slave, triple);
      found.push_back({transform, agreeing_points(master, slave, transform)});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<PlaneHypothesis> distinct;
  for (const PlaneHypothesis& hypothesis : found) {
    const bool again = std::any_of(distinct.begin(), distinct.end(), [&](const auto& better) {
      return same_transform(better.master_from_slave, hypothesis.master_from_slave, master);
    });
    if (!again) distinct.push_back(hypothesis);
    if (distinct.size() == most_hypotheses) break;
  }
  return distinct;
}

}  // namespace alea
