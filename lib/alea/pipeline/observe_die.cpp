#include "alea/pipeline/observe_die.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alea/cloud/coordinate_step.hpp"
#include "alea/die/assembly.hpp"
#include "alea/die/die_decision.hpp"
#include "alea/die/pips_chain.hpp"
#include "alea/die/pips_rule.hpp"
#include "alea/facet/facet_surface.hpp"
#include "alea/pipeline/stopwatch.hpp"

namespace alea {
namespace {

constexpr double plausible_range_m =
    1000;  // an unnamed scanner stands at the origin only if that near

/// Where the scanner may stand when nobody said: at the origin, if that is near enough to the
/// points.
std::optional<Eigen::Vector3d> assumed_position(const Cloud& cloud) {
  if (cloud.scanner_position) return cloud.scanner_position;
  for (std::size_t i = 0; i < cloud.size(); i += std::max<std::size_t>(1, cloud.size() / 100))
    if (cloud.positions[i].norm() < plausible_range_m) return Eigen::Vector3d(0, 0, 0);
  return std::nullopt;
}

DieFinderOptions finder_options(const DieRegistrationOptions& options,
                                const std::optional<Eigen::Vector3d>& near_m,
                                const std::optional<Eigen::Vector3d>& position) {
  DieFinderOptions out;
  out.edges_m = options.edges_m;
  if (options.edge_m > 0) out.edge_m = options.edge_m;
  out.near_m = near_m;
  out.facets.fit.noise = options.noise;
  out.facets.fit.scanner_position = position;
  const bool orthogonal = is_published(options.method) || !position;
  out.facets.fit.method = orthogonal ? FitMethod::orthogonal : FitMethod::along_ray;
  if (is_published(options.method)) {
    out.facets.trim_m = 0.0;
    return out;
  }
  // Areas are seen from somewhere.
  out.facets.fit.area_weights = options.weights == FacetWeights::area && position.has_value();
  out.facets.fit.robust = options.weights == FacetWeights::robust;
  return out;
}

/// The order of the facets in which their outward normals have a positive determinant.
std::array<int, 3> positive_order(int orientation) {
  return orientation > 0 ? std::array<int, 3>{0, 1, 2} : std::array<int, 3>{0, 2, 1};
}

/// The published reading: count each facet, two that agree with a die suffice.
Result<PipReading> read_by_counting(const std::array<FacetImageInput, 3>& images, int orientation,
                                    const DieRegistrationOptions& options) {
  const std::array<int, 3> order = positive_order(orientation);
  PipTriple counts{};
  for (int k = 0; k < 3; ++k) counts[k] = count_pips(images[order[k]]).count;
  const Chirality hand = options.chirality.value_or(Chirality::clockwise);
  const Result<PipTriple> pips = resolve_any_two(counts, hand);
  if (!pips) return pips.refusal();
  PipReading reading;
  reading.hand = hand;
  for (int k = 0; k < 3; ++k) {
    reading.pips[order[k]] = (*pips)[k];
    reading.probability[order[k]] = counts[k] == (*pips)[k] ? 1 : 0;
  }
  return reading;
}

/// From all points whose rays meet the facets inside their borders, also those deeper than the gate
/// of the fits: without its drilled pips a facet shows other ones.
Result<PipReading> read_facets(const Cloud& cloud, const FacetFits& facets,
                               const CornerAssembly& corner, const DieRegistrationOptions& options,
                               const FacetFitOptions& fit, bool keep_ambiguous) {
  constexpr double deepest_pip = 0.06;  // of the edge
  const bool published = is_published(options.method);
  const double edge_m = *std::min_element(facets.edges_m.begin(), facets.edges_m.end());
  const std::array<std::vector<std::uint32_t>, 3> points =
      published ? facets.indices : facet_surface(cloud, facets, fit, deepest_pip * edge_m);
  const std::array<Plane, 3> planes{facets.fits[0].plane, facets.fits[1].plane,
                                    facets.fits[2].plane};
  const auto images =
      facet_images(cloud, {points[0], points[1], points[2]}, planes, corner, facets.edges_m);
  if (published) return read_by_counting(images, corner.orientation, options);
  PipReaderOptions reader;
  reader.chirality = options.chirality;
  reader.keep_ambiguous = keep_ambiguous;
  return read_pips(images, corner.orientation, reader);
}

/// Fits again without the pips, which may be recessed or reflect differently.
FacetFits without_pips(const Cloud& cloud, const FacetFits& facets, const PipReading& reading,
                       FacetFitOptions options) {
  for (int k = 0; k < 3; ++k) {
    const double u_m = facets.edges_m[(k + 1) % 3], v_m = facets.edges_m[(k + 2) % 3];
    const Eigen::Vector2d edges_m(u_m, v_m);
    const double shorter_m = edges_m.minCoeff();
    const Eigen::Vector2d laid_out_m =
        reading.square_lattice ? Eigen::Vector2d(shorter_m, shorter_m) : edges_m;
    options.masks[k] = pip_discs(reading.pips[k], laid_out_m, pip_mask_radius_share * shorter_m);
    for (FacetDisc& disc : options.masks[k]) disc.centre_m += (edges_m - laid_out_m) / 2;
  }
  Result<FacetFits> masked = refit_facets(cloud, facets, options);
  return masked ? *std::move(masked) : facets;
}

DieSighting sighting(const DieCandidate& candidate, const FacetFits& facets,
                     const PipReading& reading) {
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return reading.pips[a] < reading.pips[b]; });
  DieSighting out;
  out.reading = reading;
  for (int k = 0; k < 3; ++k) {
    const int from = order[k];
    out.die.facets[k] = {reading.pips[from], facets.fits[from], facets.indices[from],
                         reading.probability[from]};
    out.edges_m[k] = facets.edges_m[from];
    out.edges_sd_m[k] = facets.edges_sd_m[from];
    out.regions[k] = candidate.regions[from];
  }
  return out;
}

/// Every candidate whose pips can be read, or else why those of the best cannot.
struct ReadDice {
  std::vector<DieSighting> dice;
  std::optional<Refusal> refusal;
};

ReadDice read_candidates(const Cloud& cloud, const std::vector<DieCandidate>& candidates,
                         const FacetFitOptions& fit, const DieRegistrationOptions& options,
                         bool keep_ambiguous) {
  ReadDice out;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const DieCandidate& candidate = candidates[i];
    const auto& fits = candidate.facets.fits;
    const auto corner = assemble_corner({fits[0].plane, fits[1].plane, fits[2].plane});
    if (!corner) continue;
    const Result<PipReading> reading =
        read_facets(cloud, candidate.facets, *corner, options, fit, keep_ambiguous);
    if (!reading) {
      if (!out.refusal) out.refusal = reading.refusal();
      continue;
    }
    const FacetFits facets = is_published(options.method) || reading->alternatives > 0
                                 ? candidate.facets
                                 : without_pips(cloud, candidate.facets, *reading, fit);
    out.dice.push_back(sighting(candidate, facets, *reading));
    out.dice.back().candidate = i;
  }
  if (!out.dice.empty()) out.refusal.reset();
  return out;
}

/// The published chain has no second look.
DecidedDice found_dice(const Cloud& cloud, std::vector<PlaneRegion> regions,
                       const DieFinderOptions& finder) {
  auto dice = find_dice(cloud, regions, finder);
  return {std::move(regions), std::move(dice)};
}

void find_and_read(const Cloud& cloud, const DieFinderOptions& finder,
                   const DieRegistrationOptions& options, ScanSighting& scan) {
  Stopwatch watch;
  scan.refusal.reset();
  DecidedDice decided = is_published(options.method)
                            ? found_dice(cloud, std::move(scan.planes), finder)
                            : decide_dice(cloud, std::move(scan.planes), finder,
                                          PlaneDetectionOptions{}.tolerance_m, options.seed);
  scan.planes = std::move(decided.regions);
  scan.facets_s += watch.lap_s();
  if (!decided.dice) {
    scan.refusal = decided.dice.refusal();
    return;
  }
  scan.candidates = *std::move(decided.dice);
  ReadDice read = read_candidates(cloud, scan.candidates, finder.facets, options, false);
  scan.dice = std::move(read.dice);
  scan.refusal = std::move(read.refusal);
  if (scan.refusal && !is_published(options.method)) {
    scan.ambiguous = read_candidates(cloud, scan.candidates, finder.facets, options, true).dice;
    if ((options.resolve_by_scene || options.levelled) && !scan.ambiguous.empty()) {
      scan.dice = scan.ambiguous;
      scan.refusal.reset();
    }
  }
  scan.pips_s += watch.lap_s();
}

/// Whether no body of the die's shape and size was found.
bool is_missing(const std::optional<Refusal>& refusal) {
  return refusal &&
         (refusal->code == RefusalCode::no_die || refusal->code == RefusalCode::too_few_facets ||
          refusal->code == RefusalCode::too_few_points ||
          refusal->code == RefusalCode::size_mismatch);
}

/// The usual tolerance splits the planes of a noisy scanner: where no die was found, a wider one is
/// tried.
void look_again(const Cloud& cloud, PlaneDetectionOptions detection, const DieFinderOptions& finder,
                const DieRegistrationOptions& options, ScanSighting& scan) {
  constexpr double wider = 3;
  detection.tolerance_m *= wider;
  Stopwatch watch;
  ScanSighting again = scan;
  again.planes = detect_planes(cloud, detection);
  again.planes_s += watch.lap_s();
  find_and_read(cloud, finder, options, again);
  if (!is_missing(again.refusal)) scan = std::move(again);
}

/// A die of another size, recognised by its pips, is a wrong --edge; a body without is furniture.
void name_other_size(const Cloud& cloud, const DieFinderOptions& finder,
                     const DieRegistrationOptions& options, ScanSighting& scan) {
  for (const double edge_m : cube_sizes(cloud, scan.planes)) {
    DieFinderOptions other = finder;
    other.edge_m = edge_m;
    other.edges_m.reset();
    const auto dice = find_dice(cloud, scan.planes, other);
    if (!dice) continue;
    const ReadDice read = read_candidates(cloud, *dice, other.facets, options, false);
    if (read.dice.empty()) continue;
    const auto& edges_m = read.dice.front().edges_m;
    scan.refusal = Refusal{
        RefusalCode::size_mismatch,
        fmt::format("the die found has edges of {:.3f}, {:.3f} and {:.3f} m where {:.3f} m is "
                    "expected; check --edge and its unit",
                    edges_m[0], edges_m[1], edges_m[2], longest_edge_m(finder))};
    return;
  }
}

}  // namespace

std::string edge_name(int first_pips, int second_pips) {
  return fmt::format("{}-{}", std::min(first_pips, second_pips), std::max(first_pips, second_pips));
}

ScanSighting observe_die(Cloud& cloud, const DieRegistrationOptions& options,
                         const std::optional<Eigen::Vector3d>& near_m) {
  const bool position_given = cloud.scanner_position.has_value();
  cloud.scanner_position = assumed_position(cloud);
  ScanSighting scan;
  scan.coordinate_step_m = coordinate_step_m(cloud.positions);
  Stopwatch watch;
  const PlaneDetectionOptions detection{.detector = options.planes, .seed = options.seed};
  scan.planes = options.find_planes ? options.find_planes(cloud) : detect_planes(cloud, detection);
  scan.planes_s = watch.lap_s();
  scan.scanner_position_known = cloud.scanner_position.has_value();
  const DieFinderOptions finder = finder_options(options, near_m, cloud.scanner_position);
  find_and_read(cloud, finder, options, scan);
  const bool second_look = !options.find_planes && !is_published(options.method);
  if (second_look && is_missing(scan.refusal)) look_again(cloud, detection, finder, options, scan);
  const bool blank = scan.refusal && scan.refusal->code == RefusalCode::pips_unreadable;
  if (second_look && (blank || is_missing(scan.refusal)))
    name_other_size(cloud, finder, options, scan);
  if (!scan.refusal || position_given || !cloud.scanner_position) return scan;
  // The origin was a guess: without it the facets can still be fitted orthogonally.
  ScanSighting unplaced = scan;
  find_and_read(cloud, finder_options(options, near_m, std::nullopt), options, unplaced);
  if (unplaced.refusal) return scan;
  cloud.scanner_position.reset();
  unplaced.scanner_position_known = false;
  return unplaced;
}

}  // namespace alea
