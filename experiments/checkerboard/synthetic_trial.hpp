#pragma once

#include <cstdint>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/rigid_transform.hpp"

namespace alea::experiments::checkerboard {

/// What the template is matched against. Lengths are in sides of the board.
enum class Target {
  identical,    ///< the template's own points, moved: as published
  independent,  ///< as many points at random places on the same board
  white_wall,   ///< independent, in 2.4 sides of a surface as light as the light cells
  grey_wall     ///< independent, in 2.4 sides of a surface half as light
};
const char* to_string(Target target);

enum class Method { coloured, point_to_plane, point_to_point, plane_then_coloured, likelihood };
const char* to_string(Method method);

/// One configuration of the synthetic experiment.
struct SyntheticCase {
  double shift = 0;         ///< of the board's centre, in its plane
  double rotation_rad = 0;  ///< out of the plane and, with a sign of its own, in the plane
  double noise = 0;         ///< standard deviation of each coordinate of the target
  Target target = Target::identical;
  int squares = 2;
  int points_along_side = 20;
  double max_distance = 1;  ///< of a pair
};

struct SyntheticPair {
  Cloud board;   ///< the template, about the origin
  Cloud target;  ///< with normals estimated from 30 neighbours
  RigidTransform target_from_board;
};

/// Random direction of the shift, random axis in the plane, random sign: the same key gives the
/// same pair, and cases that differ in the shift alone share their directions.
SyntheticPair make_pair(const SyntheticCase& synthetic, std::uint64_t seed, std::uint64_t trial);

struct SyntheticOutcome {
  double rmse = 0;            ///< of the template's points against where they belong
  double rmse_symmetric = 0;  ///< the better of this and the one after half a turn
  double score = 0;           ///< colour score
  bool strict = false;        ///< rmse below 15 % and score above one half
  bool symmetric = false;     ///< the same with rmse_symmetric
};

/// Matches the template from the identity and judges the result by the truth.
SyntheticOutcome run_trial(const SyntheticCase& synthetic, Method method, std::uint64_t seed,
                           std::uint64_t trial);

/// Outcomes of trials 0 to n - 1, on all threads.
std::vector<SyntheticOutcome> run_trials(const SyntheticCase& synthetic, Method method,
                                         std::uint64_t seed, std::uint64_t trials);

}  // namespace alea::experiments::checkerboard
