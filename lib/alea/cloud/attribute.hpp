#pragma once

#include <cstdint>
#include <vector>

namespace alea {

/// The attribute of point i; zero where the cloud does not have it.
template <typename T>
T value_at(const std::vector<T>& values, std::uint32_t i) {
  return values.empty() ? T{} : values[i];
}

}  // namespace alea
