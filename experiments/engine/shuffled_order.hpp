#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "alea/core/seed.hpp"

namespace alea::experiments {

/// The numbers below `n` in an order drawn from the stream (Fisher and Yates), each order as likely
/// as any other.
inline std::vector<std::uint32_t> shuffled_order(std::size_t n, RandomStream stream) {
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[stream.below(i)]);
  return order;
}

}  // namespace alea::experiments
