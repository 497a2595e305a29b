#pragma once

#include <Eigen/Core>
#include <optional>

#include "alea/die/orthogonal_axes.hpp"
#include "experiments/die/twin_observation.hpp"

namespace alea::experiments::die {

/// A registration whose translation depends linearly on lengths of the die:
/// translation + translation_by_length * (length - nominal). The rotation does not depend on them.
struct LengthFamily {
  RigidTransform nominal;  ///< master_from_slave with the lengths on the box
  Eigen::Matrix<double, 3, Eigen::Dynamic> translation_by_length;

  RigidTransform at(const Eigen::VectorXd& change_m) const;
};

/// Which planes a length is calibrated on. The paper uses the ones that it then checks.
enum class CalibrationSet { check, independent };

/// Alea's closed form: along-ray fits, shared edge. One length, that of the edge.
std::optional<LengthFamily> closed_form_family(const Twin& twin, const TwinObservation& observed);

/// The paper with its printed errors corrected: orthogonal fits, equations 1 to 8, one axis fixed.
/// One length for all axes.
std::optional<LengthFamily> paper_family(const Twin& twin, const TwinObservation& observed,
                                         FrameRule rule);

/// The reading that comes nearest to the printed tables: a frame on the shared edge, planes that
/// lean towards each scanner by `bias_rad` (the top; sides by 0.35 of it), as borders that are not
/// trimmed make them, and two lengths: along the edge and the vertical l_z.
std::optional<LengthFamily> biased_family(const Twin& twin, const TwinObservation& observed,
                                          double bias_rad);

/// The change of the lengths that makes the sum of the planes' squared union RMSE least. Empty
/// where the planes do not determine it.
std::optional<Eigen::VectorXd> calibrate(const LengthFamily& family, const Twin& twin,
                                         const TwinObservation& observed, CalibrationSet set);

/// Horn's method on the centres of the spheres with these places in Twin::spheres. Empty where a
/// sphere could not be fitted.
std::optional<RigidTransform> sphere_registration(const TwinObservation& observed,
                                                  const std::vector<int>& which);

}  // namespace alea::experiments::die
