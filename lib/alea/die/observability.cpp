#include "alea/die/observability.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

namespace alea {
namespace {

/// Collects combinations of unknowns until they account for every open direction.
class Namer {
 public:
  explicit Namer(const NormalSolution& solution) : solution_(solution) {}

  bool done() const { return static_cast<Eigen::Index>(names_.size()) == solution_.open.cols(); }

  /// Takes the name where the combination is open and says something new.
  void offer(const Eigen::RowVectorXd& combination, const std::string& name) {
    if (done() || combination.isZero(0) || is_determined(solution_, combination)) return;
    Eigen::RowVectorXd leak = combination * solution_.open;
    leak.normalize();
    for (const Eigen::RowVectorXd& before : named_) leak -= leak.dot(before) * before;
    if (leak.norm() < 1e-4) return;
    named_.push_back(leak.normalized());
    names_.push_back(name);
  }

  std::vector<std::string> names() const { return names_; }

 private:
  const NormalSolution& solution_;
  std::vector<Eigen::RowVectorXd> named_;  // orthonormal
  std::vector<std::string> names_;
};

}  // namespace

Eigen::RowVectorXd length_by_unknowns(const AdjustmentLayout& layout, int axis) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(layout.size);
  const int near = layout.facet[axis], far = layout.facet[opposite_pips(axis + 1) - 1];
  if (near >= 0 && far >= 0) row[near + 2] = row[far + 2] = 1;
  return row;
}

Eigen::RowVectorXd angle_by_unknowns(const AdjustmentLayout& layout,
                                     const std::array<DepartedFacet, 6>& facets, int first_pips,
                                     int second_pips) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(layout.size);
  for (const auto& [turned, other] :
       {std::pair{first_pips, second_pips}, std::pair{second_pips, first_pips}}) {
    const int column = layout.facet[turned - 1];
    if (column < 0) continue;
    const DepartedFacet& facet = facets[turned - 1];
    Eigen::RowVector3d by_abc = Eigen::RowVector3d::Zero();
    by_abc.head<2>() = facets[other - 1].fit.plane.normal.transpose() * facet.fit.tangent;
    row.segment<3>(column) = by_abc * facet.by_departure;
  }
  const double cosine =
      facets[first_pips - 1].fit.plane.normal.dot(facets[second_pips - 1].fit.plane.normal);
  return row / std::sqrt(1 - cosine * cosine);
}

std::vector<std::string> name_open_directions(const AdjustmentProblem& problem,
                                              const AdjustmentLayout& layout,
                                              const AdjustmentState& state,
                                              const NormalSolution& solution) {
  Namer namer(solution);
  for (int axis = 0; axis < 3; ++axis)
    namer.offer(length_by_unknowns(layout, axis),
                fmt::format("the die's length along {}-{} cannot be seen from these stations; "
                            "give --edge or a common plane",
                            axis + 1, opposite_pips(axis + 1)));
  const auto facets = departed_facets(problem.shape, state.departure);
  for (int first = 1; first <= 5; ++first)
    for (int second = first + 1; second <= 6; ++second)
      if (second != opposite_pips(first))
        namer.offer(angle_by_unknowns(layout, facets, first, second),
                    fmt::format("the angle between facets {} and {} cannot be seen from these "
                                "stations; give --die, --tilt-prior-deg or a common plane",
                                first, second));
  const char* const parts[] = {"rotation about x", "rotation about y", "rotation about z",
                               "shift along x",    "shift along y",    "shift along z"};
  for (std::size_t scan = 1; scan < problem.scans.size(); ++scan)
    for (int k = 0; k < 6; ++k) {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(layout.size);
      row[layout.scan(scan) + k] = 1;
      namer.offer(row, fmt::format("the {} of scan {} cannot be seen; give --die or a common plane",
                                   parts[k], scan + 1));
    }
  return namer.names();
}

}  // namespace alea
