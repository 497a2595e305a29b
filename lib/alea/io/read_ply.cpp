#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "alea/core/error.hpp"
#include "alea/io/cloud_sink.hpp"
#include "alea/io/formats.hpp"
#include "alea/io/ply_header.hpp"
#include "alea/io/text_columns.hpp"
#include "alea/io/text_lines.hpp"

namespace alea {
namespace {

[[noreturn]] void fail_short(const InputFile& file, const PlyElement& element, std::size_t found) {
  throw input_error(
      fmt::format("{}: the file ends in element '{}': its header declares {} of them, {} are there",
                  file.path(), element.name, element.count, found));
}

// A property counts for the cloud where it holds one value a point.
std::vector<std::string> role_names(const PlyElement& element) {
  std::vector<std::string> names;
  for (const PlyProperty& property : element.properties)
    names.push_back(property.count_type ? std::string() : property.name);
  return names;
}

std::uint64_t load_count(const char* at, ScalarType type, bool big_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size_of(type); ++i) {
    const std::size_t byte = big_endian ? size_of(type) - 1 - i : i;
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(at[byte])) << (8 * i);
  }
  return value;
}

// Walks over records that hold lists. Where `packed` is given, the scalars of each record are
// appended to it. Returns the offset behind the last record.
std::size_t walk_records(const InputFile& file, const PlyElement& element, bool big_endian,
                         std::size_t offset, std::string* packed) {
  const std::string_view bytes = file.bytes();
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      std::uint64_t values = 1;
      if (property.count_type) {
        const std::size_t count_size = size_of(*property.count_type);
        if (bytes.size() - offset < count_size) fail_short(file, element, i);
        values = load_count(bytes.data() + offset, *property.count_type, big_endian);
        offset += count_size;
      }
      const std::size_t left = bytes.size() - offset;
      if (values > left / size_of(property.type)) fail_short(file, element, i);
      const std::size_t size = values * size_of(property.type);
      if (packed != nullptr && !property.count_type) packed->append(bytes.substr(offset, size));
      offset += size;
    }
  }
  return offset;
}

std::size_t skip_binary(const InputFile& file, const PlyElement& element, bool big_endian,
                        std::size_t offset) {
  if (element.properties.empty()) return offset;
  if (element.has_list()) return walk_records(file, element, big_endian, offset, nullptr);
  const std::size_t left = file.bytes().size() - offset;
  if (element.count > left / element.record_size())
    fail_short(file, element, left / element.record_size());
  return offset + element.count * element.record_size();
}

Cloud read_binary(const InputFile& file, const PlyElement& vertex, bool big_endian,
                  std::size_t offset, const ReadOptions& options) {
  RecordTable table{{}, big_endian};
  const std::vector<std::optional<FieldRole>> roles = roles_of(role_names(vertex));
  const std::size_t record_size = vertex.record_size();
  std::size_t field = 0;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    const PlyProperty& property = vertex.properties[i];
    if (property.count_type) continue;
    table.columns.push_back({roles[i], property.type, field, record_size});
    field += size_of(property.type);
  }
  std::string packed;
  const std::size_t end = vertex.has_list()
                              ? walk_records(file, vertex, big_endian, offset, &packed)
                              : skip_binary(file, vertex, big_endian, offset);
  const std::string_view records =
      vertex.has_list() ? std::string_view(packed) : file.bytes().substr(offset, end - offset);
  CloudSink sink(channels_of(role_names(vertex)), options);
  append_records(sink, table, records, vertex.count, [&](std::size_t done) {
    if (!vertex.has_list()) file.release_before(offset + done * record_size);
  });
  return sink.take();
}

// Skips the data lines of the elements before the vertices.
std::size_t skip_lines(const InputFile& file, const PlyElement& element, std::size_t offset,
                       std::size_t& line) {
  for (std::size_t i = 0; i < element.count;) {
    if (offset >= file.bytes().size()) fail_short(file, element, i);
    const TextLine skipped = line_at(file.bytes(), offset);
    offset = skipped.next;
    ++line;
    if (!split_values(skipped.text).empty()) ++i;
  }
  return offset;
}

Cloud read_ascii(const InputFile& file, const PlyElement& vertex, std::size_t offset,
                 std::size_t line, const ReadOptions& options) {
  TextTable table;
  table.names = role_names(vertex);
  for (const PlyProperty& property : vertex.properties) {
    const bool is_float =
        property.type == ScalarType::float32 || property.type == ScalarType::float64;
    const std::optional<FieldRole> role = role_of(property.name);
    table.lists.push_back(property.count_type.has_value());
    table.packed_float.push_back(is_float);
    if (role == FieldRole::red) table.float_colours = is_float;
    if (role == FieldRole::red || role == FieldRole::rgb)
      table.byte_colours = role == FieldRole::rgb || size_of(property.type) == 1;
  }
  CloudSink sink(channels_of(table.names), options);
  const std::size_t found =
      read_text_table(table, file.bytes().substr(offset), {file.path(), line}, vertex.count, sink,
                      [&](std::size_t done) { file.release_before(offset + done); });
  if (found < vertex.count) fail_short(file, vertex, found);
  return sink.take();
}

void check_vertex(const InputFile& file, const PlyHeader& header, const PlyElement& vertex) {
  if (!channels_of(role_names(vertex)).positions)
    throw input_error(fmt::format(
        "{}: element vertex has no properties x, y and z; a scan needs coordinates", file.path()));
  check_names(file.path() + ": element vertex", role_names(vertex));
  const auto is_vertex = [](const PlyElement& element) { return element.name == "vertex"; };
  if (std::count_if(header.elements.begin(), header.elements.end(), is_vertex) > 1)
    throw input_error(fmt::format("{}: two elements are called vertex; expected one", file.path()));
}

}  // namespace

ScanFile read_ply(const InputFile& file, const ReadOptions& options) {
  const PlyHeader header = parse_ply_header(file.path(), file.bytes());
  const bool big_endian = header.encoding == PlyEncoding::big_endian;
  std::size_t offset = header.body_offset;
  std::size_t line = header.body_line;
  for (const PlyElement& element : header.elements) {
    if (element.name != "vertex") {
      offset = header.encoding == PlyEncoding::ascii
                   ? skip_lines(file, element, offset, line)
                   : skip_binary(file, element, big_endian, offset);
      continue;
    }
    ScanFile scan;
    for (const PlyProperty& property : element.properties) scan.fields.push_back(property.name);
    check_vertex(file, header, element);
    scan.cloud = header.encoding == PlyEncoding::ascii
                     ? read_ascii(file, element, offset, line, options)
                     : read_binary(file, element, big_endian, offset, options);
    if (header.scanner_position)
      scan.cloud.scanner_position = *header.scanner_position * options.unit_m;
    return scan;
  }
  throw input_error(
      fmt::format("{}: no element vertex in the header; a scan needs points", file.path()));
}

}  // namespace alea
