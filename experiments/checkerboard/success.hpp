#pragma once

#include <cstdint>

#include "experiments/engine/wilson.hpp"

namespace alea::experiments::checkerboard {

/// A count out of many, with Wilson's 95 % interval (Wilson 1927, doi 10.2307/2276774).
struct Share {
  std::uint64_t good = 0, of = 0;

  double value() const { return of > 0 ? static_cast<double>(good) / static_cast<double>(of) : 0; }
  double low() const { return interval().low; }
  double high() const { return interval().high; }

 private:
  acceptance::Interval interval() const {
    return acceptance::wilson_interval(value(), static_cast<double>(of > 0 ? of : 1), 1.959964);
  }
};

}  // namespace alea::experiments::checkerboard
