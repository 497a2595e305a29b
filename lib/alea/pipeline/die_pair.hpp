#pragma once

#include <vector>

#include "alea/pipeline/die_orientations.hpp"
#include "alea/pipeline/die_transform.hpp"

namespace alea {

/// One die in both scans.
struct DiePair {
  DieSighting master;
  DieSighting slave;
  DieTransform transform;
  std::vector<DieOrientation> orientations;  ///< that were considered, the likeliest first
  bool resolved_by_scene = false;            ///< the pips left several of them
};

/// The plane regions that are not facets of the sighted die.
std::vector<PlaneRegion> scene_planes(const std::vector<PlaneRegion>& planes,
                                      const DieSighting& sighting);

/// Chooses the die that both scans mean. Where several pairs of sightings give a transform, the one
/// under which the rest of the scene agrees best; refused as ambiguous_target where another,
/// different transform does about as well. Where the pips leave several orientations of a die,
/// `resolve_by_scene` lets the scene choose among them too; without it they are refused.
Result<DiePair> choose_die_pair(const Cloud& master, const ScanSighting& master_sighting,
                                const Cloud& slave, const ScanSighting& slave_sighting,
                                const DieRegistrationOptions& options);

}  // namespace alea
