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
  char separator = '\0';   ///< between its values; none: blanks
  std::size_t offset = 0;  ///< of the first data line
  std::size_t line = 1;
};

bool is_number(std::string_view word) {
  return parse_number(word).has_value();
}

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// What stands between the values of a line: the first of these that is in it, else blanks.
char separator_of(std::string_view line, std::string_view candidates) {
  for (const char c : candidates)
    if (line.find(c) != std::string_view::npos) return c;
  return '\0';
}

// The values between separators, none of them in quotation marks; one behind the last separator is
// left out where it is empty.
Words cells_of(std::string_view line, char separator) {
  if (separator == '\0') return split_values(line);
  Words cells;
  for (std::string_view left = line;;) {
    const auto quoted = without_blanks(left).starts_with('"') ? left.find('"', left.find('"') + 1)
                                                              : std::string_view::npos;
    const auto at = left.find(separator, quoted == std::string_view::npos ? 0 : quoted);
    cells.push_back(without_blanks(left.substr(0, at)));
    if (at == std::string_view::npos) break;
    left.remove_prefix(at + 1);
  }
  if (cells.back().empty()) cells.pop_back();
  return cells;
}

// A name may hold blanks where something else separates the names.
Names names_in(std::string_view line) {
  Names names;
  for (const std::string_view cell : cells_of(line, separator_of(line, ";,\t"))) {
    std::string name(cell);
    std::erase(name, '"');
    names.push_back(name);
  }
  return names;
}

// True where every value that the names give a role is a number; without names all have to be.
bool is_data(const Words& cells, const Names& names) {
  const std::vector<std::optional<FieldRole>> roles = roles_of(names);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if ((names.empty() || (i < roles.size() && roles[i])) && !is_number(cells[i])) return false;
  return true;
}

std::string_view checked_line(const InputFile& file, std::size_t line, std::string_view text) {
  if (text.size() > 65536)
    throw input_error(fmt::format("{}: line {}: more than 65536 bytes; expected columns of numbers",
                                  file.path(), line));
  return without_blanks(text);
}

// What is wrong with a line that is neither data nor a header.
const char* complaint_about(std::string_view text) {
  const Words words = split_values(text);
  const Words cells = cells_of(text, separator_of(text, ";,"));
  if (!std::all_of(words.begin(), words.end(), is_number))
    return "neither numbers nor a line of column names with x, y and z; name the columns with "
           "--columns x,y,z,...";
  if (std::find(cells.begin(), cells.end(), std::string_view()) != cells.end())
    return "an empty value between separators; expected a number in each column";
  return "commas beside another separator (decimal commas?); write numbers with points, as 1.5";
}

// Looks for the first line of numbers. A line of names before it, commented out or not, is the
// header; where the user names the columns, one line of other text may be.
Start find_start(const InputFile& file, const Names& columns) {
  Start start;
  const std::string_view text = file.bytes();
  bool header = false;
  std::size_t line = 1;
  for (std::size_t at = start_of_text(file.path(), text), next = 0; at < text.size();
       at = next, ++line) {
    std::string_view here = line_at(text, at).text;
    next = line_at(text, at).next;
    here = checked_line(file, line, here);
    if (here.empty()) continue;
    if (here.starts_with('#') || here.starts_with("//")) {
      here.remove_prefix(here.starts_with('#') ? 1 : 2);
      if (const Names names = names_in(here); channels_of(names).positions) start.names = names;
      continue;
    }
    const char separator = separator_of(here, ";,");
    const Words cells = cells_of(here, separator);
    const Names& names = columns.empty() ? start.names : columns;
    if (is_data(cells, names) || (header && !names.empty())) {
      start.first = cells;
      start.separator = separator;
      start.offset = at;
      start.line = line;
      return start;
    }
    header = true;
    start.names = names_in(here);
    if (columns.empty() && !channels_of(start.names).positions)
      throw input_error(fmt::format("{}: line {}: {}", file.path(), line, complaint_about(here)));
  }
  start.offset = text.size();
  return start;
}

// What the values of a column have in common, in the first thousand lines.
struct Look {
  bool whole = true;    ///< whole numbers, 0 to 65535
  bool unit = true;     ///< at most 1 in size
  bool nothing = true;  ///< zeros
};

std::vector<Look> looks_of(const InputFile& file, const Start& start) {
  std::vector<Look> looks(start.first.size());
  const std::string_view text = file.bytes();
  for (std::size_t at = start.offset, lines = 0; at < text.size() && lines < 1000; ++lines) {
    const TextLine line = line_at(text, at);
    at = line.next;
    const Words cells = cells_of(without_blanks(line.text), start.separator);
    if (cells.size() != looks.size()) continue;  // blank, a comment, or the parser's error
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const double value = parse_number(cells[c]).value_or(std::nan(""));
      looks[c].whole &= value >= 0 && value <= 65535 && value == std::floor(value);
      looks[c].unit &= std::abs(value) <= 1;
      looks[c].nothing &= value == 0;
    }
  }
  return looks;
}

// What columns without names usually are; what could be this or that is left out.
Names usual_names(const std::vector<Look>& looks) {
  const std::size_t n = looks.size();
  const auto three = [&](std::size_t first, bool Look::*what) {
    return looks[first].*what && looks[first + 1].*what && looks[first + 2].*what;
  };
  Names names{"x", "y", "z"};
  const auto add = [&](const Names& more) { names.insert(names.end(), more.begin(), more.end()); };
  const Names colours{"red", "green", "blue"};
  if (n == 4) add({"intensity"});
  if (n == 6 && three(3, &Look::whole) && !three(3, &Look::unit)) add(colours);
  if (n == 6 && three(3, &Look::unit) && !three(3, &Look::nothing)) add({"nx", "ny", "nz"});
  if (n == 7 && three(4, &Look::whole)) {
    add({"intensity"});
    add(colours);
  } else if (n == 7 && three(3, &Look::whole)) {
    add(colours);
    add({"intensity"});
  }
  for (std::size_t i = names.size(); i < n; ++i) names.push_back(fmt::format("column_{}", i + 1));
  return names;
}

Names column_names(const InputFile& file, const Start& start, const ReadOptions& options) {
  if (start.first.empty() && options.columns.empty() && start.names.empty()) return {"x", "y", "z"};
  Names names = options.columns;
  if (names.empty()) names = start.names.empty() ? usual_names(looks_of(file, start)) : start.names;
  if (!start.first.empty() && names.size() != start.first.size())
    throw input_error(fmt::format(
        "{}: line {}: {} values for {} columns ({}); name the columns with "
        "--columns x,y,z,...",
        file.path(), start.line, start.first.size(), names.size(), fmt::join(names, ",")));
  check_names(file.path(), names);
  if (!channels_of(names).positions)
    throw input_error(fmt::format("{}: no columns x, y and z among {}; a scan needs coordinates",
                                  file.path(), fmt::join(names, ",")));
  return names;
}

}  // namespace

ScanFile read_xyz(const InputFile& file, const ReadOptions& options) {
  const Start start = find_start(file, options.columns);
  ScanFile scan;
  scan.fields = column_names(file, start, options);
  TextTable table;
  table.names = scan.fields;
  table.separator = start.separator;
  table.free_text = true;
  table.comments = true;
  CloudSink sink(channels_of(table.names), options);
  read_text_table(table, file.bytes().substr(start.offset), {file.path(), start.line}, SIZE_MAX,
                  sink, [&](std::size_t done) { file.release_before(start.offset + done); });
  scan.cloud = sink.take();
  widen_byte_colours(scan.cloud);
  return scan;
}

}  // namespace alea
