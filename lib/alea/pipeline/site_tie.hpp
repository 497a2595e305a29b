#pragma once

#include <optional>
#include <string>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/pipeline/registration.hpp"

namespace alea {

/// A target or point with its name and, where somebody knows it, its standard deviation in each
/// coordinate.
struct NamedPoint {
  std::string name;
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  std::optional<double> sd_m;
};

/// Ties the master frame to a site's system by points that both lists name: Horn's closed form on
/// weights from the standard deviations, rigid (no scale). Where every point of both lists has a
/// standard deviation the covariance is theirs; else all weigh the same and the residuals say how
/// large the errors are. The covariance refers to the mean of the site's points.
/// Refusals: `too_few_points` for fewer than three common names, `collinear` where they lie on a
/// line. Throws Error(input) for a name that occurs twice in one list.
Result<SiteTie> tie_to_site(const std::vector<NamedPoint>& site,
                            const std::vector<NamedPoint>& measured);

}  // namespace alea
