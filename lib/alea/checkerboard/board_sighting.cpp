#include "alea/checkerboard/board_sighting.hpp"

#include <algorithm>
#include <cmath>

#include "alea/checkerboard/rough_plane.hpp"

namespace alea {
namespace {

std::vector<std::uint8_t> classes_by_otsu(const std::vector<float>& intensity) {
  const double threshold = otsu_threshold(intensity);
  std::vector<std::uint8_t> light(intensity.size());
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = intensity[i] > threshold;
  return light;
}

/// Points whose ray passes the plane within six standard deviations of their class.
BoardPoints near_plane(const BoardPoints& points, const BoardPlane& plane) {
  const double reach_m = 6 * std::max(plane.range_sd_m[0], plane.range_sd_m[1]);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const double off = std::abs(plane.plane.signed_distance(points.positions[i]));
    const double cosine =
        points.rays.empty() ? 1 : std::abs(plane.plane.normal.dot(points.rays[i]));
    if (off <= reach_m * std::max(cosine, 0.03)) kept.push_back(i);
  }
  return subset(points, kept);
}

/// Every k-th, about 2,000 at most: a plane to search on needs no more.
std::vector<std::uint32_t> thinned(const std::vector<std::uint32_t>& members) {
  const std::size_t stride = std::max<std::size_t>(1, members.size() / 1500);
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < members.size(); i += stride) some.push_back(members[i]);
  return some;
}

/// No candidates where the plane has too few points for the gain that counts.
Sighting sight(const BoardPoints& points, const RoughPlane& rough, const BoardOptions& options,
               const Eigen::Vector3d& facing, double least_gain) {
  Sighting sighting;
  const BoardPoints members = subset(points, thinned(rough.members));
  const Plane start = rough.plane.signed_distance(facing) < 0 ? rough.plane.flipped() : rough.plane;
  sighting.plane = fit_board_plane(members, classes_by_otsu(members.intensity), start);
  sighting.points = near_plane(points, sighting.plane);
  if (most_gain(sighting.points.size()) < least_gain) return sighting;
  sighting.places = places_on(sighting.plane, sighting.points);
  BoardSearchOptions search;
  search.about_m = -(sighting.plane.axes.transpose() * sighting.plane.anchor);
  // A little more, so that a centre just as far as it may lie is not cut off.
  search.radius_m = (options.search_sides + 0.05) * options.board.side_m();
  sighting.candidates =
      search_board(options.board, sighting.places, sighting.points.intensity, search);
  return sighting;
}

/// All but the members, which ascend.
BoardPoints without(const BoardPoints& points, const std::vector<std::uint32_t>& members) {
  std::vector<std::uint32_t> left;
  for (std::uint32_t i = 0, m = 0; i < points.size(); ++i) {
    if (m < members.size() && members[m] == i)
      ++m;
    else
      left.push_back(i);
  }
  return subset(points, left);
}

}  // namespace

std::vector<Sighting> sightings(const BoardPoints& points, const BoardOptions& options,
                                const Eigen::Vector3d& facing) {
  constexpr int most_planes = 4;
  std::vector<Sighting> found;
  BoardPoints rest = points;
  double least_gain = 0;
  for (int k = 0; k < most_planes; ++k) {
    const auto rough = find_rough_plane(rest, options.board.side_m());
    if (!rough || rough->members.size() < 12) break;
    Sighting sighting = sight(rest, *rough, options, facing, least_gain);
    if (!sighting.candidates.empty()) {
      least_gain =
          std::max(least_gain, BoardSearchOptions::least_gain_share * sighting.candidates[0].gain);
      found.push_back(std::move(sighting));
    }
    rest = without(rest, rough->members);
    if (rest.size() < 30 || rest.size() < points.size() / 20) break;
    if (most_gain(rest.size()) < least_gain) break;
  }
  std::stable_sort(found.begin(), found.end(), [](const Sighting& a, const Sighting& b) {
    return a.candidates[0].gain > b.candidates[0].gain;
  });
  return found;
}

}  // namespace alea
