#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "alea/io/number_text.hpp"

namespace alea {

/// True for what separates the values of a text table: blank, tab, comma, semicolon (and a carriage
/// return).
inline bool is_separator(char c) {
  return c == ' ' || c == ',' || c == '\t' || c == ';' || c == '\r';
}

/// The line that starts at `offset`, without its end, and the offset of the next one.
struct TextLine {
  std::string_view text;
  std::size_t next;
};
TextLine line_at(std::string_view text, std::size_t offset);

/// The offset of the first character, behind a byte order mark of UTF-8. Throws Error(input) for
/// what is no text in lines of 8-bit characters: zero bytes, UTF-16, lines that end in CR alone.
std::size_t start_of_text(const std::string& path, std::string_view bytes);

/// The values of a line, split at blanks, tabs, commas or semicolons.
std::vector<std::string_view> split_values(std::string_view line);

/// A whole word as a number (a leading + is allowed); empty where it is none.
std::optional<double> parse_number(std::string_view word);

}  // namespace alea
