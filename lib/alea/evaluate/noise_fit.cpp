#include "alea/evaluate/noise_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "alea/core/angle.hpp"
#include "alea/evaluate/noise_regression.hpp"

namespace alea {
namespace {

constexpr std::size_t least_tiles = 10;
NoiseTermEstimate term_estimate(double theta, double error, bool fixed) {
  NoiseTermEstimate term;
  term.fixed = fixed;
  term.value = term.low = term.high = std::sqrt(std::max(theta, 0.0));
  if (fixed) return term;
  term.low = std::sqrt(std::max(0.0, theta - 1.96 * error));
  term.high = std::sqrt(std::max(0.0, theta) + 1.96 * error);
  // Of the root; at zero, where it has no slope, the root of the error itself.
  term.standard_error = error > 0 ? error / std::max(2 * term.value, std::sqrt(error)) : 0;
  return term;
}

void describe_spread(const std::vector<NoiseTile>& tiles, NoiseEstimate& out) {
  out.least_range_m = out.least_incidence_rad = std::numeric_limits<double>::infinity();
  for (const NoiseTile& tile : tiles) {
    const double range = std::sqrt(tile.range2_cos2_m2 + tile.range2_sin2_m2);
    const double incidence = std::acos(std::min(1.0, std::sqrt(tile.cos2)));
    out.least_range_m = std::min(out.least_range_m, range);
    out.largest_range_m = std::max(out.largest_range_m, range);
    out.least_incidence_rad = std::min(out.least_incidence_rad, incidence);
    out.largest_incidence_rad = std::max(out.largest_incidence_rad, incidence);
  }
}

Refusal not_observable(const std::vector<std::string>& names, const NoiseEstimate& spread) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return {RefusalCode::unobservable,
          fmt::format("not observable: {}; the planes cover ranges of {:.1f} to {:.1f} m and "
                      "incidence angles of {:.0f} to {:.0f} deg: scan planes that spread more, or "
                      "fix a term that is known",
                      list, spread.least_range_m, spread.largest_range_m,
                      spread.least_incidence_rad * deg_per_rad,
                      spread.largest_incidence_rad * deg_per_rad)};
}

}  // namespace

const char* to_string(NoiseTerm term) {
  switch (term) {
    case NoiseTerm::range:
      return "range_noise_m";
    case NoiseTerm::growth:
      return "range_growth";
    case NoiseTerm::grazing:
      return "grazing_m";
    case NoiseTerm::angular:
      return "angular_noise_rad";
  }
  return "unknown";
}

double value_of(const NoiseModel& model, NoiseTerm term) {
  switch (term) {
    case NoiseTerm::range:
      return model.range_noise_m;
    case NoiseTerm::growth:
      return model.range_growth;
    case NoiseTerm::grazing:
      return model.grazing_m;
    case NoiseTerm::angular:
      return model.angular_noise_rad;
  }
  return 0;
}

Result<NoiseEstimate> fit_noise(const std::vector<NoiseTile>& tiles,
                                const NoiseFitOptions& options) {
  if (tiles.size() < least_tiles)
    return Refusal{RefusalCode::too_few_points,
                   fmt::format("{} flat pieces of planes; at least {} are needed: scan walls, "
                               "floor and ceiling, or denser",
                               tiles.size(), least_tiles)};
  std::array<std::optional<double>, 4> fixed;
  for (int k = 0; k < 4; ++k)
    if (options.fixed[k]) fixed[k] = *options.fixed[k] * *options.fixed[k];
  const NoiseRegression fit = regress_noise(tiles, fixed, options.surface_m * options.surface_m);
  NoiseEstimate out;
  describe_spread(tiles, out);
  std::vector<std::string> open;
  for (int k = 0; k < 4; ++k) {
    if (!fixed[k] && !(fit.share[k] <= options.largest_share))
      open.emplace_back(to_string(noise_terms[k]));
    out.terms[k] = term_estimate(fit.theta[k], fit.standard_error[k], fixed[k].has_value());
  }
  if (!open.empty()) return not_observable(open, out);
  out.model = {out.terms[0].value, out.terms[2].value, options.surface_m, out.terms[3].value,
               out.terms[1].value};
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    out.tiles_rejected += fit.used[i] ? 0 : 1;
    out.tiles += fit.used[i] ? 1 : 0;
    out.points += fit.used[i] ? tiles[i].points : 0;
  }
  out.overdispersion = fit.overdispersion;
  return out;
}

}  // namespace alea
