#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <optional>

#include "alea/cgal/kernels.hpp"
#include "alea/core/error.hpp"
#include "experiments/exactness/kernel_chain.hpp"

namespace alea::experiments::exactness {
namespace {

template <typename Kernel>
struct Chain {
  using PlaneK = typename Kernel::Plane_3;
  using PointK = typename Kernel::Point_3;
  using VectorK = typename Kernel::Vector_3;

  static PlaneK plane_of(const Plane& plane) {
    return {plane.normal.x(), plane.normal.y(), plane.normal.z(), -plane.offset_m};
  }

  static std::optional<PointK> meet(const PlaneK& a, const PlaneK& b, const PlaneK& c) {
    const auto found = CGAL::intersection(a, b, c);
    if (!found) return std::nullopt;
    const PointK* const point = alternative<PointK>(*found);
    return point == nullptr ? std::nullopt : std::optional<PointK>(*point);
  }

  static bool inside(const PlaneK& plane, const PointK& point) {
    return plane.oriented_side(point) == CGAL::ON_NEGATIVE_SIDE;
  }

  static Eigen::Vector3d rounded(const VectorK& v) {
    return {CGAL::to_double(v.x()), CGAL::to_double(v.y()), CGAL::to_double(v.z())};
  }

  static CornerDecisions decide(const CornerPlanes& planes) {
    const std::array<PlaneK, 3> facets{plane_of(planes.facets[0]), plane_of(planes.facets[1]),
                                       plane_of(planes.facets[2])};
    const PlaneK cap = plane_of(planes.cap);
    CornerDecisions out;
    const VectorK n0 = facets[0].orthogonal_vector(), n1 = facets[1].orthogonal_vector(),
                  n2 = facets[2].orthogonal_vector();
    out.orientation = CGAL::orientation(n0, n1, n2) == CGAL::POSITIVE;
    const auto corner = meet(facets[0], facets[1], facets[2]);
    if (!corner) return out;
    out.on_planes =
        facets[0].has_on(*corner) && facets[1].has_on(*corner) && facets[2].has_on(*corner);
    out.corner_m = {CGAL::to_double(corner->x()), CGAL::to_double(corner->y()),
                    CGAL::to_double(corner->z())};
    const Eigen::Vector3d edge = rounded(CGAL::cross_product(n0, n1)).normalized();
    const Eigen::Vector3d normal = rounded(n0).normalized();
    out.axes << edge, normal, edge.cross(normal);
    out.adjacency = inside(cap, *corner);
    const auto p0 = meet(facets[1], facets[2], cap), p1 = meet(facets[2], facets[0], cap),
               p2 = meet(facets[0], facets[1], cap);
    if (!p0 || !p1 || !p2) return out;
    out.chirality = CGAL::orientation(*corner, *p0, *p1, *p2) == CGAL::POSITIVE;
    out.closure =
        out.adjacency && inside(facets[0], *p0) && inside(facets[1], *p1) && inside(facets[2], *p2);
    return out;
  }
};

}  // namespace

CornerDecisions decide_by(const std::string& kernel, const CornerPlanes& planes) {
  if (kernel == "double") return Chain<CGAL::Simple_cartesian<double>>::decide(planes);
  if (kernel == "epick") return Chain<Data>::decide(planes);
  if (kernel == "epeck") return Chain<Exact>::decide(planes);
  throw usage_error("no kernel '" + kernel + "'; use double, epick or epeck");
}

}  // namespace alea::experiments::exactness
