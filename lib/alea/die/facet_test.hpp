#pragma once

#include <vector>

#include "alea/die/adjustment_model.hpp"

namespace alea {

/// Upper tail of the chi-square distribution.
double chi_square_tail(double statistic, double freedom);

/// Tests every facet and every plane of the scene against the rest (data snooping). Where several
/// cannot be told apart by the data, all of them are suspect together. `alarm_level`: chance of any
/// false alarm.
std::vector<FacetTest> test_facets(const LinearisedAdjustment& linearised,
                                   const Eigen::MatrixXd& covariance, double alarm_level);

/// Squared misclosures over what was assumed, for each group of observations that has redundancy.
std::vector<VarianceComponent> variance_components(const LinearisedAdjustment& linearised,
                                                   const Eigen::MatrixXd& covariance);

/// How many independent numbers an observation holds.
int rank_of(const AdjustmentObservation& observation);

}  // namespace alea
