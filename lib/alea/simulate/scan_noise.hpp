#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "alea/core/seed.hpp"
#include "alea/simulate/scanner.hpp"

namespace alea {

/// The random part of a scan, read at the number of the ray. Each cause has numbers of its own, so
/// that switching one off leaves the others' as they were. (Two causes share a stream's pair of
/// normals: they are independent, and drawing them together halves the time.)
class ScanNoise {
 public:
  ScanNoise(const Scanner& scanner, const SimulationKey& key);

  /// Departure of the beam from the reported azimuth and elevation (rad).
  Eigen::Vector2d angles_rad(std::uint64_t ray) const;

  struct Error {
    double range_m = 0;
    double intensity = 0;
  };
  /// What the scanner adds to a true range (m) and intensity at this cosine of the incidence angle.
  Error at(std::uint64_t ray, double range_m, double cos_incidence) const;

 private:
  Scanner scanner_;
  RandomStream angular_, range_and_grazing_, surface_and_intensity_;
};

}  // namespace alea
