#include "alea/io/text_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/line_parser.hpp"
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
    const std::size_t place = chunk.first_point + point;
    if (table.image_columns > 0) {
      cloud.rows[at + point] = static_cast<int>(place / table.image_columns);
      cloud.columns[at + point] = static_cast<int>(place % table.image_columns);
    }
    if (table.grid_rows > 0) {
      cloud.rows[at + point] = static_cast<int>(place % table.grid_rows);
      cloud.columns[at + point] = static_cast<int>(place / table.grid_rows);
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
