#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "alea/core/seed.hpp"
#include "alea/simulate/scanner.hpp"

namespace alea {

/// The random part of a scan: one stream for each cause, read at the number of the ray.
class ScanNoise {
 public:
  ScanNoise(const Scanner& scanner, const SimulationKey& key);

  /// Departure of the beam from the reported azimuth and elevation (rad).
  Eigen::Vector2d angles_rad(std::uint64_t ray) const;
  /// What the scanner adds to a true range (m) at this cosine of the incidence angle.
  double range_m(std::uint64_t ray, double cos_incidence) const;
  double intensity(std::uint64_t ray) const;

 private:
  Scanner scanner_;
  RandomStream range_, grazing_, surface_, angular_, intensity_;
};

}  // namespace alea
