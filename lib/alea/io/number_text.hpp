#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "alea/io/byte_order.hpp"

namespace alea {

/// A number at the front of a text and where it ends.
struct NumberText {
  double value;
  const char* end;
};

/// Powers of ten that a double holds exactly.
inline constexpr std::array<double, 23> powers_of_ten{
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// read_number() digit by digit, for numbers of any form and length.
NumberText read_by_digits(const char* at, const char* end);

/// Digits at the front of a text, as a number.
struct Digits {
  std::uint64_t value;
  unsigned count;
};

// The digits at the front of eight bytes, all at once: neighbours become numbers of two digits,
// then of four and eight (Lemire 2021, Number parsing at a gigabyte per second).
inline Digits leading_digits(const char* at) {
  std::uint64_t digits = load_value<std::uint64_t>(at) ^ 0x3030303030303030;
  const std::uint64_t other = ((digits + 0x7676767676767676) | digits) & 0x8080808080808080;
  const auto count = static_cast<unsigned>(std::countr_zero(other)) / 8;
  if (count == 0) return {0, 0};
  digits <<= 64 - 8 * count;
  digits = digits * 10 + (digits >> 8);
  constexpr std::uint64_t every_fourth = 0x000000FF000000FF;
  digits = (digits & every_fourth) * 0x000F424000000064 +
           (digits >> 16 & every_fourth) * 0x0000271000000001;
  return {digits >> 32, count};
}

/// The number at the start of [at, end) (a leading + is allowed) and where it ends; `end == at`
/// where there is none. Correctly rounded; NaN where its size is out of range. Up to 15 digits and
/// their power of ten are exact, so one division rounds correctly (Clinger 1990, How to read
/// floating point numbers accurately); the rest is std::from_chars' work.
inline NumberText read_number(const char* at, const char* end) {
  // Two times eight bytes, a sign, a point and what follows.
  if (end - at < 24) return read_by_digits(at, end);
  const bool negative = *at == '-';
  const char* next = at + (negative ? 1 : 0);
  const Digits whole = leading_digits(next);
  next += whole.count;
  Digits part{0, 0};
  if (*next == '.') {
    part = leading_digits(++next);
    next += part.count;
  }
  const bool plain = whole.count + part.count > 0 && whole.count < 8 && part.count < 8 &&
                     *next != 'e' && *next != 'E';
  if (!plain) return read_by_digits(at, end);
  const double scale = powers_of_ten[part.count];
  const double value =
      (static_cast<double>(whole.value) * scale + static_cast<double>(part.value)) / scale;
  return {negative ? -value : value, next};
}

}  // namespace alea
