#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>

#include "alea/core/error.hpp"
#include "alea/core/version.hpp"
#include "alea/io/atomic_file.hpp"
#include "alea/io/binary_output.hpp"
#include "alea/io/cloud_file.hpp"
#include "alea/io/e57_page_writer.hpp"
#include "alea/io/e57_pages.hpp"
#include "alea/io/formats.hpp"

namespace alea {
namespace {

// One field of the record: its declaration and how to append the value of point i. All values take
// whole bytes, so that a packet's streams need no bit shifts.
struct Field {
  std::string declaration;
  std::size_t size = 4;
  std::function<void(std::string& out, std::size_t i)> append;
};

Field float_field(const char* name, bool single, std::function<double(std::size_t)> value) {
  const char* precision = single ? "single" : "double";
  return {fmt::format("<{} type=\"Float\" precision=\"{}\"/>", name, precision), single ? 4UL : 8UL,
          [single, value](std::string& out, std::size_t i) {
            single ? append_bytes(out, static_cast<float>(value(i))) : append_bytes(out, value(i));
          }};
}

Field index_field(const char* name, const std::vector<std::int32_t>& values) {
  // The whole range of 32 bits: raw = value - minimum.
  return {
      fmt::format("<{} type=\"Integer\" minimum=\"-2147483648\" maximum=\"2147483647\"/>", name), 4,
      [&values](std::string& out, std::size_t i) {
        append_bytes(out, static_cast<std::uint32_t>(values[i]) + 0x80000000U);
      }};
}

std::vector<Field> fields_of(const Cloud& cloud) {
  std::vector<Field> fields;
  const bool single = fits_float(cloud);
  const bool bytes = fits_bytes(cloud.colours);
  const std::array<const char*, 3> axes{"cartesianX", "cartesianY", "cartesianZ"};
  const std::array<const char*, 3> colours{"colorRed", "colorGreen", "colorBlue"};
  const std::array<const char*, 3> normals{"nor:normalX", "nor:normalY", "nor:normalZ"};
  for (int k = 0; k < 3; ++k)
    fields.push_back(float_field(axes[static_cast<std::size_t>(k)], single,
                                 [&, k](std::size_t i) { return cloud.positions[i][k]; }));
  if (cloud.has_intensity())
    fields.push_back(
        float_field("intensity", true, [&](std::size_t i) { return cloud.intensity[i]; }));
  for (std::size_t k = 0; k < 3 && !cloud.colours.empty(); ++k)
    fields.push_back({fmt::format("<{} type=\"Integer\" minimum=\"0\" maximum=\"{}\"/>", colours[k],
                                  bytes ? 255 : 65535),
                      bytes ? 1UL : 2UL, [&cloud, k, bytes](std::string& out, std::size_t i) {
                        const std::uint16_t value = cloud.colours[i][k];
                        bytes ? append_bytes(out, colour_byte(value)) : append_bytes(out, value);
                      }});
  for (int k = 0; k < 3 && !cloud.normals.empty(); ++k)
    fields.push_back(float_field(normals[static_cast<std::size_t>(k)], true,
                                 [&, k](std::size_t i) { return cloud.normals[i][k]; }));
  if (!cloud.rows.empty()) {
    fields.push_back(index_field("rowIndex", cloud.rows));
    fields.push_back(index_field("columnIndex", cloud.columns));
  }
  return fields;
}

std::string data_packet(const std::vector<Field>& fields, std::size_t begin, std::size_t end) {
  std::string streams;
  std::string sizes;
  for (const Field& field : fields) {
    for (std::size_t i = begin; i < end; ++i) field.append(streams, i);
    append_bytes(sizes, static_cast<std::uint16_t>(field.size * (end - begin)));
  }
  std::string packet(1, '\1');
  packet += '\0';
  const std::size_t length = 6 + sizes.size() + streams.size();
  const std::size_t padded = (length + 3) / 4 * 4;
  append_bytes(packet, static_cast<std::uint16_t>(padded - 1));
  append_bytes(packet, static_cast<std::uint16_t>(fields.size()));
  packet += sizes;
  packet += streams;
  packet.resize(padded, '\0');
  return packet;
}

// Writes the compressed vector of one scan; returns its physical offset.
std::uint64_t write_section(E57PageWriter& pages, const Cloud& cloud,
                            const std::vector<Field>& fields) {
  std::size_t record = 0;
  for (const Field& field : fields) record += field.size;
  const std::size_t per_packet = (65536 - 64) / record;
  const std::size_t packets = (cloud.size() + per_packet - 1) / per_packet;
  pages.align();
  const std::uint64_t offset = pages.physical();
  std::uint64_t length = 32;
  for (std::size_t p = 0; p < packets; ++p) {
    const std::size_t n = std::min(per_packet, cloud.size() - p * per_packet);
    length += (6 + 2 * fields.size() + n * record + 3) / 4 * 4;
  }
  const std::uint64_t data = pages.logical() + 32;
  std::string header(1, '\1');
  header.resize(8, '\0');
  append_bytes(header, length);
  append_bytes(header, data / E57Pages::payload * E57Pages::page_size + data % E57Pages::payload);
  append_bytes(header, std::uint64_t{0});  // no index packets
  pages.write(header);
  for (std::size_t begin = 0; begin < cloud.size(); begin += per_packet)
    pages.write(data_packet(fields, begin, std::min(cloud.size(), begin + per_packet)));
  return offset;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (static_cast<unsigned char>(c) >= 32)
      out += c;
  }
  return out;
}

// A GUID that depends on the contents alone, so that the same scans give the same file.
std::string guid_of(std::uint64_t a, std::uint64_t b) {
  return fmt::format("{{{:08X}-0000-4000-8000-{:012X}}}", a & 0xFFFFFFFF, b & 0xFFFFFFFFFFFF);
}

std::string bounds_xml(const Cloud& cloud) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : cloud.positions) box.extend(p);
  if (box.isEmpty()) return {};
  std::string out = "<cartesianBounds type=\"Structure\">";
  const char axes[] = "xyz";
  for (int k = 0; k < 3; ++k)
    out += fmt::format(
        "<{0}Minimum type=\"Float\">{1}</{0}Minimum><{0}Maximum type=\"Float\">{2}</{0}Maximum>",
        axes[k], box.min()[k], box.max()[k]);
  return out + "</cartesianBounds>\n";
}

std::string limits_xml(const Cloud& cloud) {
  std::string out;
  if (cloud.has_intensity()) {
    const auto [low, high] = std::minmax_element(cloud.intensity.begin(), cloud.intensity.end());
    out += fmt::format(
        "<intensityLimits type=\"Structure\"><intensityMinimum type=\"Float\" "
        "precision=\"single\">{}</intensityMinimum><intensityMaximum type=\"Float\" "
        "precision=\"single\">{}</intensityMaximum></intensityLimits>\n",
        *low, *high);
  }
  if (cloud.colours.empty()) return out;
  out += "<colorLimits type=\"Structure\">";
  for (const char* name : {"Red", "Green", "Blue"})
    out += fmt::format(
        "<color{0}Minimum type=\"Integer\">0</color{0}Minimum><color{0}Maximum "
        "type=\"Integer\">{1}</color{0}Maximum>",
        name, fits_bytes(cloud.colours) ? 255 : 65535);
  return out + "</colorLimits>\n";
}

std::string scan_xml(const ScanFile& scan, const std::vector<Field>& fields, std::uint64_t offset,
                     std::size_t number) {
  std::string out = fmt::format(
      "<vectorChild type=\"Structure\">\n<guid type=\"String\">{}</guid>\n<name "
      "type=\"String\">{}</name>\n",
      guid_of(scan.cloud.size(), number), escaped(scan.name));
  if (scan.pose) out += e57_pose_xml(*scan.pose);
  out += bounds_xml(scan.cloud) + limits_xml(scan.cloud);
  out += fmt::format(
      "<points type=\"CompressedVector\" fileOffset=\"{}\" recordCount=\"{}\">\n"
      "<prototype type=\"Structure\">",
      offset, scan.cloud.size());
  for (const Field& field : fields) out += field.declaration;
  return out +
         "</prototype>\n<codecs type=\"Vector\" allowHeterogeneousChildren=\"1\"></codecs>\n"
         "</points>\n</vectorChild>\n";
}

}  // namespace

std::string e57_pose_xml(const Eigen::Matrix4d& pose) {
  const Eigen::Quaterniond q(Eigen::Matrix3d(pose.topLeftCorner<3, 3>()));
  const auto value = [](const char* name, double v) {
    return fmt::format("<{0} type=\"Float\">{1}</{0}>", name, v);
  };
  return "<pose type=\"Structure\"><rotation type=\"Structure\">" + value("w", q.w()) +
         value("x", q.x()) + value("y", q.y()) + value("z", q.z()) +
         "</rotation><translation type=\"Structure\">" + value("x", pose(0, 3)) +
         value("y", pose(1, 3)) + value("z", pose(2, 3)) + "</translation></pose>\n";
}

void write_e57(const std::string& path, const std::vector<ScanFile>& scans) {
  for (std::size_t s = 0; s < scans.size(); ++s)
    if (scans[s].pose && !is_rigid(*scans[s].pose))
      throw input_error(fmt::format(
          "{}: the pose of scan {} is not rigid and E57 cannot hold it; apply it with --apply-pose",
          path, s + 1));
  AtomicFile file(path);
  E57PageWriter pages(file);
  std::string scans_xml;
  for (std::size_t s = 0; s < scans.size(); ++s) {
    const std::vector<Field> fields = fields_of(scans[s].cloud);
    const std::uint64_t offset = write_section(pages, scans[s].cloud, fields);
    scans_xml += scan_xml(scans[s], fields, offset, s + 1);
  }
  pages.finish(fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<e57Root type=\"Structure\" "
      "xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\" "
      "xmlns:nor=\"http://www.libe57.org/E57_NOR_surface_normals.txt\">\n"
      "<formatName type=\"String\">ASTM E57 3D Imaging Data File</formatName>\n"
      "<guid type=\"String\">{}</guid>\n<versionMajor type=\"Integer\">1</versionMajor>\n"
      "<versionMinor type=\"Integer\">0</versionMinor>\n"
      "<e57LibraryVersion type=\"String\">alea {}</e57LibraryVersion>\n"
      "<coordinateMetadata type=\"String\"></coordinateMetadata>\n"
      "<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\">\n{}</data3D>\n"
      "<images2D type=\"Vector\" allowHeterogeneousChildren=\"1\"></images2D>\n</e57Root>\n",
      guid_of(scans.size(), 0), version(), scans_xml));
  file.commit();
}

}  // namespace alea
