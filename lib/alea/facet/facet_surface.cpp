#include "alea/facet/facet_surface.hpp"

#include "alea/facet/facet_neighbourhood.hpp"

namespace alea {

std::array<std::vector<std::uint32_t>, 3> facet_surface(const Cloud& cloud, const FacetFits& facets,
                                                        const FacetFitOptions& options,
                                                        double depth_m) {
  FacetSelection selection;
  const auto& scanner = options.fit.scanner_position;
  selection.domain = scanner ? SelectionDomain::ray : SelectionDomain::coordinate;
  selection.scanner_position = scanner.value_or(Eigen::Vector3d::Zero());
  selection.trim_m = facets.trim_m;
  selection.gate_m.fill(depth_m);
  for (int k = 0; k < 3; ++k) selection.lengths_m[k] = facets.extents[k].border_m;
  const FacetNeighbourhood about = points_about(cloud, facets.corner, selection.lengths_m, depth_m);
  const FacetMembers members = select_facet_points(about.points, facets.corner, selection);
  std::array<std::vector<std::uint32_t>, 3> out;
  for (int k = 0; k < 3; ++k)
    for (const std::uint32_t i : members[k]) out[k].push_back(about.indices[i]);
  return out;
}

}  // namespace alea
