#include "alea/markerless/pose_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "alea/core/parallel.hpp"

namespace alea {
namespace {

struct Counts {
  std::size_t agree = 0, conflict = 0;
  double squares = 0;
};

/// The points of `from` seen by `to`.
Counts count(const PreparedScan& to, const Cloud& from, const RigidTransform& to_from_from,
             double agree_m, const EvidenceOptions& options) {
  constexpr std::size_t chunk = 2048;
  std::vector<Counts> parts((from.size() + chunk - 1) / chunk);
  parallel_chunks(from.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Counts& part = parts[begin / chunk];
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d p = to_from_from * from.positions[i];
      const auto near = to.fine_index.nearest_one(p, agree_m);
      if (near) {
        const Eigen::Vector3d normal = to.fine.normals[near->index].cast<double>();
        if (normal.dot(to_from_from.rotation * from.normals[i].cast<double>()) >
            options.agree_cosine) {
          const double off = normal.dot(p - to.fine.positions[near->index]);
          part.squares += off * off;
          ++part.agree;
          continue;
        }
      }
      if (to.free_space.is_in_free_space(p, options.free_margin_m)) ++part.conflict;
    }
  });
  Counts sum;
  for (const Counts& part : parts) {
    sum.agree += part.agree;
    sum.conflict += part.conflict;
    sum.squares += part.squares;
  }
  return sum;
}

constexpr std::size_t rough_stride = 2;

/// The same for poses that are not exact: no search tree, wide margins.
Counts count_roughly(const PreparedScan& to, const Cloud& from,
                     const RigidTransform& to_from_from) {
  constexpr double margin_m = 0.6;
  Counts sum;
  for (std::size_t i = 0; i < from.size(); i += rough_stride) {
    const Eigen::Vector3d p = to_from_from * from.positions[i];
    if (to.surfaces.has(p, to_from_from.rotation * from.normals[i].cast<double>()))
      ++sum.agree;
    else if (to.free_space.is_in_free_space(p, margin_m))
      ++sum.conflict;
  }
  return sum;
}

}  // namespace

PoseEvidence rough_evidence(const PreparedScan& fixed, const PreparedScan& moving,
                            const RigidTransform& fixed_from_moving) {
  const Counts moved = count_roughly(fixed, moving.probe, fixed_from_moving);
  const Counts back = count_roughly(moving, fixed.probe, fixed_from_moving.inverse());
  const auto share = [](std::size_t n, const Cloud& cloud) {
    return static_cast<double>(n * rough_stride) /
           static_cast<double>(std::max<std::size_t>(cloud.size(), 1));
  };
  PoseEvidence evidence;
  evidence.agree_moving = share(moved.agree, moving.probe);
  evidence.conflict_moving = share(moved.conflict, moving.probe);
  evidence.agree_fixed = share(back.agree, fixed.probe);
  evidence.conflict_fixed = share(back.conflict, fixed.probe);
  return evidence;
}

PoseEvidence pose_evidence(const PreparedScan& fixed, const PreparedScan& moving,
                           const RigidTransform& fixed_from_moving,
                           const EvidenceOptions& options) {
  const double agree_m =
      options.agree_m > 0 ? options.agree_m : std::max({0.1, fixed.cell_m, moving.cell_m});
  const Cloud& of_fixed = options.use_probe ? fixed.probe : fixed.fine;
  const Cloud& of_moving = options.use_probe ? moving.probe : moving.fine;
  const Counts moved = count(fixed, of_moving, fixed_from_moving, agree_m, options);
  const Counts back = count(moving, of_fixed, fixed_from_moving.inverse(), agree_m, options);
  const auto share = [](std::size_t n, const Cloud& cloud) {
    return static_cast<double>(n) / static_cast<double>(std::max<std::size_t>(cloud.size(), 1));
  };
  PoseEvidence evidence;
  evidence.agree_moving = share(moved.agree, of_moving);
  evidence.conflict_moving = share(moved.conflict, of_moving);
  evidence.agree_fixed = share(back.agree, of_fixed);
  evidence.conflict_fixed = share(back.conflict, of_fixed);
  const std::size_t agree = moved.agree + back.agree;
  if (agree > 0)
    evidence.normal_rmse_m = std::sqrt((moved.squares + back.squares) / static_cast<double>(agree));
  return evidence;
}

}  // namespace alea
