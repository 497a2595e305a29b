#include "alea/io/lzf.hpp"

#include <cstdint>

namespace alea {

std::optional<std::string> lzf_expand(std::string_view compressed, std::size_t size) {
  // Three bytes stand for 264 at most.
  if (size / 88 > compressed.size()) return std::nullopt;
  std::string out;
  out.reserve(size);
  for (std::size_t at = 0; at < compressed.size();) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(compressed[i]); };
    const std::size_t control = byte(at++);
    if (control < 32) {
      const std::size_t length = control + 1;
      if (compressed.size() - at < length || size - out.size() < length) return std::nullopt;
      out.append(compressed.substr(at, length));
      at += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) {
      if (at == compressed.size()) return std::nullopt;
      length += byte(at++);
    }
    length += 2;
    if (at == compressed.size()) return std::nullopt;
    const std::size_t back = ((control & 31) << 8) + byte(at++) + 1;
    if (back > out.size() || size - out.size() < length) return std::nullopt;
    // The reference may overlap what it writes: byte by byte.
    for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - back]);
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

}  // namespace alea
