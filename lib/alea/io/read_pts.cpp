#include <fmt/format.h>

#include <charconv>

#include "alea/core/error.hpp"
#include "alea/io/cloud_sink.hpp"
#include "alea/io/formats.hpp"
#include "alea/io/text_columns.hpp"
#include "alea/io/text_lines.hpp"

namespace alea {
namespace {

// The columns of a line of PTS or PTX.
std::vector<std::string> names_for(std::size_t values, const std::string& place) {
  switch (values) {
    case 3:
      return {"x", "y", "z"};
    case 4:
      return {"x", "y", "z", "intensity"};
    case 6:
      return {"x", "y", "z", "red", "green", "blue"};
    case 7:
      return {"x", "y", "z", "intensity", "red", "green", "blue"};
    default:
      throw input_error(
          fmt::format("{}: {} values; expected x y z [intensity] [red green blue]", place, values));
  }
}

// Walks over a text line by line, blank lines left out.
class Cursor {
 public:
  Cursor(const InputFile& file) : file_(file), offset_(start_of_text(file.path(), file.bytes())) {
    skip_blank();
  }

  bool at_end() const { return offset_ >= file_.bytes().size(); }
  std::string place() const { return fmt::format("{}: line {}", file_.path(), line_); }
  std::vector<std::string_view> peek() const {
    return split_values(line_at(file_.bytes(), offset_).text);
  }
  std::vector<std::string_view> next() {
    const TextLine here = line_at(file_.bytes(), offset_);
    advance(here);
    skip_blank();
    return split_values(here.text);
  }

  std::size_t count(const char* what) {
    const std::string where = place();
    const std::vector<std::string_view> words = at_end() ? decltype(next()){} : next();
    std::size_t value = 0;
    if (words.size() == 1) {
      const auto [end, error] =
          std::from_chars(words[0].data(), words[0].data() + words[0].size(), value);
      if (error == std::errc{} && end == words[0].data() + words[0].size()) return value;
    }
    throw input_error(fmt::format("{}: expected {} alone on the line", where, what));
  }

  std::vector<double> numbers(std::size_t n) {
    const std::string where = place();
    const std::vector<std::string_view> words = at_end() ? decltype(next()){} : next();
    std::vector<double> values;
    for (const std::string_view word : words)
      if (const std::optional<double> value = parse_number(word)) values.push_back(*value);
    if (words.size() != n || values.size() != n)
      throw input_error(fmt::format("{}: expected {} numbers", where, n));
    return values;
  }

  // Reads `points` lines as a table; of a grid with so many rows, where that is not 0.
  Cloud table(std::size_t points, std::size_t grid_rows, const ReadOptions& options,
              std::vector<std::string>& fields) {
    const std::size_t begin = offset_;
    fields = {"x", "y", "z"};
    if (points == 0) return {};
    if (at_end())
      throw input_error(fmt::format("{}: {} points declared, the file ends", place(), points));
    fields = names_for(peek().size(), place());
    TextTable table;
    table.names = fields;
    table.grid_rows = grid_rows;
    Channels channels = channels_of(fields);
    channels.grid = grid_rows > 0;
    CloudSink sink(channels, options);
    const std::size_t first_line = line_;
    const std::size_t end = end_of(points);
    read_text_table(table, file_.bytes().substr(begin, end - begin), {file_.path(), first_line},
                    points, sink, [&](std::size_t done) { file_.release_before(begin + done); });
    Cloud cloud = sink.take();
    widen_byte_colours(cloud);
    return cloud;
  }

 private:
  void advance(const TextLine& line) {
    offset_ = line.next;
    ++line_;
  }
  void skip_blank() {
    while (!at_end()) {
      const TextLine here = line_at(file_.bytes(), offset_);
      if (here.text.find_first_not_of(" \t\r") != std::string_view::npos) return;
      advance(here);
    }
  }
  // Moves behind the next `points` lines.
  std::size_t end_of(std::size_t points) {
    for (std::size_t i = 0; i < points; ++i) {
      if (at_end())
        throw input_error(fmt::format("{}: {} points declared, {} are there", place(), points, i));
      advance(line_at(file_.bytes(), offset_));
      skip_blank();
    }
    return offset_;
  }

  const InputFile& file_;
  std::size_t offset_ = 0;
  std::size_t line_ = 1;
};

// The frame of one PTX scan: rows of numbers for row vectors, so the pose is the transpose.
Eigen::Matrix4d read_pose(Cursor& cursor, double unit_m) {
  for (int i = 0; i < 4; ++i) cursor.numbers(3);  // scanner and its axes: the matrix repeats them
  const std::string where = cursor.place();
  Eigen::Matrix4d pose;
  for (int i = 0; i < 4; ++i) {
    const std::vector<double> row = cursor.numbers(4);
    for (int j = 0; j < 4; ++j) pose(j, i) = row[static_cast<std::size_t>(j)];
  }
  if (!pose.allFinite())
    throw input_error(where + ": a pose that is not finite; expected four lines of four numbers");
  pose.topRightCorner<3, 1>() *= unit_m;
  return pose;
}

}  // namespace

std::vector<ScanFile> read_pts(const InputFile& file, const ReadOptions& options) {
  Cursor cursor(file);
  std::vector<ScanFile> scans;
  do {
    ScanFile scan;
    const std::size_t points = cursor.count("the number of points");
    scan.cloud = cursor.table(points, 0, options, scan.fields);
    scans.push_back(std::move(scan));
    check_scan_count(file.path(), scans.size());
  } while (!cursor.at_end());
  return scans;
}

std::vector<ScanFile> read_ptx(const InputFile& file, const ReadOptions& options) {
  Cursor cursor(file);
  std::vector<ScanFile> scans;
  do {
    ScanFile scan;
    const std::string where = cursor.place();
    const std::size_t columns = cursor.count("the number of columns");
    const std::size_t rows = cursor.count("the number of rows");
    if (rows != 0 && columns > file.bytes().size() / rows)
      throw input_error(
          fmt::format("{}: {} columns of {} rows do not fit into the file", where, columns, rows));
    scan.pose = read_pose(cursor, options.unit_m);
    scan.cloud = cursor.table(columns * rows, rows, options, scan.fields);
    scan.cloud.scanner_position = Eigen::Vector3d::Zero();
    scans.push_back(std::move(scan));
    check_scan_count(file.path(), scans.size());
  } while (!cursor.at_end());
  return scans;
}

}  // namespace alea
