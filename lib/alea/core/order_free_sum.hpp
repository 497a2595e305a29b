#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace alea {

/// N sums in 64-bit fixed point: the same bits for any order of the terms, because integers add
/// associatively. The caller bounds each term beforehand; the error of a total is at most
/// count * bound * 2^-61, relative to a sum of terms near their bound about that of a sum of
/// doubles.
template <std::size_t N>
class OrderFreeSum {
 public:
  /// `bounds[k]` >= |every term of sum k|, finite; `count` >= the number of terms.
  OrderFreeSum(const std::array<double, N>& bounds, std::size_t count) {
    for (std::size_t k = 0; k < N; ++k) {
      int exponent = 0;
      std::frexp(bounds[k] * static_cast<double>(count), &exponent);
      scale_[k] = bounds[k] > 0 ? std::ldexp(1.0, 62 - exponent) : 1.0;
    }
  }

  void add(std::size_t k, double term) { total_[k] += static_cast<std::int64_t>(term * scale_[k]); }
  double total(std::size_t k) const { return static_cast<double>(total_[k]) / scale_[k]; }

 private:
  std::array<double, N> scale_{};
  std::array<std::int64_t, N> total_{};
};

}  // namespace alea
