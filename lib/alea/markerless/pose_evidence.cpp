#include "alea/markerless/pose_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "alea/core/parallel.hpp"
#include "alea/markerless/standing_agreement.hpp"

namespace alea {
namespace {

constexpr std::size_t rough_stride = 2;

struct Counts {
  std::size_t agree = 0, standing = 0, conflict = 0;
  double squares = 0;
};

/// A scan's points, all or its probe, with the direction that is up there.
struct Seen {
  const Cloud& cloud;
  Eigen::Vector3d up;
  bool stands(std::size_t i) const {
    return std::abs(up.dot(cloud.normals[i].cast<double>())) < 0.7;
  }
};

Seen seen(const PreparedScan& scan, const Cloud& cloud) {
  return {cloud, scan.upright_from_scan.row(2)};
}

/// The points of `from` seen by `to`.
Counts count(const PreparedScan& to, const Seen& from, const RigidTransform& to_from_from,
             double agree_m, const EvidenceOptions& options) {
  constexpr std::size_t chunk = 2048;
  const Cloud& cloud = from.cloud;
  std::vector<Counts> parts((cloud.size() + chunk - 1) / chunk);
  parallel_chunks(cloud.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Counts& part = parts[begin / chunk];
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d p = to_from_from * cloud.positions[i];
      const auto near = to.fine_index.nearest_one(p, agree_m);
      if (near) {
        const Eigen::Vector3d normal = to.fine.normals[near->index].cast<double>();
        if (normal.dot(to_from_from.rotation * cloud.normals[i].cast<double>()) >
            options.agree_cosine) {
          const double off = normal.dot(p - to.fine.positions[near->index]);
          part.squares += off * off;
          ++part.agree;
          part.standing += from.stands(i) ? 1 : 0;
          continue;
        }
      }
      if (to.free_space.is_in_free_space(p, options.free_margin_m)) ++part.conflict;
    }
  });
  Counts sum;
  for (const Counts& part : parts) {
    sum.agree += part.agree;
    sum.standing += part.standing;
    sum.conflict += part.conflict;
    sum.squares += part.squares;
  }
  return sum;
}

/// The same for poses that are not exact: no search tree, wide margins.
Counts count_roughly(const PreparedScan& to, const Seen& from, const RigidTransform& to_from_from) {
  constexpr double margin_m = 0.6;
  Counts sum;
  for (std::size_t i = 0; i < from.cloud.size(); i += rough_stride) {
    const Eigen::Vector3d p = to_from_from * from.cloud.positions[i];
    if (to.surfaces.has(p, to_from_from.rotation * from.cloud.normals[i].cast<double>())) {
      ++sum.agree;
      sum.standing += from.stands(i) ? 1 : 0;
    } else if (to.free_space.is_in_free_space(p, margin_m)) {
      ++sum.conflict;
    }
  }
  return sum;
}

/// `back` counts the fixed scan's points, `moved` the moving one's; of so many.
StandingEvidence evidence_of(const Counts& back, std::size_t of_fixed, const Counts& moved,
                             std::size_t of_moving) {
  const auto share = [](std::size_t n, std::size_t of) {
    return static_cast<double>(n) / static_cast<double>(std::max<std::size_t>(of, 1));
  };
  StandingEvidence found;
  found.evidence.agree_moving = share(moved.agree, of_moving);
  found.evidence.conflict_moving = share(moved.conflict, of_moving);
  found.evidence.agree_fixed = share(back.agree, of_fixed);
  found.evidence.conflict_fixed = share(back.conflict, of_fixed);
  found.standing = (share(back.standing, of_fixed) + share(moved.standing, of_moving)) / 2;
  const std::size_t agree = moved.agree + back.agree;
  if (agree > 0)
    found.evidence.normal_rmse_m =
        std::sqrt((moved.squares + back.squares) / static_cast<double>(agree));
  return found;
}

}  // namespace

double StandingEvidence::contradiction() const {
  constexpr double of_lying = 0.2, floor = 0.01;
  const double support = standing + of_lying * (evidence.overlap() - standing);
  if (!(support > 0)) return 1e9;
  return (evidence.conflict_fixed + evidence.conflict_moving + floor) / (2 * support);
}

StandingEvidence standing_evidence(const PreparedScan& fixed, const PreparedScan& moving,
                                   const RigidTransform& fixed_from_moving,
                                   const EvidenceOptions& options) {
  const double agree_m =
      options.agree_m > 0 ? options.agree_m : std::max({0.1, fixed.cell_m, moving.cell_m});
  const Seen of_fixed = seen(fixed, options.use_probe ? fixed.probe : fixed.fine);
  const Seen of_moving = seen(moving, options.use_probe ? moving.probe : moving.fine);
  const Counts moved = count(fixed, of_moving, fixed_from_moving, agree_m, options);
  const Counts back = count(moving, of_fixed, fixed_from_moving.inverse(), agree_m, options);
  return evidence_of(back, of_fixed.cloud.size(), moved, of_moving.cloud.size());
}

PoseEvidence pose_evidence(const PreparedScan& fixed, const PreparedScan& moving,
                           const RigidTransform& fixed_from_moving,
                           const EvidenceOptions& options) {
  return standing_evidence(fixed, moving, fixed_from_moving, options).evidence;
}

StandingEvidence rough_evidence(const PreparedScan& fixed, const PreparedScan& moving,
                                const RigidTransform& fixed_from_moving) {
  const Counts moved = count_roughly(fixed, seen(moving, moving.probe), fixed_from_moving);
  const Counts back = count_roughly(moving, seen(fixed, fixed.probe), fixed_from_moving.inverse());
  return evidence_of(back, (fixed.probe.size() + 1) / rough_stride, moved,
                     (moving.probe.size() + 1) / rough_stride);
}

}  // namespace alea
