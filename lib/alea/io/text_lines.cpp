#include "alea/io/text_lines.hpp"

#include <charconv>
#include <cstring>

namespace alea {

TextLine line_at(std::string_view text, std::size_t offset) {
  const void* found = std::memchr(text.data() + offset, '\n', text.size() - offset);
  if (found == nullptr) return {text.substr(offset), text.size()};
  const auto end = static_cast<std::size_t>(static_cast<const char*>(found) - text.data());
  return {text.substr(offset, end - offset), end + 1};
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

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [next, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || next != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace alea
