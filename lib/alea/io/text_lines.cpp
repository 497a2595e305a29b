#include "alea/io/text_lines.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>

#include "alea/core/error.hpp"
#include "alea/io/byte_order.hpp"

namespace alea {

TextLine line_at(std::string_view text, std::size_t offset) {
  const void* found = std::memchr(text.data() + offset, '\n', text.size() - offset);
  if (found == nullptr) return {text.substr(offset), text.size()};
  const auto end = static_cast<std::size_t>(static_cast<const char*>(found) - text.data());
  return {text.substr(offset, end - offset), end + 1};
}

std::size_t start_of_text(const std::string& path, std::string_view bytes) {
  const auto refuse = [&](const char* what) {
    throw input_error(fmt::format("{}: line 1: {}; expected lines of numbers", path, what));
  };
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    refuse("UTF-16 text, which is not read; save it as UTF-8");
  const std::string_view front = bytes.substr(0, 4096);
  if (front.find('\0') != std::string_view::npos) refuse("binary data");
  const auto end = front.find_first_of("\r\n");
  if (end != std::string_view::npos && front[end] == '\r') {
    const auto next = bytes.find_first_not_of('\r', end);
    if (next != std::string_view::npos && bytes[next] != '\n')
      refuse("a line that ends in CR alone; save it with the line ends of Unix or Windows");
  }
  return bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
}

std::vector<std::string_view> split_values(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < line.size();) {
    while (at < line.size() && is_separator(line[at])) ++at;
    const std::size_t begin = at;
    while (at < line.size() && !is_separator(line[at])) ++at;
    if (at > begin) words.push_back(line.substr(begin, at - begin));
  }
  return words;
}

namespace {

// Powers of ten that a double holds exactly.
constexpr std::array<double, 23> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

NumberText read_any_number(const char* at, const char* end) {
  double value = 0;
  const auto [next, error] = std::from_chars(at, end, value);
  if (error == std::errc::result_out_of_range) value = std::numeric_limits<double>::quiet_NaN();
  return {value, next};
}

// Up to 15 digits and their power of ten are exact, so one division rounds correctly
// (Clinger 1990, How to read floating point numbers accurately). The rest is from_chars' work.
NumberText read_by_digits(const char* at, const char* end) {
  const char* const start = at;
  if (at != end && *at == '+') ++at;
  const char* const number = at;
  const bool negative = at != end && *at == '-';
  if (negative) {
    if (at != start) return {0, start};
    ++at;
  }
  std::uint64_t digits = 0;
  const char* const first = at;
  for (; at != end && *at >= '0' && *at <= '9'; ++at) digits = digits * 10 + (*at - '0');
  std::size_t count = at - first;
  std::size_t decimals = 0;
  if (at != end && *at == '.') {
    const char* const point = at++;
    for (; at != end && *at >= '0' && *at <= '9'; ++at) digits = digits * 10 + (*at - '0');
    decimals = at - point - 1;
    count += decimals;
  }
  const bool plain = count > 0 && count <= 15 && (at == end || (*at != 'e' && *at != 'E'));
  if (!plain) {
    const NumberText any = read_any_number(number, end);
    return any.end == number ? NumberText{0, start} : any;
  }
  const double value = static_cast<double>(digits) / powers_of_ten[decimals];
  return {negative ? -value : value, at};
}

struct Digits {
  std::uint64_t value;
  unsigned count;
};

// The digits at the front of eight bytes, all at once: neighbours become numbers of two digits,
// then of four and eight (Lemire 2021, Number parsing at a gigabyte per second).
Digits leading_digits(const char* at) {
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

}  // namespace

NumberText read_number(const char* at, const char* end) {
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

std::optional<double> parse_number(std::string_view word) {
  const char* const end = word.data() + word.size();
  const NumberText read = read_number(word.data(), end);
  if (word.empty() || read.end != end) return std::nullopt;
  return read.value;
}

}  // namespace alea
