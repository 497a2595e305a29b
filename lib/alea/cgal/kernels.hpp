#pragma once

// For *_cgal.cpp files only: these headers cost seconds to compile.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include <Eigen/Core>
#if CGAL_VERSION_NR >= 1060000000
#include <variant>
#else
#include <boost/variant.hpp>
#endif

#include "alea/core/plane.hpp"

namespace alea {

using Data = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

/// The doubles of a plane taken as exact numbers: a x + b y + c z + d = 0 with d = -offset_m.
inline Exact::Plane_3 to_exact(const Plane& plane) {
  return {plane.normal.x(), plane.normal.y(), plane.normal.z(), -plane.offset_m};
}

/// The nearest doubles of an exact point (metres).
inline Eigen::Vector3d to_double(const Exact::Point_3& p) {
  return {CGAL::to_double(p.x().exact()), CGAL::to_double(p.y().exact()),
          CGAL::to_double(p.z().exact())};
}

/// The alternative of type T that an intersection holds, or null. CGAL 5 returns boost::variant,
/// CGAL 6 std::variant.
template <typename T, typename Variant>
const T* alternative(const Variant& variant) {
#if CGAL_VERSION_NR >= 1060000000
  return std::get_if<T>(&variant);
#else
  return boost::get<T>(&variant);
#endif
}

}  // namespace alea
