#pragma once

#include <vector>

#include "alea/checkerboard/board_plane.hpp"
#include "alea/checkerboard/board_search.hpp"
#include "alea/checkerboard/measurement.hpp"

namespace alea {

/// A plane of a crop with the best places of the board on it.
struct Sighting {
  BoardPoints points;  ///< of the plane
  BoardPlane plane;
  std::vector<Eigen::Vector2d> places;
  std::vector<BoardCandidate> candidates;
};

/// Up to four planes one after the other, each without the points of those before, of those that
/// have points enough for a gain that counts beside the best; best pattern first.
std::vector<Sighting> sightings(const BoardPoints& points, const BoardOptions& options,
                                const Eigen::Vector3d& facing);

}  // namespace alea
