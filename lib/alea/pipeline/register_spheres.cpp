#include "alea/pipeline/register_spheres.hpp"

namespace alea {
namespace {

SphereFinderOptions finder_options(const RegisterSpheresOptions& options,
                                   const std::optional<Eigen::Vector3d>& scanner_position) {
  SphereFinderOptions finder;
  finder.fit.method = options.method;
  finder.fit.radius_m = options.radius_m;
  finder.fit.radius_known = options.radius_known;
  finder.fit.noise = options.noise;
  finder.scanner_position = scanner_position;
  return finder;
}

std::vector<SphereFit> fits_of(const std::vector<SphereTarget>& targets) {
  std::vector<SphereFit> fits;
  for (const SphereTarget& target : targets) fits.push_back(target.fit);
  return fits;
}

}  // namespace

Result<SpheresRegistered> register_spheres(const Cloud& master, const Cloud& slave,
                                           const RegisterSpheresOptions& options) {
  auto in_master = find_spheres(master, finder_options(options, options.master_origin_m));
  if (!in_master) return in_master.refusal();
  auto in_slave = find_spheres(slave, finder_options(options, options.slave_origin_m));
  if (!in_slave) return in_slave.refusal();
  auto registration = match_and_register(fits_of(*in_master), fits_of(*in_slave), options.match);
  if (!registration) return registration.refusal();
  return SpheresRegistered{std::move(*registration), std::move(*in_master), std::move(*in_slave)};
}

}  // namespace alea
