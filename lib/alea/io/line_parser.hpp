#pragma once

#include <cstddef>
#include <string_view>

#include "alea/core/cloud.hpp"
#include "alea/io/text_columns.hpp"

namespace alea {

/// Whole lines of a text table.
struct TextChunk {
  std::string_view text;
  std::size_t lines = 0;
  std::size_t points = 0;  ///< lines of data among them, or as many as are wanted
  std::size_t first_line = 0;
  std::size_t first_point = 0;
};

/// True where a line of data, rather than a blank one or a comment, starts at the front of `text`.
bool starts_data(const TextTable& table, std::string_view text);

/// Parses the points of a chunk into the cloud's arrays from index `at` on. Throws Error(input)
/// with file, line and column.
DroppedPoints parse_chunk(const TextTable& table, const TextPlace& place, const TextChunk& chunk,
                          Cloud& cloud, std::size_t at);

}  // namespace alea
