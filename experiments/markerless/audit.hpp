#pragma once

#include "alea/core/rigid_transform.hpp"
#include "experiments/engine/result_table.hpp"
#include "experiments/markerless/published.hpp"

namespace alea::experiments::markerless {

/// How the printed angles and translations may be meant.
enum class Convention { equation_3, transposed, reversed_order, reversed_transposed };

RigidTransform published_pose(const PublishedPair& pair, Convention convention);

/// A pair that is printed in both directions, and what forward times reverse leaves of the
/// identity.
struct Misclosure {
  std::string pair;
  double rotation_deg = 0, translation_m = 0;
};
std::vector<Misclosure> misclosures(const std::vector<PublishedPair>& table, Convention convention);

/// The published tables against themselves and against the text: averages, closures, grid counts,
/// correlations, equations, captions. No simulation; every number from the printed ones.
ResultTable audit_published(const PublishedTables& tables);

}  // namespace alea::experiments::markerless
