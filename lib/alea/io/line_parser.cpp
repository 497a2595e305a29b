#include "alea/io/line_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "alea/core/error.hpp"
#include "alea/io/field_role.hpp"
#include "alea/io/text_lines.hpp"

namespace alea {
namespace {

Colour unpacked_value(bool as_float, double value) {
  if (!std::isfinite(value) || std::abs(value) > 4294967295.0) return {};
  return unpacked_colour(as_float ? std::bit_cast<std::uint32_t>(static_cast<float>(value))
                                  : static_cast<std::uint32_t>(static_cast<std::int64_t>(value)));
}

// Calls within a shared library go through a table unless they stay in one source: this class does.
class LineParser {
 public:
  LineParser(const TextTable& table, const TextPlace& place, Cloud& cloud);

  // Parses the line at `at`, which has this number in the file, as this point; returns where the
  // next line starts.
  const char* parse(const char* at, const char* end, std::size_t number, std::size_t point) const;

 private:
  bool is_blank(char c) const { return blank_[static_cast<unsigned char>(c)]; }
  bool is_separator(char c) const { return static_cast<unsigned char>(c) == separator_; }
  bool ends_value(char c) const { return is_blank(c) || c == '\n' || is_separator(c); }
  void skip_blanks(const char*& at, const char* end) const {
    while (at != end && is_blank(*at)) ++at;
  }
  void to_column(const char*& at, const char* end, std::size_t number, std::size_t c) const;
  void skip_text(const char*& at, const char* end) const;
  void skip_list(double count, const char*& at, const char* end, std::size_t number,
                 std::size_t c) const;
  double next_value(const char*& at, const char* end, std::size_t number, std::size_t c) const;
  void store(FieldRole role, std::size_t c, double value, std::size_t i) const;
  std::uint16_t colour(double value) const;

  const TextTable& table_;
  const TextPlace& place_;
  Cloud& cloud_;
  std::vector<std::optional<FieldRole>> roles_;
  std::array<bool, 256> blank_{};
  int separator_ = -1;
};

LineParser::LineParser(const TextTable& table, const TextPlace& place, Cloud& cloud)
    : table_(table), place_(place), cloud_(cloud), roles_(roles_of(table.names)) {
  for (const char c : {' ', '\t', '\r'}) blank_[static_cast<unsigned char>(c)] = true;
  if (table.separator != '\0') separator_ = static_cast<unsigned char>(table.separator);
}

// Moves to where the value of column c begins.
void LineParser::to_column(const char*& at, const char* end, std::size_t number,
                           std::size_t c) const {
  skip_blanks(at, end);
  const bool separated = at != end && separator_ >= 0 && c > 0;
  if (separated && is_separator(*at)) {
    skip_blanks(++at, end);
    return;
  }
  if (separated && *at != '\n')
    throw input_error(fmt::format("{}: line {}: expected '{}' before column {}", place_.path,
                                  number, table_.separator, c + 1));
  if (at == end || *at == '\n')
    throw input_error(
        fmt::format("{}: line {}: {} values, expected {}", place_.path, number, c, roles_.size()));
}

// Moves behind a value that is not wanted: a text in quotation marks, or all up to a separator.
void LineParser::skip_text(const char*& at, const char* end) const {
  if (at != end && *at == '"')
    at = std::find_if(at + 1, end, [](char c) { return c == '"' || c == '\n'; });
  const char* const from = at;
  at = std::find_if(from, end, [&](char c) {
    return c == '\n' || (separator_ >= 0 ? is_separator(c) : is_blank(c));
  });
}

// The values behind the count of a list (PLY).
void LineParser::skip_list(double count, const char*& at, const char* end, std::size_t number,
                           std::size_t c) const {
  if (!(count >= 0) || count != std::floor(count))
    throw input_error(
        fmt::format("{}: line {}: the count of a list is {}; expected a whole "
                    "number (column {})",
                    place_.path, number, count, c + 1));
  for (double i = 0; i < count; ++i) {
    to_column(at, end, number, c);
    next_value(at, end, number, c);
  }
}

double LineParser::next_value(const char*& at, const char* end, std::size_t number,
                              std::size_t c) const {
  const NumberText read = read_number(at, end);
  if (read.end == at || (read.end != end && !ends_value(*read.end))) {
    const char* const word = std::find_if(at, end, [&](char letter) { return ends_value(letter); });
    throw input_error(fmt::format("{}: line {}: '{}' is not a number (column {})", place_.path,
                                  number, std::string(at, word).substr(0, 40), c + 1));
  }
  at = read.end;
  return read.value;
}

void LineParser::store(FieldRole role, std::size_t c, double value, std::size_t i) const {
  using enum FieldRole;
  const auto axis = static_cast<int>(role);
  if (role <= z) {
    cloud_.positions[i][axis] = value;
  } else if (role == intensity) {
    cloud_.intensity[i] = static_cast<float>(value);
  } else if (role <= blue) {
    if (!cloud_.colours.empty()) cloud_.colours[i][axis - static_cast<int>(red)] = colour(value);
  } else if (role == rgb) {
    const bool as_float = c < table_.packed_float.size() && table_.packed_float[c];
    cloud_.colours[i] = unpacked_value(as_float, value);
  } else if (role <= nz) {
    if (!cloud_.normals.empty())
      cloud_.normals[i][axis - static_cast<int>(nx)] = static_cast<float>(value);
  } else if (!cloud_.rows.empty()) {
    const int index = std::abs(value) < 2e9 ? static_cast<int>(value) : -1;
    (role == row ? cloud_.rows : cloud_.columns)[i] = index;
  }
}

std::uint16_t LineParser::colour(double value) const {
  const double top = table_.float_colours ? 1 : table_.byte_colours ? 255 : 65535;
  const double clamped = std::isfinite(value) ? std::clamp(value, 0.0, top) : 0;
  return static_cast<std::uint16_t>(std::lround(clamped * (65535 / top)));
}

const char* LineParser::parse(const char* at, const char* end, std::size_t number,
                              std::size_t point) const {
  for (std::size_t c = 0; c < roles_.size(); ++c) {
    to_column(at, end, number, c);
    if (table_.free_text && !roles_[c]) {
      skip_text(at, end);
      continue;
    }
    const double value = next_value(at, end, number, c);
    if (c < table_.lists.size() && table_.lists[c])
      skip_list(value, at, end, number, c);
    else if (roles_[c])
      store(*roles_[c], c, value, point);
  }
  skip_blanks(at, end);
  if (at != end && is_separator(*at)) skip_blanks(++at, end);
  if (at != end && *at != '\n')
    throw input_error(fmt::format("{}: line {}: more than the {} values expected", place_.path,
                                  number, roles_.size()));
  return at == end ? at : at + 1;
}

}  // namespace

bool starts_data(const TextTable& table, std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos || text[first] == '\n') return false;
  if (!table.comments) return true;
  return text[first] != '#' && text.substr(first, 2) != "//";
}

DroppedPoints parse_chunk(const TextTable& table, const TextPlace& place, const TextChunk& chunk,
                          Cloud& cloud, std::size_t at) {
  const LineParser parser(table, place, cloud);
  DroppedPoints dropped;
  const char* from = chunk.text.data();
  const char* const end = from + chunk.text.size();
  std::size_t number = chunk.first_line;
  for (std::size_t point = 0; point < chunk.points; ++number) {
    const auto left = static_cast<std::size_t>(end - from);
    if (!starts_data(table, {from, left})) {
      from += line_at({from, left}, 0).next;
      continue;
    }
    from = parser.parse(from, end, number, at + point);
    const std::size_t index = chunk.first_point + point;
    if (table.image_columns > 0) {
      cloud.rows[at + point] = static_cast<int>(index / table.image_columns);
      cloud.columns[at + point] = static_cast<int>(index % table.image_columns);
    }
    if (table.grid_rows > 0) {
      cloud.rows[at + point] = static_cast<int>(index % table.grid_rows);
      cloud.columns[at + point] = static_cast<int>(index / table.grid_rows);
      if (cloud.positions[at + point].isZero(0)) {
        cloud.positions[at + point].x() = std::nan("");
        ++dropped.missing;
      }
    }
    ++point;
  }
  return dropped;
}

}  // namespace alea
