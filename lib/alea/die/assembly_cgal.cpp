#include <CGAL/intersections.h>
#include <CGAL/number_utils.h>

#include "alea/cgal/kernels.hpp"
#include "alea/die/assembly.hpp"

namespace alea {
namespace {

using Number = Exact::FT;

std::optional<Exact::Point_3> common_point(const std::array<Exact::Plane_3, 3>& planes) {
  const auto meet = CGAL::intersection(planes[0], planes[1], planes[2]);
  if (!meet) return std::nullopt;
  const Exact::Point_3* point = alternative<Exact::Point_3>(*meet);
  return point != nullptr ? std::optional(*point) : std::nullopt;
}

double half_width(const Number& number) {
  const auto [lower, upper] = CGAL::to_interval(number.exact());
  return (upper - lower) / 2;
}

}  // namespace

std::optional<CornerAssembly> assemble_corner(const std::array<Plane, 3>& planes) {
  const std::array<Exact::Plane_3, 3> exact{to_exact(planes[0]), to_exact(planes[1]),
                                            to_exact(planes[2])};
  const auto corner = common_point(exact);
  if (!corner) return std::nullopt;
  CornerAssembly out;
  out.corner_m = to_double(*corner);
  out.corner_rounding_m = {half_width(corner->x()), half_width(corner->y()),
                           half_width(corner->z())};
  out.corner_on_planes = true;
  for (int k = 0; k < 3; ++k) {
    out.corner_on_planes = out.corner_on_planes && exact[k].has_on(*corner);
    const auto direction = CGAL::cross_product(exact[(k + 1) % 3].orthogonal_vector(),
                                               exact[(k + 2) % 3].orthogonal_vector());
    const Eigen::Vector3d rounded(CGAL::to_double(direction.x().exact()),
                                  CGAL::to_double(direction.y().exact()),
                                  CGAL::to_double(direction.z().exact()));
    out.edges[k] = {out.corner_m, rounded.normalized()};
  }
  out.orientation = static_cast<int>(CGAL::orientation(
      exact[0].orthogonal_vector(), exact[1].orthogonal_vector(), exact[2].orthogonal_vector()));
  return out;
}

}  // namespace alea
