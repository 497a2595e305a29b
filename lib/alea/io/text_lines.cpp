#include "alea/io/text_lines.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>

#include "alea/core/error.hpp"

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

NumberText read_any_number(const char* at, const char* end) {
  double value = 0;
  const auto [next, error] = std::from_chars(at, end, value);
  if (error == std::errc::result_out_of_range) value = std::numeric_limits<double>::quiet_NaN();
  return {value, next};
}

}  // namespace

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

std::optional<double> parse_number(std::string_view word) {
  const char* const end = word.data() + word.size();
  const NumberText read = read_number(word.data(), end);
  if (word.empty() || read.end != end) return std::nullopt;
  return read.value;
}

}  // namespace alea
