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

// Cuts text at line ends into pieces of about chunk_bytes.
std::vector<TextChunk> cut(std::string_view text) {
  std::vector<TextChunk> chunks;
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

void count_lines(const TextTable& table, TextChunk& chunk) {
  for (std::size_t at = 0; at < chunk.text.size();) {
    ++chunk.lines;
    if (starts_data(table, chunk.text.substr(at))) ++chunk.points;
    at = line_at(chunk.text, at).next;
  }
}

// The error of the first bad line is thrown, whichever thread met one first.
void parse_batch(const TextTable& table, const TextPlace& place,
                 const std::vector<TextChunk>& chunks, CloudSink& sink) {
  std::vector<std::size_t> sizes;
  for (const TextChunk& chunk : chunks) sizes.push_back(chunk.points);
  std::vector<std::exception_ptr> errors(chunks.size());
  sink.append_pieces(sizes, [&](Cloud& cloud, std::size_t at, std::size_t piece) {
    try {
      return parse_chunk(table, place, chunks[piece], cloud, at);
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
    std::vector<TextChunk> chunks = cut(batch);
    parallel_chunks(chunks.size(), 1,
                    [&](std::size_t c, std::size_t) { count_lines(table, chunks[c]); });
    for (TextChunk& chunk : chunks) {
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
