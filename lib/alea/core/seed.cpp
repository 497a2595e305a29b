#include "alea/core/seed.hpp"

#include <cmath>
#include <numbers>

namespace alea {
namespace {

constexpr std::uint32_t low(std::uint64_t v) {
  return static_cast<std::uint32_t>(v);
}
constexpr std::uint32_t high(std::uint64_t v) {
  return static_cast<std::uint32_t>(v >> 32);
}

// Inside a shared library the public function can be replaced from outside and so is never inlined.
inline std::array<std::uint32_t, 4> philox(const std::array<std::uint32_t, 4>& counter,
                                           const std::array<std::uint32_t, 2>& key) {
  std::array<std::uint32_t, 4> c = counter;
  std::array<std::uint32_t, 2> k = key;
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product0 = std::uint64_t{0xD2511F53u} * c[0];
    const std::uint64_t product1 = std::uint64_t{0xCD9E8D57u} * c[2];
    c = {high(product1) ^ c[1] ^ k[0], low(product1), high(product0) ^ c[3] ^ k[1], low(product0)};
    k[0] += 0x9E3779B9u;
    k[1] += 0xBB67AE85u;
  }
  return c;
}

/// Two uniforms in (0, 1) from four words.
inline std::array<double, 2> uniforms(const std::array<std::uint32_t, 4>& words) {
  const auto to_unit = [](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t bits = (std::uint64_t{a} << 32 | b) >> 12;  // 52 bits
    return (static_cast<double>(bits) + 0.5) * 0x1p-52;
  };
  return {to_unit(words[0], words[1]), to_unit(words[2], words[3])};
}

}  // namespace

std::array<std::uint32_t, 4> philox4x32(const std::array<std::uint32_t, 4>& counter,
                                        const std::array<std::uint32_t, 2>& key) {
  return philox(counter, key);
}

RandomStream::RandomStream(const StreamKey& key) {
  // The five parts are hashed into a 64-bit key and the upper half of the counter by the generator
  // itself.
  const auto first = philox({low(key.seed), high(key.seed), key.experiment, key.scan},
                            {static_cast<std::uint32_t>(key.purpose), 0x616c6561u});
  const auto second =
      philox({low(key.trial), high(key.trial), first[0], first[1]}, {first[2], first[3]});
  key_ = {second[0], second[1]};
  high_ = {second[2], second[3]};
}

std::array<double, 2> RandomStream::uniform2_at(std::uint64_t index) const {
  return uniforms(philox({low(index), high(index), high_[0], high_[1]}, key_));
}

std::array<double, 2> RandomStream::normal2_at(std::uint64_t index) const {
  const auto [u, v] = uniforms(philox({low(index), high(index), high_[0], high_[1]}, key_));
  const double radius = std::sqrt(-2 * std::log(u));
  const double angle = 2 * std::numbers::pi * v;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

std::uint64_t RandomStream::below(std::uint64_t n) {
  return static_cast<std::uint64_t>(uniform() * static_cast<double>(n));
}

}  // namespace alea
