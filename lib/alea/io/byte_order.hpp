#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace alea {

/// The value whose bytes lie at `at`, swapped where the file's byte order is not the machine's.
template <typename T, bool swapped = false>
T load_value(const char* at) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), at, sizeof(T));
  if constexpr (swapped) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

/// A little-endian value at `offset`; the caller has checked that it lies inside.
template <typename T>
T load_le(std::string_view bytes, std::size_t offset) {
  return load_value<T>(bytes.data() + offset);
}

}  // namespace alea
