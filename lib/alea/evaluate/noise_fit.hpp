#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "alea/core/noise_model.hpp"
#include "alea/core/result.hpp"
#include "alea/evaluate/noise_tiles.hpp"

namespace alea {

/// The causes of scatter that planes can tell apart. Roughness is not among them: it has the same
/// effect as equal parts of range and grazing noise, so it has to be known or stays within these.
enum class NoiseTerm { range, growth, grazing, angular };
inline constexpr std::array<NoiseTerm, 4> noise_terms{NoiseTerm::range, NoiseTerm::growth,
                                                      NoiseTerm::grazing, NoiseTerm::angular};

/// The name in a noise file, e.g. "grazing_m".
const char* to_string(NoiseTerm term);
double value_of(const NoiseModel& model, NoiseTerm term);

struct NoiseFitOptions {
  /// Terms that are known beforehand, in the order of noise_terms, in their units.
  std::array<std::optional<double>, 4> fixed;
  double surface_m = 0;  ///< roughness that is known beforehand
  /// A term counts as observable where the standard error of its variance is at most this share of
  /// the whole variance, there where the term matters (see NoiseRegression::share).
  double largest_share = 0.25;
};

/// One term as estimated.
struct NoiseTermEstimate {
  double value = 0;           ///< a standard deviation in the term's unit
  double standard_error = 0;  ///< of the value; 0 where it was fixed
  double low = 0, high = 0;   ///< 95 % interval
  bool fixed = false;
};

struct NoiseEstimate {
  NoiseModel model;
  std::array<NoiseTermEstimate, 4> terms;  ///< in the order of noise_terms
  std::size_t tiles = 0, points = 0;       ///< that took part
  std::size_t tiles_rejected = 0;          ///< as unlike the others
  /// Spread of the tiles' variances over what chance alone would give; standard errors carry it.
  double overdispersion = 1;
  double least_range_m = 0, largest_range_m = 0;
  double least_incidence_rad = 0, largest_incidence_rad = 0;
};

/// Weighted least squares of the tiles' variances on the terms (a linear model), weights from the
/// fitted variance (2 s^4 / freedoms), no term negative. Tiles whose variance departs from the fit
/// by more than four robust standard deviations (cube-root scale, Wilson and Hilferty 1931) are
/// left out. Refuses as `unobservable` terms that the planes' ranges and incidence angles cannot
/// tell apart, naming them, and as `too_few_points` fewer than ten tiles.
Result<NoiseEstimate> fit_noise(const std::vector<NoiseTile>& tiles,
                                const NoiseFitOptions& options = {});

/// From a scan: planes, tiles, fit. The planes are looked for with a band that is widened until the
/// noise fits well into it. Refuses as `no_plane` where there are none even then. Throws
/// Error(usage) for a cloud without a scanner position.
Result<NoiseEstimate> calibrate_noise(const Cloud& cloud, const NoiseFitOptions& options = {});

}  // namespace alea
