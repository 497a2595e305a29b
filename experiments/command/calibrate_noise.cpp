#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/version.hpp"
#include "alea/evaluate/noise_fit.hpp"
#include "alea/io/atomic_file.hpp"
#include "alea/io/cloud_file.hpp"
#include "experiments/command/calibrate.hpp"
#include "experiments/command/json_parts.hpp"
#include "experiments/command/noise_file.hpp"
#include "experiments/command/reading.hpp"

namespace alea::command {
namespace {

constexpr double arc_second = std::numbers::pi / 180 / 3600;

struct NoiseArguments {
  CommonOptions common;
  std::string scan, out, origin;
  std::optional<double> range_noise_mm, range_growth_ppm, grazing_mm, angular_arcsec, surface_mm;
  ReadingOptions reading;
  ThinningOptions thinning;
};

double not_negative(double value, const char* option) {
  if (!(value >= 0 && std::isfinite(value)))
    throw usage_error(fmt::format("{}: {} is not a standard deviation", option, value));
  return value;
}

NoiseFitOptions fit_options(const NoiseArguments& arguments) {
  NoiseFitOptions options;
  const auto fix = [](const std::optional<double>& value, double unit,
                      const char* name) -> std::optional<double> {
    return value ? std::optional(unit * not_negative(*value, name)) : std::nullopt;
  };
  options.fixed = {fix(arguments.range_noise_mm, 1e-3, "--range-noise-mm"),
                   fix(arguments.range_growth_ppm, 1e-6, "--range-growth-ppm"),
                   fix(arguments.grazing_mm, 1e-3, "--grazing-mm"),
                   fix(arguments.angular_arcsec, arc_second, "--angular-arcsec")};
  if (arguments.surface_mm)
    options.surface_m = 1e-3 * not_negative(*arguments.surface_mm, "--surface-mm");
  return options;
}

Cloud read_scan(const NoiseArguments& arguments) {
  ReadOptions read = read_options(arguments.reading);
  thin(arguments.thinning, read);
  Cloud cloud = read_cloud(arguments.scan, read);
  if (cloud.empty())
    throw input_error(fmt::format("{}: no points; a scan is needed", arguments.scan));
  if (const auto origin = parse_point("--origin", arguments.origin))
    cloud.scanner_position = Eigen::Vector3d((*origin)[0], (*origin)[1], (*origin)[2]);
  // A scan's own frame has its scanner at the origin, unless the file says otherwise.
  if (!cloud.scanner_position) cloud.scanner_position = Eigen::Vector3d(0, 0, 0);
  return cloud;
}

nlohmann::json estimate_json(const NoiseEstimate& estimate) {
  nlohmann::json out = noise_json(estimate.model), terms = nlohmann::json::object();
  for (std::size_t k = 0; k < noise_terms.size(); ++k) {
    const NoiseTermEstimate& term = estimate.terms[k];
    terms[to_string(noise_terms[k])] = {{"value", term.value},
                                        {"standard_error", term.standard_error},
                                        {"interval95", {term.low, term.high}},
                                        {"fixed", term.fixed}};
  }
  out["terms"] = terms;
  out["tiles"] = estimate.tiles;
  out["tiles_rejected"] = estimate.tiles_rejected;
  out["points"] = estimate.points;
  out["overdispersion"] = estimate.overdispersion;
  out["range_m"] = {estimate.least_range_m, estimate.largest_range_m};
  out["incidence_rad"] = {estimate.least_incidence_rad, estimate.largest_incidence_rad};
  return out;
}

void print(const NoiseEstimate& estimate) {
  constexpr std::array<std::pair<const char*, double>, 4> units{
      {{"mm", 1e3}, {"ppm", 1e6}, {"mm", 1e3}, {"arc seconds", 1 / arc_second}}};
  for (std::size_t k = 0; k < noise_terms.size(); ++k) {
    const NoiseTermEstimate& term = estimate.terms[k];
    const auto& [name, unit] = units[k];
    if (term.fixed)
      fmt::print("{:18} {:8.3f} {} (fixed)\n", to_string(noise_terms[k]), term.value * unit, name);
    else
      fmt::print("{:18} {:8.3f} {} (95 %: {:.3f} to {:.3f})\n", to_string(noise_terms[k]),
                 term.value * unit, name, term.low * unit, term.high * unit);
  }
  fmt::print(
      "from {} points in {} flat pieces ({} unlike the others left out), ranges {:.1f} to "
      "{:.1f} m, incidence {:.0f} to {:.0f} deg; scatter of the pieces over chance {:.1f}\n",
      estimate.points, estimate.tiles, estimate.tiles_rejected, estimate.least_range_m,
      estimate.largest_range_m, estimate.least_incidence_rad * 180 / std::numbers::pi,
      estimate.largest_incidence_rad * 180 / std::numbers::pi, std::sqrt(estimate.overdispersion));
}

int run(const NoiseArguments& arguments) {
  const NoiseFitOptions options = fit_options(arguments);
  const ThreadLimit limit(arguments.common.threads);
  const Cloud cloud = read_scan(arguments);
  const Result<NoiseEstimate> estimate = calibrate_noise(cloud, options);
  nlohmann::json document = {{"alea", version()},
                             {"status", estimate ? "calibrated" : "refused"},
                             {"refusal", nullptr},
                             {"noise", nullptr}};
  if (!estimate) {
    document["refusal"] = refusal_json(estimate.refusal());
    write_json(arguments.common, document);
    return report_refusal(estimate.refusal());
  }
  const nlohmann::json noise = estimate_json(*estimate);
  document["noise"] = noise;
  if (!arguments.out.empty()) write_file_atomically(arguments.out, noise.dump(2) + "\n");
  write_json(arguments.common, document);
  if (arguments.common.json != "-") print(*estimate);
  return exit_done;
}

}  // namespace

void add_calibrate_noise(CLI::App& parent, int& exit_code) {
  auto arguments = std::make_shared<NoiseArguments>();
  CLI::App* app = parent.add_subcommand(
      "noise", "Estimate a scanner's noise from the planes of an ordinary scan");
  NoiseArguments& a = *arguments;
  app->add_option("SCAN", a.scan, "A scan with walls, floor, ceiling at several ranges and angles")
      ->required();
  app->add_option("--out", a.out, "Noise file (JSON) for --noise");
  app->add_option("--origin", a.origin,
                  "Scanner position: X,Y,Z (m); else the file's, else the frame's origin");
  app->add_option("--range-noise-mm", a.range_noise_mm,
                  "Range noise that is known (mm), instead of estimating it");
  app->add_option("--range-growth-ppm", a.range_growth_ppm,
                  "Growth of the range noise that is known (mm a km)");
  app->add_option("--grazing-mm", a.grazing_mm, "Grazing term that is known (mm)");
  app->add_option("--angular-arcsec", a.angular_arcsec,
                  "Angular noise that is known (arc seconds, azimuth and elevation each)");
  app->add_option("--surface-mm", a.surface_mm,
                  "Roughness of the surfaces that is known (mm); else it stays within the range "
                  "and grazing terms");
  add_reading_options(*app, a.reading);
  add_thinning_options(*app, a.thinning);
  add_common_options(*app, a.common);
  app->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
