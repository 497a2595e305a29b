#include "alea/pipeline/register_spheres.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/cloud_file.hpp"
#include "experiments/command/control_file.hpp"
#include "experiments/command/noise_file.hpp"
#include "experiments/command/reading.hpp"
#include "experiments/command/register.hpp"
#include "experiments/command/registration_json.hpp"

namespace alea::command {
namespace {

struct SphereArguments {
  CommonOptions common;
  std::string master, slave;
  double radius_m = 0;
  bool free_radius = false;
  std::string method = "along_ray";
  std::string master_origin, slave_origin, noise_file;
  ControlOptions control;
  ReadingOptions reading;
};

constexpr double control_sd_m = 0.002;  // of a control point whose own is not given
constexpr double smallest_radius_m = 0.005, largest_radius_m = 5;

std::optional<Eigen::Vector3d> origin(const std::string& option, const std::string& text) {
  const auto parsed = parse_point(option, text);
  if (!parsed) return std::nullopt;
  return Eigen::Vector3d((*parsed)[0], (*parsed)[1], (*parsed)[2]);
}

RegisterSpheresOptions registration_options(const SphereArguments& arguments) {
  if (!(arguments.radius_m >= smallest_radius_m && arguments.radius_m <= largest_radius_m))
    throw usage_error(
        fmt::format("--radius: {} m is not the radius of a sphere target; give metres from {} to "
                    "{} (half the diameter)",
                    arguments.radius_m, smallest_radius_m, largest_radius_m));
  RegisterSpheresOptions options;
  options.radius_m = arguments.radius_m;
  options.radius_known = !arguments.free_radius;
  options.method =
      arguments.method == "geometric" ? SphereFitMethod::geometric : SphereFitMethod::along_ray;
  options.master_origin_m = origin("--master-origin", arguments.master_origin);
  options.slave_origin_m = origin("--slave-origin", arguments.slave_origin);
  if (!arguments.noise_file.empty()) options.noise = read_noise_file(arguments.noise_file);
  return options;
}

Cloud read_scan(const std::string& path, const ReadOptions& options) {
  Cloud cloud = read_cloud(path, options);
  if (cloud.empty()) throw input_error(fmt::format("{}: no points; a scan is needed", path));
  return cloud;
}

/// The spheres that took part, in the order of their pairs.
nlohmann::json spheres_json(const SpheresRegistered& result) {
  const auto fit_json = [](const SphereFit& fit) {
    return nlohmann::json{{"centre_m", {fit.centre_m.x(), fit.centre_m.y(), fit.centre_m.z()}},
                          {"radius_m", fit.radius_m},
                          {"points", fit.points},
                          {"rmse_m", fit.rmse_m},
                          {"variance_factor", fit.variance_factor}};
  };
  nlohmann::json spheres = nlohmann::json::array();
  const SphereRegistration& registration = result.registration;
  for (std::size_t k = 0; k < registration.pairs.size(); ++k)
    spheres.push_back({{"master", fit_json(result.master[registration.pairs[k].master].fit)},
                       {"slave", fit_json(result.slave[registration.pairs[k].slave].fit)},
                       {"residual_m", registration.residual_m[k]}});
  return spheres;
}

void print_spheres(const SpheresRegistered& result) {
  const SphereRegistration& registration = result.registration;
  fmt::print("spheres in both scans: {} (found: master {}, slave {})\n", registration.pairs.size(),
             result.master.size(), result.slave.size());
  for (std::size_t k = 0; k < registration.pairs.size(); ++k) {
    const Eigen::Vector3d& centre = result.master[registration.pairs[k].master].fit.centre_m;
    fmt::print("  ({:.4f}, {:.4f}, {:.4f}) m in the master, residual {:.2f} mm\n", centre.x(),
               centre.y(), centre.z(), registration.residual_m[k] * 1e3);
  }
}

/// The master's spheres under the names of the control points that their distances match.
std::vector<NamedPoint> named_spheres(const ControlOptions& control,
                                      const std::vector<SphereTarget>& spheres) {
  if (control.control_file.empty() || !control.targets_file.empty()) return {};
  const std::vector<NamedPoint> site = read_named_points(control.control_file);
  std::vector<SphereFit> given, found;
  for (const NamedPoint& point : site) {
    SphereFit fit;
    fit.centre_m = point.point_m;
    fit.covariance = Eigen::Matrix3d::Identity() * std::pow(point.sd_m.value_or(control_sd_m), 2);
    given.push_back(fit);
  }
  for (const SphereTarget& sphere : spheres) found.push_back(sphere.fit);
  const auto matched = match_and_register(given, found);
  std::vector<NamedPoint> named;
  if (!matched) return named;
  for (const SpherePair& pair : matched->pairs)
    named.push_back({site[pair.master].name, found[pair.slave].centre_m,
                     std::sqrt(found[pair.slave].covariance.trace() / 3)});
  return named;
}

int run(const SphereArguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  const ThreadLimit limit(arguments.common.threads);
  const RegisterSpheresOptions options = registration_options(arguments);
  const ReadOptions reading = read_options(arguments.reading);
  const auto start = Clock::now();
  Cloud master, slave;
  parallel_pair([&] { master = read_scan(arguments.master, reading); },
                [&] { slave = read_scan(arguments.slave, reading); });
  const double read_s = since(start);
  const auto result = register_spheres(master, slave, options);

  Registration registration;
  registration.method = "spheres_" + arguments.method;
  if (result) {
    registration.master_from_slave = result->registration.master_from_slave;
    registration.covariance = result->registration.covariance;
  } else {
    registration.refusal = result.refusal();
  }
  std::vector<Registration> tied{std::move(registration)};
  tie_to_control(
      arguments.control,
      result ? named_spheres(arguments.control, result->master) : std::vector<NamedPoint>(), tied);
  registration = std::move(tied.front());
  const double total_s = since(start);
  registration.timing_s = {{"read", read_s}, {"register", total_s - read_s}, {"total", total_s}};
  nlohmann::json document = registration_json(registration, arguments.common.seed);
  document["spheres"] = result ? spheres_json(*result) : nlohmann::json::array();
  write_json(arguments.common, document);
  if (registration.refusal) return report_refusal(*registration.refusal);
  if (arguments.common.json == "-") return exit_done;
  print_registration(registration);
  print_spheres(*result);
  return exit_done;
}

}  // namespace

void add_register_spheres(CLI::App& parent, int& exit_code) {
  auto arguments = std::make_shared<SphereArguments>();
  SphereArguments& a = *arguments;
  CLI::App* app = parent.add_subcommand(
      "spheres", "Register two scans by at least three spheres that both of them see");
  app->add_option("MASTER", a.master, "Master scan (PLY, PCD, XYZ, PTS, PTX, E57, LAS)")
      ->required();
  app->add_option("SLAVE", a.slave, "Slave scan")->required();
  app->add_option("--radius", a.radius_m, "Radius of the spheres (m), half the diameter")
      ->required();
  app->add_flag("--free-radius", a.free_radius,
                "Estimate each sphere's radius; --radius then only finds them");
  app->add_option("--fit", a.method,
                  "along_ray: ranges over their standard deviations; geometric: plain distances "
                  "(biased, for comparison)")
      ->check(CLI::IsMember({"along_ray", "geometric"}))
      ->capture_default_str();
  app->add_option("--master-origin", a.master_origin,
                  "Scanner position in the master's frame: X,Y,Z (m)");
  app->add_option("--slave-origin", a.slave_origin,
                  "Scanner position in the slave's frame: X,Y,Z (m)");
  app->add_option("--noise", a.noise_file, "Noise model (JSON) behind the covariance");
  add_control_options(*app, a.control);
  add_reading_options(*app, a.reading);
  add_common_options(*app, a.common);
  app->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
