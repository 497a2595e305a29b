#include "alea/die/paper_registration.hpp"

#include <fmt/format.h>

namespace alea {
namespace {

OrthogonalFrame orthogonal_frame(const CornerFrame& frame,
                                 const PaperRegistrationOptions& options) {
  return {frame.label, frame.corner_m,
          options.errors.left_handed_axes ? orthogonal_axes_as_printed(frame)
                                          : orthogonal_axes(frame, options.rule)};
}

/// The translation is linear in the dimensions, so a step of one metre gives its derivative.
Eigen::Matrix<double, 3, 4> translation_by_dimensions(const PaperRegistration& registration,
                                                      const PaperRegistrationOptions& options) {
  Eigen::Matrix<double, 3, 4> derivative;
  for (int k = 0; k < 4; ++k) {
    DieDimensions longer = options.dimensions;
    double* const lengths[] = {&longer.from_1_to_6_m, &longer.from_2_to_5_m, &longer.from_3_to_4_m,
                               &longer.lift_m};
    *lengths[k] += 1;
    const ConjugatePoints points =
        conjugate_points(registration.v, registration.u, longer, options.errors);
    derivative.col(k) = register_conjugate(points, options.errors).translation -
                        registration.master_from_slave.translation;
  }
  return derivative;
}

/// The upper facets of master and slave: one and the same where the scans share any.
std::pair<int, int> upper_facets(const ObservedDie& master, const ObservedDie& slave,
                                 const std::optional<int>& asked) {
  if (asked) return {*asked, *asked};
  const int up = upper_pips(master, slave);
  return {up, find_facet(slave, up) != nullptr ? up : opposite_pips(up)};
}

}  // namespace

Result<PaperRegistration> register_paper(const ObservedDie& master, const ObservedDie& slave,
                                         const PaperRegistrationOptions& options) {
  if (auto refusal = check_pair(master, slave, options.hand)) return *refusal;
  const auto [master_up, slave_up] = upper_facets(master, slave, options.up_pips);
  if (find_facet(master, master_up) == nullptr || find_facet(slave, slave_up) == nullptr)
    return Refusal{
        RefusalCode::unobservable,
        fmt::format("the upper facet {} is not seen in both scans; name one that is", master_up)};
  PaperRegistration result;
  result.shared = shared_pips(master, slave);
  result.master_frame = corner_frame(master, master_up).value();
  result.slave_frame = corner_frame(slave, slave_up).value();
  result.v = orthogonal_frame(result.master_frame, options);  // Equations (1) to (3)
  result.u = orthogonal_frame(result.slave_frame, options);
  result.v_from_u = v_from_u(result.v.label, result.u.label, options.dimensions, options.errors);
  result.points = conjugate_points(result.v, result.u, options.dimensions, options.errors);
  result.master_from_slave = register_conjugate(result.points, options.errors);
  result.translation_by_dimensions = translation_by_dimensions(result, options);
  return result;
}

}  // namespace alea
