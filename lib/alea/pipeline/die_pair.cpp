#include "alea/pipeline/die_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

#include "alea/evaluate/check_planes.hpp"
#include "alea/pipeline/scene_conflict.hpp"

namespace alea {
namespace {

constexpr double same_rotation_rad = 0.02, same_translation_m = 0.05;
constexpr double clear_lead = 1.25;  // the best pair's common points over the next different pair's
// Mixed pixels and outlines give the true transform a little conflict; another shows more, and one
// that shows a lot is out whatever its common points.
constexpr double conflict_factor = 3, conflict_allowance = 0.005, plain_conflict = 0.1;

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

/// A pair of sightings in one orientation, while the scene has not decided.
struct Scored {
  DiePair pair;
  std::size_t orientation = 0;
  std::optional<Refusal> refusal;  ///< the die does not determine a transform in it
  double score = 0;                ///< points on planes that both scans see
  double conflict = 0;             ///< scene_conflicts
};

Refusal scene_undecided(bool orientations, bool scanners_known) {
  const std::string advice = scanners_known ? "" : "give --master-origin and --slave-origin, ";
  return {RefusalCode::ambiguous_target,
          orientations
              ? "the pips leave several orientations of the die and nothing in the rest of "
                "the scene contradicts all but one; " +
                    advice + "scan more of the surroundings, or a die with readable pips"
              : "several dice fit in both scans and the rest of the scene does not tell "
                "which is which; " +
                    advice + "give --near X,Y,Z or scan one die only"};
}

/// Whether the scene contradicts `a` more than `b`.
bool contradicted(const Scored& a, const Scored& b, double allowance) {
  return a.conflict > conflict_factor * b.conflict + allowance;
}

/// The candidate with most common points, if the scene contradicts every other one more. Fewer
/// common points alone contradict no orientation, for the scans may share little; of several dice
/// the pair with clearly more wins.
Result<DiePair> best_by_scene(std::vector<Scored> candidates, bool scanners_known) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Scored& a, const Scored& b) { return a.score > b.score; });
  const Scored& least =
      *std::min_element(candidates.begin(), candidates.end(),
                        [](const Scored& a, const Scored& b) { return a.conflict < b.conflict; });
  const auto best = std::find_if(
      candidates.begin(), candidates.end(),
      [&](const Scored& candidate) { return !contradicted(candidate, least, plain_conflict); });
  const bool orientations = best->pair.resolved_by_scene;
  for (const Scored& rival : candidates) {
    if (same_transform(best->pair.transform, rival.pair.transform)) continue;
    if (contradicted(rival, *best, conflict_allowance)) continue;
    const bool clear = !orientations && best->score > clear_lead * rival.score;
    if (!clear || contradicted(*best, rival, conflict_allowance))
      return scene_undecided(orientations, scanners_known);
  }
  if (best->refusal) return *best->refusal;
  // What the scene said of the other orientations of the chosen pair.
  DiePair chosen = best->pair;
  for (const Scored& each : candidates)
    if (each.pair.master.candidate == chosen.master.candidate &&
        each.pair.slave.candidate == chosen.slave.candidate)
      chosen.orientations[each.orientation].scene_points = each.score;
  return chosen;
}

void ask_scene(const Cloud& master, const ScanSighting& master_sighting, const Cloud& slave,
               const ScanSighting& slave_sighting, std::vector<Scored>& candidates) {
  std::vector<RigidTransform> transforms;
  for (Scored& candidate : candidates) {
    transforms.push_back(candidate.pair.transform.master_from_slave);
    candidate.score = scene_agreement(
        master, scene_planes(master_sighting.planes, candidate.pair.master), slave,
        scene_planes(slave_sighting.planes, candidate.pair.slave), transforms.back());
  }
  if (!master.scanner_position || !slave.scanner_position) return;
  const std::vector<double> conflicts = scene_conflicts(master, slave, transforms);
  for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i].conflict = conflicts[i];
}

Refusal undecided(const DieSighting& master, const DieSighting& slave, std::size_t supported,
                  bool levelled) {
  if (supported == 0)
    return {RefusalCode::pips_ambiguous,
            "no orientation of the die that its pips support keeps the scanners level; leave "
            "--levelled out"};
  const std::string remaining =
      fmt::format("{} orientations of the die remain{}; --resolve scene asks the rest of the scene",
                  supported, levelled ? " for levelled scanners" : "");
  if (master.reading.blank || slave.reading.blank)
    return {
        RefusalCode::pips_unreadable,
        "the facets carry no readable pips: a blank cube, or too few points on it; " + remaining};
  return {RefusalCode::pips_ambiguous, "several readings explain the pips about as well; " +
                                           remaining + ", or scan from nearer or denser"};
}

/// The pair in one orientation, with the transform that the die gives or, where it gives none, the
/// rough one of a cube.
Scored in_orientation(const DieSighting& master, const DieSighting& slave,
                      const std::vector<DieOrientation>& orientations, std::size_t k,
                      const DieRegistrationOptions& options) {
  const DieOrientation& orientation = orientations[k];
  Scored out;
  out.orientation = k;
  const auto with = [](const DieSighting& sighting, const std::array<int, 3>& pips) {
    return pips == sighting.reading.pips ? sighting : relabelled(sighting, pips);
  };
  out.pair.master = with(master, orientation.master_pips);
  out.pair.slave = with(slave, orientation.slave_pips);
  out.pair.orientations = orientations;
  Result<DieTransform> transform = transform_by_die(out.pair.master, out.pair.slave, options);
  if (transform) {
    out.pair.transform = *std::move(transform);
  } else {
    out.refusal = transform.refusal();
    out.pair.transform.master_from_slave = orientation.master_from_slave;
    out.pair.transform.centre_m = master.die.facets[0].fit.centroid_m;
  }
  return out;
}

/// The orientations of one pair of sightings that are left: one, or several for the scene.
Result<std::vector<Scored>> orient(const DieSighting& master, const DieSighting& slave,
                                   const DieRegistrationOptions& options) {
  const std::vector<DieOrientation> all = die_orientations(master, slave, options.levelled);
  const std::size_t supported = supported_orientations(all);
  // Readings of different hands have no orientation in common: the hand is refused further on.
  if (supported == 0 && !options.levelled) {
    const Result<DieTransform> transform = transform_by_die(master, slave, options);
    if (!transform) return transform.refusal();
    return std::vector<Scored>{{{master, slave, *transform, {}}, 0, std::nullopt, 0, 0}};
  }
  if (supported == 0 || (supported > 1 && !options.resolve_by_scene))
    return undecided(master, slave, supported, options.levelled);
  std::vector<Scored> out;
  for (std::size_t k = 0; k < supported; ++k) {
    out.push_back(in_orientation(master, slave, all, k, options));
    out.back().pair.resolved_by_scene = supported > 1;
  }
  if (supported == 1 && out[0].refusal) return *out[0].refusal;
  return out;
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
      Result<std::vector<Scored>> oriented = orient(a, b, options);
      if (oriented)
        std::move(oriented->begin(), oriented->end(), std::back_inserter(candidates));
      else if (!first_refusal)
        first_refusal = oriented.refusal();
    }
  }
  if (candidates.empty()) return *first_refusal;
  if (candidates.size() == 1) return std::move(candidates[0].pair);
  ask_scene(master, master_sighting, slave, slave_sighting, candidates);
  return best_by_scene(std::move(candidates), master.scanner_position && slave.scanner_position);
}

}  // namespace alea
