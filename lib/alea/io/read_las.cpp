#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "alea/core/error.hpp"
#include "alea/io/byte_order.hpp"
#include "alea/io/cloud_sink.hpp"
#include "alea/io/formats.hpp"
#include "alea/io/record_columns.hpp"
#include "alea/io/text_columns.hpp"

namespace alea {
namespace {

// Of the point formats 0 to 10 (LAS 1.4 R15, tables 7 to 17): bytes of a record, and where its
// colours stand.
constexpr std::array<std::size_t, 11> record_sizes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
constexpr std::array<std::size_t, 11> colour_offsets{0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};

struct LasHeader {
  std::size_t format = 0;
  std::uint64_t points = 0;
  std::size_t record_size = 0;
  std::size_t first_point = 0;
  Eigen::Vector3d scale;
  Eigen::Vector3d offset;
};

[[noreturn]] void fail(const InputFile& file, std::size_t byte, const std::string& expectation) {
  throw input_error(fmt::format("{}: byte {}: {}", file.path(), byte, expectation));
}

// The variable length records stand between the header and the points.
void check_records(const InputFile& file, std::size_t header_size, std::size_t first_point) {
  const std::string_view bytes = file.bytes();
  const auto count = load_le<std::uint32_t>(bytes, 100);
  std::size_t at = header_size;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t left = first_point - at;
    const std::size_t size = left < 54 ? 54 : 54 + load_le<std::uint16_t>(bytes, at + 20);
    if (size > left)
      fail(file, 100,
           fmt::format("{} variable length records declared, but record {} runs into the "
                       "points at byte {}",
                       count, i + 1, first_point));
    at += size;
  }
}

LasHeader parse_header(const InputFile& file) {
  const std::string_view bytes = file.bytes();
  if (bytes.size() < 227 || !bytes.starts_with("LASF"))
    fail(file, 0, "expected a LAS header of at least 227 bytes, starting with LASF");
  const int major = bytes[24];
  const int minor = bytes[25];
  if (major != 1 || minor < 0 || minor > 4)
    fail(file, 24, fmt::format("LAS version {}.{}; expected 1.0 to 1.4", major, minor));
  const std::size_t header_size = load_le<std::uint16_t>(bytes, 94);
  LasHeader header;
  header.first_point = load_le<std::uint32_t>(bytes, 96);
  const std::size_t least = minor == 4 ? 375 : minor == 3 ? 235 : 227;
  if (header_size < least || header_size > bytes.size())
    fail(file, 94,
         fmt::format("a header of {} bytes; expected at least {}, inside the file", header_size,
                     least));
  if (header.first_point < header_size || header.first_point > bytes.size())
    fail(file, 96,
         fmt::format("points start at byte {}; expected {} to {}", header.first_point, header_size,
                     bytes.size()));
  check_records(file, header_size, header.first_point);
  header.format = static_cast<unsigned char>(bytes[104]);
  if (header.format & 0xC0)
    fail(file, 104, "the points are compressed (LAZ); write them as LAS first");
  if (header.format >= record_sizes.size())
    fail(file, 104, fmt::format("point format {}; expected 0 to 10", header.format));
  header.record_size = load_le<std::uint16_t>(bytes, 105);
  if (header.record_size < record_sizes[header.format])
    fail(file, 105,
         fmt::format("records of {} bytes; point format {} takes {}", header.record_size,
                     header.format, record_sizes[header.format]));
  header.points = load_le<std::uint32_t>(bytes, 107);
  if (minor == 4 && load_le<std::uint64_t>(bytes, 247) != 0)
    header.points = load_le<std::uint64_t>(bytes, 247);
  const std::size_t space = (bytes.size() - header.first_point) / header.record_size;
  if (header.points > space)
    fail(file, 107,
         fmt::format("{} points of {} bytes declared, {} are there", header.points,
                     header.record_size, space));
  for (int axis = 0; axis < 3; ++axis) {
    header.scale[axis] = load_le<double>(bytes, 131 + 8 * static_cast<std::size_t>(axis));
    header.offset[axis] = load_le<double>(bytes, 155 + 8 * static_cast<std::size_t>(axis));
  }
  if (!header.scale.allFinite() || (header.scale.array() == 0).any())
    fail(file, 131,
         fmt::format("scale factors {} {} {}; expected finite numbers other than 0",
                     header.scale.x(), header.scale.y(), header.scale.z()));
  if (!header.offset.allFinite())
    fail(file, 155,
         fmt::format("offsets {} {} {}; expected finite numbers", header.offset.x(),
                     header.offset.y(), header.offset.z()));
  return header;
}

std::vector<std::string> fields_of(std::size_t format) {
  std::vector<std::string> names{"X",
                                 "Y",
                                 "Z",
                                 "Intensity",
                                 "ReturnNumber",
                                 "NumberOfReturns",
                                 "ScanDirectionFlag",
                                 "EdgeOfFlightLine",
                                 "Classification",
                                 "ScanAngle",
                                 "UserData",
                                 "PointSourceId"};
  if (format == 1 || format >= 3) names.emplace_back("GpsTime");
  if (colour_offsets[format] != 0) names.insert(names.end(), {"Red", "Green", "Blue"});
  if (format == 8 || format == 10) names.emplace_back("NearInfrared");
  if (format == 4 || format == 5 || format >= 9) names.emplace_back("WavePacket");
  return names;
}

RecordTable table_of(const LasHeader& header) {
  const std::size_t size = header.record_size;
  using enum FieldRole;
  RecordTable table;
  table.columns = {{x, ScalarType::int32, 0, size},
                   {y, ScalarType::int32, 4, size},
                   {z, ScalarType::int32, 8, size},
                   {intensity, ScalarType::uint16, 12, size}};
  const std::size_t colour = colour_offsets[header.format];
  if (colour != 0) {
    table.columns.push_back({red, ScalarType::uint16, colour, size});
    table.columns.push_back({green, ScalarType::uint16, colour + 2, size});
    table.columns.push_back({blue, ScalarType::uint16, colour + 4, size});
  }
  return table;
}

}  // namespace

ScanFile read_las(const InputFile& file, const ReadOptions& options) {
  const LasHeader header = parse_header(file);
  const RecordTable table = table_of(header);
  const std::string_view records = file.bytes().substr(header.first_point);
  ScanFile scan;
  scan.fields = fields_of(header.format);
  CloudSink sink({true, true, false, colour_offsets[header.format] != 0, false}, options);
  sink.reserve(header.points);
  for (std::size_t first = 0; first < header.points; first += batch_points) {
    const std::size_t count = std::min<std::size_t>(batch_points, header.points - first);
    sink.append(count, [&](Cloud& cloud, std::size_t at, std::size_t from, std::size_t to) {
      copy_records(table, records, cloud, at, first + from, first + to);
      for (std::size_t i = at; i < at + (to - from); ++i)
        cloud.positions[i] = cloud.positions[i].cwiseProduct(header.scale) + header.offset;
      return DroppedPoints{};
    });
    file.release_before(header.first_point + (first + count) * header.record_size);
  }
  scan.cloud = sink.take();
  // Many writers leave 8-bit colours in the 16-bit fields.
  widen_byte_colours(scan.cloud);
  return scan;
}

}  // namespace alea
