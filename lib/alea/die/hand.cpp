#include "alea/die/hand.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "alea/core/error.hpp"
#include "alea/plane/exact_predicates.hpp"

namespace alea {
namespace {

constexpr double largest_skew_deg = 20;

/// From the normals of any three facets that meet at a corner.
std::optional<Chirality> hand_of_normals(const std::array<int, 3>& pips,
                                         const std::array<Eigen::Vector3d, 3>& normals) {
  // Sorted by axis and turned to the sides of 1, 2, 3, the normals run clockwise seen from outside
  // exactly where their determinant is negative.
  std::array<Eigen::Vector3d, 3> by_axis;
  int sign = 1;
  for (int k = 0; k < 3; ++k) {
    by_axis[die_axis(pips[k])] = normals[k];
    sign *= axis_side(pips[k]);
  }
  const int orientation = sign * exact_orientation(by_axis[0], by_axis[1], by_axis[2]);
  if (orientation == 0) return std::nullopt;
  return orientation < 0 ? Chirality::clockwise : Chirality::counterclockwise;
}

std::optional<Refusal> check_dihedrals(const ObservedDie& die, const char* scan) {
  for (const DihedralAngle& dihedral : dihedral_angles(die)) {
    const double angle_deg = dihedral.angle_rad * 180 / std::numbers::pi;
    if (std::abs(angle_deg - 90) > largest_skew_deg)
      return Refusal{RefusalCode::dihedral,
                     fmt::format("facets {} and {} of the {} scan meet at {:.1f} deg; a die's "
                                 "facets meet within {} deg of a right angle",
                                 dihedral.first_pips, dihedral.second_pips, scan, angle_deg,
                                 largest_skew_deg)};
  }
  return std::nullopt;
}

}  // namespace

bool labels_meet_at_a_corner(int first_pips, int second_pips, int third_pips) {
  std::array<int, 3> facets_on_axis{};
  for (const int pips : {first_pips, second_pips, third_pips}) {
    if (pips < 1 || pips > 6) return false;
    ++facets_on_axis[die_axis(pips)];
  }
  return facets_on_axis == std::array<int, 3>{1, 1, 1};
}

std::optional<Chirality> hand_of(const ObservedDie& die) {
  const auto& f = die.facets;
  if (!labels_meet_at_a_corner(f[0].pips, f[1].pips, f[2].pips))
    throw usage_error(fmt::format("facets with {}, {} and {} pips do not meet at a corner of a die",
                                  f[0].pips, f[1].pips, f[2].pips));
  return hand_of_normals({f[0].pips, f[1].pips, f[2].pips},
                         {f[0].fit.plane.normal, f[1].fit.plane.normal, f[2].fit.plane.normal});
}

std::optional<Chirality> hand_of(const DieShape& shape) {
  std::array<int, 3> pips{};
  std::array<Eigen::Vector3d, 3> normals;
  for (int axis = 0; axis < 3; ++axis) {
    const int near = axis + 1;
    pips[axis] = shape.facet(near) ? near : opposite_pips(near);
    if (!shape.facet(pips[axis])) return std::nullopt;
    normals[axis] = shape.facet(pips[axis])->normal;
  }
  return hand_of_normals(pips, normals);
}

std::optional<Refusal> check_pair(const ObservedDie& master, const ObservedDie& slave,
                                  HandRule rule) {
  if (auto refusal = check_dihedrals(master, "master")) return refusal;
  if (auto refusal = check_dihedrals(slave, "slave")) return refusal;
  // Within 20 deg of right angles the normals never lie in one plane.
  const Chirality in_master = hand_of(master).value(), in_slave = hand_of(slave).value();
  if (in_master != in_slave)
    return Refusal{
        RefusalCode::mirrored,
        fmt::format("the die is {} in the master and {} in the slave; a facet is misread "
                    "or a scan is mirrored",
                    to_string(in_master), to_string(in_slave))};
  const bool accepted =
      rule == HandRule::any || (rule == HandRule::clockwise) == (in_master == Chirality::clockwise);
  if (!accepted)
    return Refusal{RefusalCode::chirality,
                   fmt::format("the die is {} in both scans; say --chirality {} if that is right",
                               to_string(in_master), to_string(in_master))};
  return std::nullopt;
}

}  // namespace alea
