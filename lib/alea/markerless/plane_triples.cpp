#include "alea/markerless/plane_triples.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "alea/plane/exact_predicates.hpp"
#include "alea/plane/plane_detector.hpp"

namespace alea {
namespace {

struct Face {
  Plane plane;
  Eigen::Vector3d centroid_m;
  double share;  ///< of the scan's points
};

std::vector<Face> faces_of(const PreparedScan& scan, std::size_t count) {
  PlaneDetectionOptions options;
  options.tolerance_m = 0.3 * scan.cell_m;
  options.min_points = 60;
  std::vector<Face> faces;
  Cloud cloud;
  cloud.positions = scan.fine.positions;
  cloud.scanner_position = Eigen::Vector3d::Zero();
  for (const PlaneRegion& region : detect_planes(cloud, options)) {
    if (faces.size() == count) break;
    faces.push_back(
        {region.plane, region.centroid_m,
         static_cast<double>(region.indices.size()) / static_cast<double>(scan.fine.size())});
  }
  return faces;
}

struct Triple {
  std::array<std::size_t, 3> faces;
  std::array<double, 3> angles_rad;  ///< between the normals 0-1, 1-2, 2-0
};

double angle_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

/// Every ordered triple of enough volume and positive hand.
std::vector<Triple> triples_of(const std::vector<Face>& faces, double least_volume) {
  std::vector<Triple> triples;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = 0; j < faces.size(); ++j)
      for (std::size_t k = 0; k < faces.size(); ++k) {
        if (i == j || j == k || i == k) continue;
        const Eigen::Vector3d &a = faces[i].plane.normal, &b = faces[j].plane.normal,
                              &c = faces[k].plane.normal;
        if (exact_orientation(a, b, c) != 1 || a.dot(b.cross(c)) < least_volume) continue;
        triples.push_back({{i, j, k}, {angle_rad(a, b), angle_rad(b, c), angle_rad(c, a)}});
      }
  return triples;
}

Eigen::Matrix3d normals_of(const std::vector<Face>& faces, const Triple& triple) {
  Eigen::Matrix3d columns;
  for (int k = 0; k < 3; ++k)
    columns.col(k) = faces[triple.faces[static_cast<std::size_t>(k)]].plane.normal;
  return columns;
}

/// Rotation by the singular value decomposition of the normals' products, translation by the three
/// offsets: n . (R x + t) = d.
RigidTransform pose_of(const std::vector<Face>& fixed, const Triple& a,
                       const std::vector<Face>& moving, const Triple& b) {
  const Eigen::Matrix3d to = normals_of(fixed, a), from = normals_of(moving, b);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(to * from.transpose(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign(1, 1,
                       (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  RigidTransform pose;
  pose.rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  Eigen::Vector3d offsets;
  for (std::size_t k = 0; k < 3; ++k)
    offsets[static_cast<Eigen::Index>(k)] =
        fixed[a.faces[k]].plane.offset_m - moving[b.faces[k]].plane.offset_m;
  pose.translation = to.transpose().partialPivLu().solve(offsets);
  return pose;
}

double agreement(const std::vector<Face>& fixed, const std::vector<Face>& moving,
                 const RigidTransform& pose, const PlaneTripleOptions& options) {
  const double least_cosine = std::cos(options.angle_tolerance_rad);
  double sum = 0;
  for (const Face& face : moving) {
    const Eigen::Vector3d normal = pose.rotation * face.plane.normal;
    const Eigen::Vector3d centroid = pose * face.centroid_m;
    double best = 0;
    for (const Face& other : fixed)
      if (other.plane.normal.dot(normal) > least_cosine &&
          std::abs(other.plane.signed_distance(centroid)) < options.offset_tolerance_m)
        best = std::max(best, std::min(face.share, other.share));
    sum += best;
  }
  return sum;
}

bool same_angles(const Triple& a, const Triple& b, double tolerance_rad) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(a.angles_rad[k] - b.angles_rad[k]) > tolerance_rad) return false;
  return true;
}

}  // namespace

std::vector<PoseCandidate> plane_triple_candidates(const PreparedScan& fixed,
                                                   const PreparedScan& moving,
                                                   const PlaneTripleOptions& options) {
  const std::vector<Face> of_fixed = faces_of(fixed, options.planes);
  const std::vector<Face> of_moving = faces_of(moving, options.planes);
  const auto fixed_triples = triples_of(of_fixed, options.least_volume);
  const auto moving_triples = triples_of(of_moving, options.least_volume);
  std::vector<PoseCandidate> found;
  for (const Triple& a : fixed_triples) {
    if (a.faces[0] > a.faces[1] || a.faces[0] > a.faces[2]) continue;  // one turn of each triple
    for (const Triple& b : moving_triples) {
      if (!same_angles(a, b, options.angle_tolerance_rad)) continue;
      const RigidTransform pose = pose_of(of_fixed, a, of_moving, b);
      const double score = agreement(of_fixed, of_moving, pose, options);
      if (pose.translation.allFinite())
        found.push_back({pose, score, CandidateSource::plane_triples});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const PoseCandidate& a, const PoseCandidate& b) {
    return a.score > b.score;
  });
  found.resize(std::min<std::size_t>(found.size(), 500));
  return distinct(std::move(found), 5 * std::numbers::pi / 180, 0.5, options.candidates);
}

}  // namespace alea
