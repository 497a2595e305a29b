#include "alea/io/text_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <exception>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/text_lines.hpp"

namespace alea {
namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 18;
constexpr std::size_t batch_bytes = std::size_t{1} << 26;

// True where a line of data, rather than a blank one or a comment, starts at the front of `text`.
bool starts_data(const TextTable& table, std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos || text[first] == '\n') return false;
  if (!table.comments) return true;
  return text[first] != '#' && text.substr(first, 2) != "//";
}

struct Chunk {
  std::string_view text;
  std::size_t lines = 0;
  std::size_t points = 0;
  std::size_t first_line = 0;
  std::size_t first_point = 0;
};

// Cuts text at line ends into pieces of about chunk_bytes.
std::vector<Chunk> cut(std::string_view text) {
  std::vector<Chunk> chunks;
  while (!text.empty()) {
    std::size_t size = std::min(text.size(), chunk_bytes);
    if (size < text.size()) {
      const auto end = text.find('\n', size - 1);
      size = end == std::string_view::npos ? text.size() : end + 1;
    }
    chunks.push_back({text.substr(0, size)});
    text.remove_prefix(size);
  }
  return chunks;
}

void count_lines(const TextTable& table, Chunk& chunk) {
  for (std::size_t at = 0; at < chunk.text.size();) {
    ++chunk.lines;
    if (starts_data(table, chunk.text.substr(at))) ++chunk.points;
    at = line_at(chunk.text, at).next;
  }
}

class LineParser {
 public:
  LineParser(const TextTable& table, const TextPlace& place, Cloud& cloud)
      : table_(table), place_(place), cloud_(cloud), roles_(roles_of(table.names)) {
    for (const char c : {' ', '\t', '\r'}) blank_[static_cast<unsigned char>(c)] = true;
  }

  // Parses the line at `at`; returns where the next one starts.
  const char* parse(const char* at, const char* end, std::size_t number, std::size_t point) const {
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
    if (at != end && *at == table_.separator) skip_blanks(++at, end);
    if (at != end && *at != '\n')
      throw input_error(fmt::format("{}: line {}: more than the {} values expected", place_.path,
                                    number, roles_.size()));
    return at == end ? at : at + 1;
  }

 private:
  bool is_blank(char c) const { return blank_[static_cast<unsigned char>(c)]; }
  bool ends_value(char c) const { return is_blank(c) || c == '\n' || c == table_.separator; }
  void skip_blanks(const char*& at, const char* end) const {
    while (at != end && is_blank(*at)) ++at;
  }

  // Moves to where the value of column c begins.
  void to_column(const char*& at, const char* end, std::size_t number, std::size_t c) const {
    skip_blanks(at, end);
    const bool separated = at != end && table_.separator != 0 && c > 0;
    if (separated && *at == table_.separator) {
      skip_blanks(++at, end);
      return;
    }
    if (separated && *at != '\n')
      throw input_error(fmt::format("{}: line {}: expected '{}' before column {}", place_.path,
                                    number, table_.separator, c + 1));
    if (at == end || *at == '\n')
      throw input_error(fmt::format("{}: line {}: {} values, expected {}", place_.path, number, c,
                                    roles_.size()));
  }

  // Moves behind a value that is not wanted: a text in quotation marks, or all up to a separator.
  void skip_text(const char*& at, const char* end) const {
    if (at != end && *at == '"')
      at = std::find_if(at + 1, end, [](char c) { return c == '"' || c == '\n'; });
    const char* const from = at;
    at = std::find_if(from, end, [&](char c) {
      return c == '\n' || (table_.separator != 0 ? c == table_.separator : is_blank(c));
    });
  }

  // The values behind the count of a list (PLY).
  void skip_list(double count, const char*& at, const char* end, std::size_t number,
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

  double next_value(const char*& at, const char* end, std::size_t number, std::size_t c) const {
    const NumberText read = read_number(at, end);
    if (read.end == at || (read.end != end && !ends_value(*read.end))) {
      const char* const word =
          std::find_if(at, end, [&](char letter) { return ends_value(letter); });
      throw input_error(fmt::format("{}: line {}: '{}' is not a number (column {})", place_.path,
                                    number, std::string(at, word).substr(0, 40), c + 1));
    }
    at = read.end;
    return read.value;
  }

  void store(FieldRole role, std::size_t c, double value, std::size_t i) const {
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
      cloud_.colours[i] = unpacked(as_float, value);
    } else if (role <= nz) {
      if (!cloud_.normals.empty())
        cloud_.normals[i][axis - static_cast<int>(nx)] = static_cast<float>(value);
    } else if (!cloud_.rows.empty()) {
      const int index = std::abs(value) < 2e9 ? static_cast<int>(value) : -1;
      (role == row ? cloud_.rows : cloud_.columns)[i] = index;
    }
  }

  std::uint16_t colour(double value) const {
    const double top = table_.float_colours ? 1 : table_.byte_colours ? 255 : 65535;
    const double clamped = std::isfinite(value) ? std::clamp(value, 0.0, top) : 0;
    return static_cast<std::uint16_t>(std::lround(clamped * (65535 / top)));
  }

  static Colour unpacked(bool as_float, double value) {
    if (!std::isfinite(value) || std::abs(value) > 4294967295.0) return {};
    return unpacked_colour(as_float ? std::bit_cast<std::uint32_t>(static_cast<float>(value))
                                    : static_cast<std::uint32_t>(static_cast<std::int64_t>(value)));
  }

  const TextTable& table_;
  const TextPlace& place_;
  Cloud& cloud_;
  std::vector<std::optional<FieldRole>> roles_;
  std::array<bool, 256> blank_{};
};

DroppedPoints parse_chunk(const LineParser& parser, const TextTable& table, const Chunk& chunk,
                          Cloud& cloud, std::size_t at) {
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
    if (table.grid_rows > 0) {
      cloud.rows[at + point] = static_cast<int>((chunk.first_point + point) % table.grid_rows);
      cloud.columns[at + point] = static_cast<int>((chunk.first_point + point) / table.grid_rows);
      if (cloud.positions[at + point].isZero(0)) {
        cloud.positions[at + point].x() = std::nan("");
        ++dropped.missing;
      }
    }
    ++point;
  }
  return dropped;
}

// The error of the first bad line is thrown, whichever thread met one first.
void parse_batch(const TextTable& table, const TextPlace& place, const std::vector<Chunk>& chunks,
                 CloudSink& sink) {
  std::vector<std::size_t> sizes;
  for (const Chunk& chunk : chunks) sizes.push_back(chunk.points);
  std::vector<std::exception_ptr> errors(chunks.size());
  sink.append_pieces(sizes, [&](Cloud& cloud, std::size_t at, std::size_t piece) {
    try {
      const LineParser parser(table, place, cloud);
      return parse_chunk(parser, table, chunks[piece], cloud, at);
    } catch (const Error&) {
      errors[piece] = std::current_exception();
      return DroppedPoints{};
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace

void widen_byte_colours(Cloud& cloud) {
  for (const Colour& colour : cloud.colours)
    if (*std::max_element(colour.begin(), colour.end()) > 255) return;
  for (Colour& colour : cloud.colours)
    for (std::uint16_t& value : colour) value = static_cast<std::uint16_t>(value * 257);
}

std::size_t read_text_table(const TextTable& table, std::string_view text, const TextPlace& place,
                            std::size_t limit, CloudSink& sink,
                            const std::function<void(std::size_t)>& release) {
  std::size_t done = 0;
  std::size_t line = place.first_line;
  for (std::size_t offset = 0; offset < text.size() && done < limit;) {
    std::string_view batch = text.substr(offset, batch_bytes);
    if (offset + batch.size() < text.size()) {
      const TextLine last = line_at(text, offset + batch.size() - 1);
      batch = text.substr(offset, last.next - offset);
    }
    std::vector<Chunk> chunks = cut(batch);
    parallel_chunks(chunks.size(), 1,
                    [&](std::size_t c, std::size_t) { count_lines(table, chunks[c]); });
    for (Chunk& chunk : chunks) {
      chunk.first_line = line;
      chunk.first_point = done;
      chunk.points = std::min(chunk.points, limit - done);
      line += chunk.lines;
      done += chunk.points;
    }
    if (offset == 0 && !batch.empty()) {
      // The first batch tells how many lines to expect.
      const double batches = static_cast<double>(text.size()) / static_cast<double>(batch.size());
      const auto expected = static_cast<std::size_t>(static_cast<double>(done) * batches * 1.02);
      sink.reserve(std::min(limit, expected));
    }
    parse_batch(table, place, chunks, sink);
    offset += batch.size();
    if (release) release(offset);
  }
  return done;
}

}  // namespace alea
