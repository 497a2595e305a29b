#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "alea/io/cloud_sink.hpp"
#include "alea/io/field_role.hpp"

namespace alea {

/// The columns of a text table. Values are separated by blanks and tabs, or by `separator`.
struct TextTable {
  std::vector<std::string> names;  ///< one for each column; a name without a role is skipped
  std::vector<bool> lists;         ///< a column that holds a count and as many values (PLY)
  std::vector<bool> packed_float;  ///< a packed colour that is written as a float (PCD)
  char separator = '\0';           ///< a comma or semicolon that stands between any two values
  bool free_text = false;          ///< a column without a role may hold any text
  std::size_t grid_rows = 0;  ///< of a PTX grid: points come column by column, 0 0 0 is no return
  std::size_t image_columns = 0;  ///< of points that lie row by row (PCD)
  bool comments = false;          ///< lines that begin with # or // are skipped
  bool byte_colours = false;      ///< colours are 0 to 255 and are widened (v * 257)
  bool float_colours = false;     ///< colours are 0 to 1; neither: 0 to 65535
};

/// Where a table stands in its file, for messages.
struct TextPlace {
  std::string path;
  std::size_t first_line = 1;  ///< number of the table's first line in the file
};

/// Reads up to `limit` data lines (blank ones are skipped) into the sink, in parallel. Returns how
/// many there were. `release(offset)`, if any, is told how far into `text` the work is done. Throws
/// Error(input) with file and line for a value that is not a number and for a line with too few or
/// too many values.
std::size_t read_text_table(const TextTable& table, std::string_view text, const TextPlace& place,
                            std::size_t limit, CloudSink& sink,
                            const std::function<void(std::size_t)>& release = {});

/// Widens colours read as 0 to 65535 where no value exceeds 255 (v * 257): for tables that do not
/// say which of the two they hold.
void widen_byte_colours(Cloud& cloud);

}  // namespace alea
