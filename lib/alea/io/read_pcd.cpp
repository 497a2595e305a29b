#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "alea/core/error.hpp"
#include "alea/io/cloud_sink.hpp"
#include "alea/io/formats.hpp"
#include "alea/io/lzf.hpp"
#include "alea/io/pcd_header.hpp"
#include "alea/io/text_columns.hpp"

namespace alea {
namespace {

// A field counts for the cloud where it holds one value a point.
std::string role_name(const PcdField& field) {
  return field.count == 1 ? field.name : std::string();
}

std::vector<std::string> role_names(const PcdHeader& header) {
  std::vector<std::string> names;
  for (const PcdField& field : header.fields) names.push_back(role_name(field));
  return names;
}

// The place in an image counts where no fields of the file say another.
bool is_image(const PcdHeader& header) {
  return header.image_columns > 0 && !channels_of(role_names(header)).grid;
}

Channels channels_of_points(const PcdHeader& header) {
  Channels channels = channels_of(role_names(header));
  channels.grid |= is_image(header);
  return channels;
}

Cloud read_ascii(const InputFile& file, const PcdHeader& header, const ReadOptions& options) {
  TextTable table;
  if (is_image(header)) table.image_columns = header.image_columns;
  for (const PcdField& field : header.fields) {
    for (std::size_t i = 0; i < field.count; ++i) {
      table.names.push_back(role_name(field));
      table.packed_float.push_back(field.type == ScalarType::float32);
    }
    if (role_of(field.name) == FieldRole::red) table.byte_colours = size_of(field.type) == 1;
  }
  CloudSink sink(channels_of_points(header), options);
  const std::size_t found =
      read_text_table(table, file.bytes().substr(header.body_offset),
                      {file.path(), header.body_line}, header.points, sink,
                      [&](std::size_t done) { file.release_before(header.body_offset + done); });
  if (found < header.points)
    throw input_error(fmt::format("{}: the header declares {} points, {} are there", file.path(),
                                  header.points, found));
  return sink.take();
}

// `planar`: one field after the other, as binary_compressed has them, rather than point by point.
RecordTable table_of(const PcdHeader& header, bool planar) {
  RecordTable table;
  if (is_image(header)) table.image_columns = header.image_columns;
  const std::vector<std::optional<FieldRole>> roles = roles_of(role_names(header));
  const std::size_t record_size = header.record_size();
  std::size_t offset = 0;
  for (const PcdField& field : header.fields) {
    const std::size_t size = size_of(field.type) * field.count;
    table.columns.push_back(
        {roles[table.columns.size()], field.type, offset, planar ? size : record_size});
    offset += planar ? size * header.points : size;
  }
  return table;
}

Cloud read_records(const PcdHeader& header, std::string_view records, bool planar,
                   const ReadOptions& options, const InputFile* release) {
  const RecordTable table = table_of(header, planar);
  CloudSink sink(channels_of_points(header), options);
  append_records(sink, table, records, header.points, [&](std::size_t done) {
    if (release != nullptr)
      release->release_before(header.body_offset + done * header.record_size());
  });
  return sink.take();
}

Cloud read_binary(const InputFile& file, const PcdHeader& header, const ReadOptions& options) {
  const std::string_view body = file.bytes().substr(header.body_offset);
  if (header.points > body.size() / header.record_size())
    throw input_error(fmt::format("{}: byte {}: {} points of {} bytes expected, {} bytes are there",
                                  file.path(), header.body_offset, header.points,
                                  header.record_size(), body.size()));
  return read_records(header, body, false, options, &file);
}

Cloud read_compressed(const InputFile& file, const PcdHeader& header, const ReadOptions& options) {
  const std::string_view body = file.bytes().substr(header.body_offset);
  std::uint32_t compressed = 0;
  std::uint32_t expanded = 0;
  if (body.size() < 8)
    throw input_error(fmt::format(
        "{}: byte {}: the two sizes of the compressed data are missing; expected 8 bytes",
        file.path(), header.body_offset));
  std::memcpy(&compressed, body.data(), 4);
  std::memcpy(&expanded, body.data() + 4, 4);
  if (compressed > body.size() - 8)
    throw input_error(fmt::format("{}: byte {}: {} compressed bytes expected, {} are there",
                                  file.path(), header.body_offset + 8, compressed,
                                  body.size() - 8));
  if (expanded % header.record_size() != 0 || expanded / header.record_size() != header.points)
    throw input_error(fmt::format(
        "{}: byte {}: the data expand to {} bytes, but {} points of {} bytes are declared",
        file.path(), header.body_offset + 4, expanded, header.points, header.record_size()));
  const std::optional<std::string> records = lzf_expand(body.substr(8, compressed), expanded);
  if (!records)
    throw input_error(fmt::format("{}: byte {}: the compressed data are damaged (LZF)", file.path(),
                                  header.body_offset + 8));
  return read_records(header, *records, true, options, nullptr);
}

}  // namespace

ScanFile read_pcd(const InputFile& file, const ReadOptions& options) {
  const PcdHeader header = parse_pcd_header(file.path(), file.bytes());
  ScanFile scan;
  for (const PcdField& field : header.fields)
    if (field.name != "_") scan.fields.push_back(field.name);
  if (!channels_of(role_names(header)).positions)
    throw input_error(
        fmt::format("{}: no fields x, y and z; a scan needs coordinates", file.path()));
  check_names(file.path(), role_names(header));
  switch (header.encoding) {
    case PcdEncoding::ascii:
      scan.cloud = read_ascii(file, header, options);
      break;
    case PcdEncoding::binary:
      scan.cloud = read_binary(file, header, options);
      break;
    case PcdEncoding::binary_compressed:
      scan.cloud = read_compressed(file, header, options);
      break;
  }
  // PDAL writes 8-bit colours of LAS files into 16-bit fields.
  widen_byte_colours(scan.cloud);
  // The format's default viewpoint is zero, so zero says nothing.
  if (!header.viewpoint.isZero(0)) scan.cloud.scanner_position = header.viewpoint * options.unit_m;
  return scan;
}

}  // namespace alea
