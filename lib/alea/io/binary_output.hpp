#pragma once

#include <cstring>
#include <string>

#include "alea/core/cloud.hpp"

namespace alea {

/// Appends the bytes of a value as they lie in memory (little endian on all supported machines).
template <typename T>
void append_bytes(std::string& out, const T& value) {
  const std::size_t at = out.size();
  out.resize(at + sizeof(T));
  std::memcpy(out.data() + at, &value, sizeof(T));
}

/// True where a float holds every coordinate without loss.
bool fits_float(const Cloud& cloud);

/// True where every colour is an 8-bit value held as v * 257.
bool fits_bytes(const std::vector<Colour>& colours);

/// How a record holds a colour: three bytes, three 16-bit words, or a 32-bit word 0x00RRGGBB.
enum class ColourLayout { bytes, words, packed };

struct RecordLayout {
  bool float_positions = true;  ///< else double
  ColourLayout colours = ColourLayout::bytes;
};

/// Writes a file of `header` and one record for each point, in the order position, intensity,
/// colour, normal, row and column, without those that the cloud lacks. Throws Error(input).
void write_records(const std::string& path, const std::string& header, const Cloud& cloud,
                   const RecordLayout& layout);

/// The nearest 8-bit value of a 16-bit colour component.
inline std::uint8_t colour_byte(std::uint16_t value) {
  return static_cast<std::uint8_t>((value + 128) / 257);
}

}  // namespace alea
