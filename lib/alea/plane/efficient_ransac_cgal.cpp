#include <CGAL/Random.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/property_map.h>

#include <cmath>
#include <tuple>

#include "alea/cgal/kernels.hpp"
#include "alea/plane/canonical_points.hpp"
#include "alea/plane/detectors.hpp"
#include "alea/plane/region_refit.hpp"

namespace alea {
namespace {

// CGAL reorders its input, so each point carries its place.
using Sample = std::tuple<Data::Point_3, Data::Vector_3, std::uint32_t>;
using Samples = std::vector<Sample>;
using Traits =
    CGAL::Shape_detection::Efficient_RANSAC_traits<Data, Samples,
                                                   CGAL::Nth_of_tuple_property_map<0, Sample>,
                                                   CGAL::Nth_of_tuple_property_map<1, Sample>>;
using Ransac = CGAL::Shape_detection::Efficient_RANSAC<Traits>;

Samples samples_of(const CanonicalPoints& points, std::size_t neighbours) {
  const std::vector<Eigen::Vector3d> normals = point_normals(points.positions, neighbours);
  Samples samples;
  samples.reserve(points.positions.size());
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const Eigen::Vector3d& p = points.positions[i];
    const Eigen::Vector3d& n = normals[i];
    samples.emplace_back(Data::Point_3(p.x(), p.y(), p.z()), Data::Vector_3(n.x(), n.y(), n.z()),
                         points.index[i]);
  }
  return samples;
}

}  // namespace

std::vector<PlaneRegion> detect_by_efficient_ransac(const Cloud& cloud,
                                                    const PlaneDetectionOptions& options) {
  const CanonicalPoints points = canonical_points(cloud, options.tolerance_m);
  if (points.positions.size() < options.min_points) return {};
  Samples samples = samples_of(points, options.neighbours);
  Ransac::Parameters parameters;
  parameters.probability = options.miss_probability;
  parameters.min_points = options.min_points;
  // Points within three epsilon are given to a shape in the end.
  parameters.epsilon = options.tolerance_m / 3 * points.per_unit;
  parameters.cluster_epsilon = connection_length_m(cloud, options, 16) * points.per_unit;
  parameters.normal_threshold = std::cos(options.normal_angle_rad);

  Ransac ransac;
  ransac.set_input(samples);
  ransac.add_shape_factory<CGAL::Shape_detection::Plane<Traits>>();
  // The generator belongs to the thread and is otherwise seeded by the clock.
  CGAL::get_default_random() = CGAL::Random(static_cast<unsigned>(options.seed));
  ransac.detect(parameters);

  std::vector<std::int32_t> plane_of_point(cloud.size(), -1);
  std::int32_t planes = 0;
  for (const auto& shape : ransac.shapes()) {
    for (const std::size_t i : shape->indices_of_assigned_points())
      plane_of_point[std::get<2>(samples[i])] = planes;
    ++planes;
  }
  return refitted_regions(cloud, std::move(plane_of_point), static_cast<std::size_t>(planes),
                          options);
}

}  // namespace alea
