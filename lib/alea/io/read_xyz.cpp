#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alea/core/error.hpp"
#include "alea/io/cloud_sink.hpp"
#include "alea/io/formats.hpp"
#include "alea/io/text_columns.hpp"
#include "alea/io/text_lines.hpp"

namespace alea {
namespace {

using Words = std::vector<std::string_view>;
using Names = std::vector<std::string>;

struct Start {
  Names names;             ///< of a header line, if there is one
  Words first;             ///< values of the first data line
  std::size_t offset = 0;  ///< of the first data line
  std::size_t line = 1;
};

bool all_numbers(const Words& words) {
  return std::all_of(words.begin(), words.end(),
                     [](std::string_view word) { return parse_number(word).has_value(); });
}

Names names_in(Words words) {
  Names names;
  for (const std::string_view word : words) {
    std::string name(word);
    std::erase(name, '"');
    names.push_back(name);
  }
  return names;
}

// Looks for the first line of numbers; a line of names before it, commented out or not, is the
// header.
Start find_start(const InputFile& file) {
  Start start;
  const std::string_view text = file.bytes();
  if (text.substr(0, std::min<std::size_t>(text.size(), 4096)).find('\0') != text.npos)
    throw input_error(
        fmt::format("{}: line 1: binary data; expected columns of numbers", file.path()));
  for (std::size_t line = 1, at = 0; at < text.size(); ++line) {
    const TextLine here = line_at(text, at);
    if (here.text.size() > 65536)
      throw input_error(fmt::format(
          "{}: line {}: more than 65536 bytes; expected columns of numbers", file.path(), line));
    Words words = split_values(here.text);
    const bool comment =
        !words.empty() && (words[0].starts_with('#') || words[0].starts_with("//"));
    if (comment) {
      words[0].remove_prefix(words[0].starts_with('#') ? 1 : 2);
      if (words[0].empty()) words.erase(words.begin());
      if (const Names names = names_in(words); channels_of(names).positions) start.names = names;
    } else if (!words.empty() && all_numbers(words)) {
      start.first = words;
      start.offset = at;
      start.line = line;
      return start;
    } else if (!words.empty()) {
      const Names names = names_in(words);
      if (!channels_of(names).positions || !start.names.empty())
        throw input_error(fmt::format(
            "{}: line {}: neither numbers nor a line of column names with x, y and z; name the "
            "columns with --columns x,y,z,...",
            file.path(), line));
      start.names = names;
    }
    at = here.next;
  }
  start.offset = text.size();
  return start;
}

bool is_byte(std::string_view word) {
  const std::optional<double> value = parse_number(word);
  return value && *value >= 0 && *value <= 255 && *value == std::floor(*value);
}

// What columns without names usually are.
Names usual_names(const Words& first) {
  const std::size_t n = first.size();
  Names names{"x", "y", "z"};
  if (n == 4) names = {"x", "y", "z", "intensity"};
  if (n == 6) {
    const bool colour = is_byte(first[3]) && is_byte(first[4]) && is_byte(first[5]);
    const bool unit = std::all_of(first.begin() + 3, first.end(), [](std::string_view word) {
      return std::abs(parse_number(word).value_or(2)) <= 1;
    });
    names = colour && !unit ? Names{"x", "y", "z", "red", "green", "blue"}
                            : Names{"x", "y", "z", "nx", "ny", "nz"};
  }
  if (n == 7) names = {"x", "y", "z", "intensity", "red", "green", "blue"};
  for (std::size_t i = names.size(); i < n; ++i) names.push_back(fmt::format("column_{}", i + 1));
  return names;
}

Names column_names(const InputFile& file, const Start& start, const ReadOptions& options) {
  if (start.first.empty() && options.columns.empty() && start.names.empty()) return {"x", "y", "z"};
  Names names = options.columns;
  if (names.empty()) names = start.names.empty() ? usual_names(start.first) : start.names;
  if (!start.first.empty() && names.size() != start.first.size())
    throw input_error(fmt::format(
        "{}: line {}: {} values for {} columns ({}); name the columns with "
        "--columns x,y,z,...",
        file.path(), start.line, start.first.size(), names.size(), fmt::join(names, ",")));
  if (!channels_of(names).positions)
    throw input_error(fmt::format("{}: no columns x, y and z among {}; a scan needs coordinates",
                                  file.path(), fmt::join(names, ",")));
  return names;
}

}  // namespace

ScanFile read_xyz(const InputFile& file, const ReadOptions& options) {
  const Start start = find_start(file);
  ScanFile scan;
  scan.fields = column_names(file, start, options);
  TextTable table;
  table.names = scan.fields;
  table.commas = true;
  table.comments = true;
  CloudSink sink(channels_of(table.names), options);
  read_text_table(table, file.bytes().substr(start.offset), {file.path(), start.line}, SIZE_MAX,
                  sink, [&](std::size_t done) { file.release_before(start.offset + done); });
  scan.cloud = sink.take();
  widen_byte_colours(scan.cloud);
  return scan;
}

}  // namespace alea
