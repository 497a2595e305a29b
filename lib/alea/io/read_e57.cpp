#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "alea/core/error.hpp"
#include "alea/io/cloud_sink.hpp"
#include "alea/io/e57_document.hpp"
#include "alea/io/e57_packets.hpp"
#include "alea/io/e57_pages.hpp"
#include "alea/io/formats.hpp"

namespace alea {
namespace {

using Column = std::optional<std::size_t>;  // place of a field in the prototype

Column find(const E57Scan& scan, std::string_view name) {
  for (std::size_t i = 0; i < scan.fields.size(); ++i)
    if (scan.fields[i].name == name && scan.fields[i].kind != E57Field::Kind::text) return i;
  return std::nullopt;
}

struct Layout {
  bool spherical = false;
  std::array<Column, 3> coordinates;
  Column state;  // invalid state: 0 is a valid point
  Column intensity;
  std::array<Column, 3> colour;
  std::array<Column, 3> normal;
  Column row, column;

  static bool whole(const std::array<Column, 3>& c) { return c[0] && c[1] && c[2]; }
  Channels channels() const {
    return {true, intensity.has_value(), whole(normal), whole(colour), row && column};
  }
  std::vector<bool> wanted(std::size_t fields) const {
    std::vector<bool> out(fields, false);
    for (const Column& c :
         {coordinates[0], coordinates[1], coordinates[2], state, intensity, colour[0], colour[1],
          colour[2], normal[0], normal[1], normal[2], row, column})
      if (c) out[*c] = true;
    return out;
  }
};

Layout layout_of(const std::string& path, const E57Scan& scan) {
  Layout out;
  out.coordinates = {find(scan, "cartesianX"), find(scan, "cartesianY"), find(scan, "cartesianZ")};
  out.state = find(scan, "cartesianInvalidState");
  if (!Layout::whole(out.coordinates)) {
    out.spherical = true;
    out.coordinates = {find(scan, "sphericalRange"), find(scan, "sphericalAzimuth"),
                       find(scan, "sphericalElevation")};
    out.state = find(scan, "sphericalInvalidState");
  }
  if (!Layout::whole(out.coordinates))
    throw input_error(fmt::format(
        "{}: scan {}: neither cartesianX, Y, Z nor sphericalRange, Azimuth, Elevation among its "
        "fields",
        path, scan.number));
  out.intensity = find(scan, "intensity");
  out.colour = {find(scan, "colorRed"), find(scan, "colorGreen"), find(scan, "colorBlue")};
  out.normal = {find(scan, "nor:normalX"), find(scan, "nor:normalY"), find(scan, "nor:normalZ")};
  out.row = find(scan, "rowIndex");
  out.column = find(scan, "columnIndex");
  return out;
}

Eigen::Vector3d from_spherical(const Eigen::Vector3d& p) {
  const double level = p.x() * std::cos(p.z());
  return {level * std::cos(p.y()), level * std::sin(p.y()), p.x() * std::sin(p.z())};
}

// Lowest and highest value of a colour: the scan's limits, else the field's bounds, else 0 to 255.
std::array<double, 2> colour_range(const E57Scan& scan, std::size_t field) {
  std::array<double, 2> range{0, 255};
  if (scan.fields[field].bounded) range = {scan.fields[field].lowest, scan.fields[field].highest};
  if (scan.colour_limits) range = *scan.colour_limits;
  return range[1] > range[0] ? range : std::array<double, 2>{0, 255};
}

class Filler {
 public:
  Filler(const E57Packets& packets, const E57Scan& scan, const Layout& layout)
      : packets_(packets), scan_(scan), layout_(layout) {}

  DroppedPoints operator()(Cloud& cloud, std::size_t at, std::size_t begin, std::size_t end) const {
    std::vector<double> values(end - begin);
    const auto each = [&](const Column& field, const auto& store) {
      if (!field) return;
      packets_.decode(*field, begin, values.size(), values.data());
      for (std::size_t i = 0; i < values.size(); ++i) store(at + i, values[i]);
    };
    const Channels channels = layout_.channels();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      each(layout_.coordinates[axis],
           [&](std::size_t i, double v) { cloud.positions[i][static_cast<int>(axis)] = v; });
      if (channels.normals)
        each(layout_.normal[axis], [&](std::size_t i, double v) {
          cloud.normals[i][static_cast<int>(axis)] = static_cast<float>(v);
        });
      if (!channels.colours) continue;
      const std::array<double, 2> range = colour_range(scan_, *layout_.colour[axis]);
      each(layout_.colour[axis], [&](std::size_t i, double v) {
        const double share = std::clamp((v - range[0]) / (range[1] - range[0]), 0.0, 1.0);
        cloud.colours[i][axis] =
            static_cast<std::uint16_t>(std::lround(std::isfinite(share) ? share * 65535 : 0));
      });
    }
    each(layout_.intensity,
         [&](std::size_t i, double v) { cloud.intensity[i] = static_cast<float>(v); });
    if (channels.grid) {
      each(layout_.row, [&](std::size_t i, double v) { cloud.rows[i] = index(v); });
      each(layout_.column, [&](std::size_t i, double v) { cloud.columns[i] = index(v); });
    }
    if (layout_.spherical)
      for (std::size_t i = at; i < at + values.size(); ++i)
        cloud.positions[i] = from_spherical(cloud.positions[i]);
    DroppedPoints dropped;
    each(layout_.state, [&](std::size_t i, double v) {
      if (v == 0) return;
      cloud.positions[i].x() = std::numeric_limits<double>::quiet_NaN();
      ++dropped.invalid;
    });
    return dropped;
  }

 private:
  static std::int32_t index(double v) {
    return std::abs(v) < 2e9 ? static_cast<std::int32_t>(v) : -1;
  }

  const E57Packets& packets_;
  const E57Scan& scan_;
  const Layout& layout_;
};

// Records of no bits at all could be declared without end.
void check_counts(const E57Pages& pages, const std::vector<E57Scan>& scans) {
  check_scan_count(pages.path(), scans.size());
  std::uint64_t left = (pages.logical_size() + (1 << 17)) * 8;
  for (const E57Scan& scan : scans) {
    if (scan.records > left)
      throw input_error(
          fmt::format("{}: scan {}: recordCount {} cannot fit into a file of {} bytes",
                      pages.path(), scan.number, scan.records, pages.logical_size()));
    left -= scan.records;
  }
}

// `section_bytes` are those of the scans before: thousands of scans that share one section would be
// read without end.
ScanFile read_scan(const E57Pages& pages, const E57Scan& scan, const ReadOptions& options,
                   std::uint64_t& section_bytes) {
  const Layout layout = layout_of(pages.path(), scan);
  ScanFile out;
  out.name = scan.name;
  out.pose = scan.pose;
  if (out.pose) out.pose->topRightCorner<3, 1>() *= options.unit_m;
  for (const E57Field& field : scan.fields) out.fields.push_back(field.name);
  E57Packets packets(pages, scan, layout.wanted(scan.fields.size()));
  section_bytes += packets.section_bytes();
  if (section_bytes > pages.logical_size())
    throw input_error(
        fmt::format("{}: byte {}: the section of scan {} is one of an earlier scan too; expected a "
                    "section for each",
                    pages.path(), scan.section_offset, scan.number));
  CloudSink sink(layout.channels(), options);
  for (std::uint64_t done = 0; done < scan.records;) {
    const std::uint64_t want = std::min<std::uint64_t>(batch_points, scan.records - done);
    const std::uint64_t count = packets.fill(want);
    if (count < want)
      throw input_error(fmt::format("{}: scan {}: {} records declared, its packets hold {}",
                                    pages.path(), scan.number, scan.records, done + count));
    if (done == 0) sink.reserve(scan.records);
    sink.append(count, Filler(packets, scan, layout));
    packets.consume(count);
    done += count;
  }
  out.cloud = sink.take();
  out.cloud.scanner_position = Eigen::Vector3d::Zero();
  return out;
}

}  // namespace

std::vector<ScanFile> read_e57(const InputFile& file, const ReadOptions& options) {
  const E57Pages pages(file);
  std::vector<ScanFile> scans;
  const std::vector<E57Scan> declared = parse_e57_document(pages);
  check_counts(pages, declared);
  std::uint64_t section_bytes = 0;
  for (const E57Scan& scan : declared)
    scans.push_back(read_scan(pages, scan, options, section_bytes));
  return scans;
}

}  // namespace alea
