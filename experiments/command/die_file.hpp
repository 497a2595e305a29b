#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "alea/die/adjustment.hpp"
#include "alea/die/shape_prior.hpp"

namespace alea::command {

/// A die's shape as a file has it.
struct GivenShape {
  DieShape shape;
  /// Of its departures about the given planes (see ShapePrior); empty where the file has none: then
  /// the shape is exact. Zero in rows that the file leaves open.
  std::optional<ShapeMatrix> covariance;
};

/// Reads a die's shape: a DIE.json, or a file that holds it as its `die` (truth.json of `alea
/// simulate`). `planes` has "1" to "6" with `normal` and `offset_m` in one die frame, null for a
/// facet that was never seen. An offset may be null where a calibration left the die's length along
/// that axis open: it is then set to that of the known facets, or to `half_edge_m`. `covariance`,
/// where given, is 18 x 18 with null for what is not known.
/// Throws Error(input) naming file and entry.
GivenShape read_die_file(const std::string& path, double half_edge_m = 0.25);

/// The DIE.json of a calibration.
nlohmann::json die_json(const DieAdjustment& adjusted, Chirality hand);

/// Parses a JSON file. Throws Error(input) naming the file and what its contents should be.
nlohmann::json read_json_file(const std::string& path, const std::string& expectation);

}  // namespace alea::command
