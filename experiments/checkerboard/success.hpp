#pragma once

#include <cmath>
#include <cstdint>

namespace alea::experiments::checkerboard {

/// A count out of many, with Wilson's 95 % interval (Wilson 1927, doi 10.2307/2276774).
struct Share {
  std::uint64_t good = 0, of = 0;

  double value() const { return of > 0 ? static_cast<double>(good) / static_cast<double>(of) : 0; }
  double low() const { return centre() - half_width(); }
  double high() const { return centre() + half_width(); }

 private:
  static constexpr double z = 1.959964;
  double n() const { return static_cast<double>(of > 0 ? of : 1); }
  double centre() const { return (value() + z * z / (2 * n())) / (1 + z * z / n()); }
  double half_width() const {
    const double p = value();
    return z / (1 + z * z / n()) * std::sqrt(p * (1 - p) / n() + z * z / (4 * n() * n()));
  }
};

}  // namespace alea::experiments::checkerboard
