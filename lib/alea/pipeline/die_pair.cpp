#include "alea/pipeline/die_pair.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "alea/evaluate/check_planes.hpp"

namespace alea {
namespace {

constexpr double same_rotation_rad = 0.02, same_translation_m = 0.05;
constexpr double clear_lead = 1.25;  // the best pair's common points over the next different pair's

bool same_transform(const DieTransform& a, const DieTransform& b) {
  const RigidTransform change = a.master_from_slave * b.master_from_slave.inverse();
  const Eigen::Vector3d moved =
      a.centre_m - (b.master_from_slave * a.master_from_slave.inverse()) * a.centre_m;
  return rotation_angle_rad(change.rotation) < same_rotation_rad &&
         moved.norm() < same_translation_m;
}

double scene_agreement(const Cloud& master, const std::vector<PlaneRegion>& master_planes,
                       const Cloud& slave, const std::vector<PlaneRegion>& slave_planes,
                       const RigidTransform& master_from_slave) {
  double points = 0;
  for (const CommonPlane& plane :
       find_common_planes(master, master_planes, slave, slave_planes, master_from_slave,
                          {.max_angle_rad = 0.035, .max_offset_m = 0.03}))
    points +=
        static_cast<double>(std::min(plane.indices_master.size(), plane.indices_slave.size()));
  return points;
}

struct Scored {
  DiePair pair;
  double score = 0;
};

Result<DiePair> best_by_scene(std::vector<Scored> candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Scored& a, const Scored& b) { return a.score > b.score; });
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    if (same_transform(candidates[0].pair.transform, candidates[i].pair.transform)) continue;
    if (candidates[0].score > clear_lead * candidates[i].score) break;
    return Refusal{RefusalCode::ambiguous_target,
                   "several dice fit in both scans and the rest of the scene does not tell which "
                   "is which; give --near "
                   "X,Y,Z or scan one die only"};
  }
  return std::move(candidates[0].pair);
}

}  // namespace

std::vector<PlaneRegion> scene_planes(const std::vector<PlaneRegion>& planes,
                                      const DieSighting& sighting) {
  // A facet may have come apart into several regions, so what lies on a facet is the die's as well.
  const auto on_the_die = [&](const PlaneRegion& region) {
    return std::any_of(
        sighting.die.facets.begin(), sighting.die.facets.end(), [&](const ObservedFacet& facet) {
          const bool parallel = std::abs(region.plane.normal.dot(facet.fit.plane.normal)) > 0.97;
          const bool level = std::abs(facet.fit.plane.signed_distance(region.centroid_m)) < 0.03;
          const double reach_m =
              0.7 * *std::max_element(sighting.edges_m.begin(), sighting.edges_m.end());
          return parallel && level && (region.centroid_m - facet.fit.centroid_m).norm() < reach_m;
        });
  };
  std::vector<PlaneRegion> scene;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const bool is_facet =
        std::find(sighting.regions.begin(), sighting.regions.end(), i) != sighting.regions.end();
    if (!is_facet && !on_the_die(planes[i])) scene.push_back(planes[i]);
  }
  return scene;
}

Result<DiePair> choose_die_pair(const Cloud& master, const ScanSighting& master_sighting,
                                const Cloud& slave, const ScanSighting& slave_sighting,
                                const DieRegistrationOptions& options) {
  std::vector<Scored> candidates;
  std::optional<Refusal> first_refusal;
  for (const DieSighting& a : master_sighting.dice) {
    for (const DieSighting& b : slave_sighting.dice) {
      Result<DieTransform> transform = transform_by_die(a, b, options);
      if (transform)
        candidates.push_back({{a, b, *std::move(transform)}, 0});
      else if (!first_refusal)
        first_refusal = transform.refusal();
    }
  }
  if (candidates.empty()) return *first_refusal;
  if (candidates.size() == 1) return std::move(candidates[0].pair);
  for (Scored& candidate : candidates)
    candidate.score =
        scene_agreement(master, scene_planes(master_sighting.planes, candidate.pair.master), slave,
                        scene_planes(slave_sighting.planes, candidate.pair.slave),
                        candidate.pair.transform.master_from_slave);
  return best_by_scene(std::move(candidates));
}

}  // namespace alea
