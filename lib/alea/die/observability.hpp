#pragma once

#include <string>
#include <vector>

#include "alea/die/adjustment_model.hpp"

namespace alea {

/// What the observations leave open, in words, one for each open direction: first lengths of the
/// die, then angles between its facets, then poses of scans.
std::vector<std::string> name_open_directions(const AdjustmentProblem& problem,
                                              const AdjustmentLayout& layout,
                                              const AdjustmentState& state,
                                              const NormalSolution& solution);

/// Derivative of the distance between the two facets of an axis (0: 1-6, 1: 2-5, 2: 3-4) by the
/// unknowns; a zero row where a facet is not seen or both are exact.
Eigen::RowVectorXd length_by_unknowns(const AdjustmentLayout& layout, int axis);

/// Derivative of the angle between the normals of two facets, to the sign; zero for exact facets.
Eigen::RowVectorXd angle_by_unknowns(const AdjustmentLayout& layout,
                                     const std::array<DepartedFacet, 6>& facets, int first_pips,
                                     int second_pips);

}  // namespace alea
