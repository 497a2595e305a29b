#include "alea/die/corner_frame.hpp"

#include <fmt/format.h>

#include "alea/core/error.hpp"
#include "alea/die/assembly.hpp"
#include "alea/die/hand.hpp"
#include "alea/plane/exact_predicates.hpp"

namespace alea {
namespace {

std::string edge_name(int a, int b) {
  return fmt::format("{}x{}", std::min(a, b), std::max(a, b));
}

/// Turned to the side where its scalar product with `towards` is positive, decided exactly.
Eigen::Vector3d pointing(const Eigen::Vector3d& direction, const Eigen::Vector3d& towards) {
  return exact_sign_of_dot(direction, towards) < 0 ? Eigen::Vector3d(-direction) : direction;
}

struct Roles {
  int up, x_side, y_side;  ///< indices into the observed facets
};

/// X = -n(y_side) and Y = -n(x_side) on a cube, so X, Y, up is right-handed where
/// det(n(up), n(y_side), n(x_side)) is positive.
std::optional<Roles> decide_roles(const std::array<Plane, 3>& planes, int up) {
  const int a = (up + 1) % 3, b = (up + 2) % 3;
  const int sign = exact_orientation(planes[up].normal, planes[a].normal, planes[b].normal);
  if (sign == 0) return std::nullopt;
  return sign > 0 ? Roles{up, b, a} : Roles{up, a, b};
}

}  // namespace

std::string axis_names(const FrameLabel& label) {
  return edge_name(label.up, label.x_side) + " " + edge_name(label.up, label.y_side) + " " +
         edge_name(label.x_side, label.y_side);
}

std::vector<FrameLabel> all_frame_labels(Chirality chirality) {
  std::vector<FrameLabel> labels;
  for (const int first : {1, 6})
    for (const int second : {2, 5})
      for (const int third : {3, 4}) {
        const std::array<int, 3> pips{first, second, third};
        const int sides = axis_side(first) * axis_side(second) * axis_side(third);
        // Seen from outside, the facets of axes 0, 1, 2 run clockwise at this corner or not.
        const bool clockwise = (sides > 0) == (chirality == Chirality::clockwise);
        for (int k = 0; k < 3; ++k) {
          const int next = pips[(k + 1) % 3], last = pips[(k + 2) % 3];
          labels.push_back(clockwise ? FrameLabel{pips[k], next, last}
                                     : FrameLabel{pips[k], last, next});
        }
      }
  return labels;
}

std::optional<CornerFrame> corner_frame(const ObservedDie& die, int up_pips) {
  if (!hand_of(die)) return std::nullopt;
  int up = -1;
  for (int k = 0; k < 3; ++k)
    if (die.facets[k].pips == up_pips) up = k;
  if (up < 0)
    throw usage_error(fmt::format("corner frame: the die does not show the facet {}", up_pips));
  const auto planes = planes_of(die);
  const auto assembly = assemble_corner(planes);
  const auto roles = decide_roles(planes, up);
  if (!assembly || !roles) return std::nullopt;

  const Eigen::Vector3d &n_up = planes[roles->up].normal, &n_x = planes[roles->x_side].normal,
                        &n_y = planes[roles->y_side].normal;
  CornerFrame frame;
  frame.label = {up_pips, die.facets[roles->x_side].pips, die.facets[roles->y_side].pips};
  frame.corner_m = assembly->corner_m;
  // An edge is named in the assembly by the facet that it does not lie in.
  frame.axes.col(0) = pointing(assembly->edges[roles->y_side].direction, -n_y);
  frame.axes.col(1) = pointing(assembly->edges[roles->x_side].direction, -n_x);
  frame.axes.col(2) = pointing(assembly->edges[roles->up].direction, n_up);
  frame.normals << -n_y, -n_x, n_up;
  return frame;
}

int upper_pips(const ObservedDie& master, const ObservedDie& slave) {
  int best = 0;
  double best_height = -3;
  for (const bool shared_only : {true, false}) {
    for (const ObservedFacet& facet : master.facets) {
      const ObservedFacet* const other = find_facet(slave, facet.pips);
      if (shared_only && other == nullptr) continue;
      const double height =
          facet.fit.plane.normal.z() + (other != nullptr ? other->fit.plane.normal.z() : 0.0);
      if (height <= best_height) continue;
      best = facet.pips;
      best_height = height;
    }
    if (best != 0) break;
  }
  return best;
}

}  // namespace alea
