#include "alea/io/e57_document.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <string_view>

#include "alea/core/error.hpp"
#include "alea/io/text_lines.hpp"

namespace alea {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

class Reader {
 public:
  explicit Reader(const E57Pages& pages) : pages_(pages) {
    if (pages.xml_length() > e57_xml_limit)
      fail(fmt::format("{} bytes; the limit is {}", pages.xml_length(), e57_xml_limit));
    text_ = pages.read(pages.logical(pages.xml_offset(), "the XML part"), pages.xml_length(),
                       "the XML part");
    check_markup();
    const pugi::xml_parse_result result = document_.load_buffer_inplace(text_.data(), text_.size());
    if (!result)
      fail(fmt::format("byte {} of it: {}; expected well-formed XML", result.offset,
                       result.description()));
  }

  std::vector<E57Scan> scans() const {
    const pugi::xml_node root = document_.child("e57Root");
    if (!root) fail("expected the element e57Root");
    std::vector<E57Scan> scans;
    for (const pugi::xml_node node : root.child("data3D").children("vectorChild"))
      scans.push_back(scan(node, scans.size() + 1));
    return scans;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw input_error(fmt::format("{}: XML part: {}", pages_.path(), what));
  }

  // Held before the tree takes its memory. 300 bytes: the nodes of an element and of its text, and
  // what a field of a prototype takes beside them; 40: an attribute.
  void check_markup() const {
    std::uint64_t elements = 0, attributes = 0;
    for (std::size_t i = 0; i + 1 < text_.size(); ++i) {
      elements += text_[i] == '<' && text_[i + 1] != '/' ? 1 : 0;
      attributes += text_[i] == '=' ? 1 : 0;
    }
    if (300 * elements + 40 * attributes > e57_markup_limit + 2 * pages_.logical_size())
      fail(
          fmt::format("{} elements and {} attributes; expected as many as fit into {} MB and twice "
                      "the file's size, at 300 and 40 bytes each",
                      elements, attributes, e57_markup_limit >> 20));
  }

  double number(std::string_view text, const std::string& where, double missing) const {
    text = trimmed(text);
    if (text.empty()) return missing;
    const std::optional<double> value = parse_number(text);
    if (!value) fail(fmt::format("{}: '{}' is not a number", where, text.substr(0, 40)));
    return *value;
  }

  template <typename T>
  T integer(std::string_view text, const std::string& where, T missing) const {
    text = trimmed(text);
    if (text.empty()) return missing;
    T value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
      fail(fmt::format("{}: '{}' is not a whole number in range", where, text.substr(0, 40)));
    return value;
  }

  E57Scan scan(pugi::xml_node node, std::size_t number_of_scan) const {
    const std::string where = fmt::format("scan {}", number_of_scan);
    E57Scan out;
    out.number = number_of_scan;
    out.name = node.child("name").text().get();
    if (const pugi::xml_node pose_node = node.child("pose")) out.pose = pose(pose_node, where);
    const pugi::xml_node points = node.child("points");
    if (!points) fail(where + ": no element points");
    for (const pugi::xml_node codec : points.child("codecs").children())
      if (!codec.child("bitPackCodec")) fail(where + ": a codec other than bitPackCodec");
    out.section_offset =
        integer<std::uint64_t>(points.attribute("fileOffset").value(), where + ": fileOffset", 0);
    out.records =
        integer<std::uint64_t>(points.attribute("recordCount").value(), where + ": recordCount", 0);
    for (const pugi::xml_node child : points.child("prototype").children())
      if (child.type() == pugi::node_element) out.fields.push_back(field(child, where));
    out.colour_limits = colour_limits(node.child("colorLimits"), where);
    return out;
  }

  std::optional<std::array<double, 2>> colour_limits(pugi::xml_node limits,
                                                     const std::string& where) const {
    if (!limits.child("colorRedMaximum")) return std::nullopt;
    return std::array{
        number(limits.child("colorRedMinimum").text().get(), where + ": colorRedMinimum", 0),
        number(limits.child("colorRedMaximum").text().get(), where + ": colorRedMaximum", 0)};
  }

  Eigen::Matrix4d pose(pugi::xml_node node, const std::string& where) const {
    const auto value = [&](const char* part, const char* axis, double missing) {
      return number(node.child(part).child(axis).text().get(),
                    fmt::format("{}: pose: {} {}", where, part, axis), missing);
    };
    const bool turned = static_cast<bool>(node.child("rotation"));
    const Eigen::Quaterniond q(value("rotation", "w", turned ? 0 : 1), value("rotation", "x", 0),
                               value("rotation", "y", 0), value("rotation", "z", 0));
    const Eigen::Vector3d translation_m(value("translation", "x", 0), value("translation", "y", 0),
                                        value("translation", "z", 0));
    Eigen::Matrix4d out = Eigen::Matrix4d::Identity();
    // Rounded digits are no scale; a quaternion that is off by more is kept as the scale it is.
    const double norm = q.norm();
    const double scale = std::abs(norm - 1) < 2e-4 ? 1 : norm * norm;
    out.topLeftCorner<3, 3>() = scale * q.normalized().toRotationMatrix();
    out.topRightCorner<3, 1>() = translation_m;
    if (!out.allFinite()) fail(where + ": pose: expected finite numbers");
    return out;
  }

  E57Field field(pugi::xml_node node, const std::string& scan) const {
    const std::string where = fmt::format("{}: field {}", scan, node.name());
    const std::string_view type = node.attribute("type").value();
    E57Field out;
    out.name = node.name();
    const pugi::xml_attribute low = node.attribute("minimum");
    const pugi::xml_attribute high = node.attribute("maximum");
    out.bounded = low && high;
    if (type == "Float") {
      const std::string_view precision = node.attribute("precision").value();
      if (!precision.empty() && precision != "single" && precision != "double")
        fail(fmt::format("{}: precision '{}'; expected single or double", where,
                         precision.substr(0, 40)));
      out.kind = precision == "single" ? E57Field::Kind::float32 : E57Field::Kind::float64;
      out.lowest = number(low.value(), where, 0);
      out.highest = number(high.value(), where, 0);
    } else if (type == "Integer" || type == "ScaledInteger") {
      using Limits = std::numeric_limits<std::int64_t>;
      out.kind = E57Field::Kind::integer;
      out.minimum = integer<std::int64_t>(low.value(), where + ": minimum", Limits::min());
      out.maximum = integer<std::int64_t>(high.value(), where + ": maximum", Limits::max());
      if (out.maximum < out.minimum) fail(where + ": maximum below minimum");
      if (type == "ScaledInteger") {
        out.scale = number(node.attribute("scale").value(), where + ": scale", 1);
        out.offset = number(node.attribute("offset").value(), where + ": offset", 0);
      }
      out.lowest = static_cast<double>(out.minimum) * out.scale + out.offset;
      out.highest = static_cast<double>(out.maximum) * out.scale + out.offset;
    } else if (type == "String") {
      out.kind = E57Field::Kind::text;
    } else {
      fail(fmt::format("{}: type '{}'; expected Float, Integer, ScaledInteger or String", where,
                       type.substr(0, 40)));
    }
    return out;
  }

  const E57Pages& pages_;
  std::string text_;  // holds what the document points to
  pugi::xml_document document_;
};

}  // namespace

unsigned E57Field::bits() const {
  if (kind == Kind::float32) return 32;
  if (kind == Kind::float64) return 64;
  return static_cast<unsigned>(
      std::bit_width(static_cast<std::uint64_t>(maximum) - static_cast<std::uint64_t>(minimum)));
}

std::vector<E57Scan> parse_e57_document(const E57Pages& pages) {
  return Reader(pages).scans();
}

}  // namespace alea
