#include "alea/io/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "alea/core/error.hpp"
#include "alea/io/text_lines.hpp"

namespace alea {
namespace {

class PlyParser {
 public:
  PlyParser(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  PlyHeader parse() {
    if (split_values(next_line()) != Words{"ply"}) fail("expected 'ply'; is this a PLY file?");
    parse_format();
    for (;;) {
      const std::string_view line = next_line();
      const Words words = split_values(line);
      if (words.empty()) continue;
      if (words[0] == "end_header") break;
      parse_line(line, words);
    }
    header_.body_offset = offset_;
    header_.body_line = line_ + 1;
    return header_;
  }

 private:
  using Words = std::vector<std::string_view>;

  [[noreturn]] void fail(const std::string& expectation) const {
    throw input_error(fmt::format("{}: line {}: {}", path_, line_, expectation));
  }

  std::string_view next_line() {
    ++line_;
    if (offset_ >= bytes_.size()) fail("the header ends without 'end_header'");
    const TextLine line = line_at(bytes_, offset_);
    if (line.text.size() > 4096) fail("a header line of more than 4096 bytes");
    offset_ = line.next;
    return line.text;
  }

  void parse_format() {
    const Words words = split_values(next_line());
    if (words.size() != 3 || words[0] != "format" || words[2] != "1.0")
      fail("expected 'format ascii|binary_little_endian|binary_big_endian 1.0'");
    if (words[1] == "ascii")
      header_.encoding = PlyEncoding::ascii;
    else if (words[1] == "binary_little_endian")
      header_.encoding = PlyEncoding::little_endian;
    else if (words[1] == "binary_big_endian")
      header_.encoding = PlyEncoding::big_endian;
    else
      fail(
          fmt::format("unknown format '{}'; expected ascii, binary_little_endian or "
                      "binary_big_endian",
                      words[1].substr(0, 40)));
  }

  void parse_line(std::string_view line, const Words& words) {
    if (words[0] == "comment") {
      parse_comment(line);
    } else if (words[0] == "element") {
      parse_element(words);
    } else if (words[0] == "property") {
      parse_property(words);
    } else if (words[0] != "obj_info") {
      fail(
          fmt::format("'{}' is no header keyword; expected element, property, comment, obj_info "
                      "or end_header",
                      words[0].substr(0, 40)));
    }
  }

  void parse_comment(std::string_view line) {
    const auto found = line.find(ply_position_comment);
    if (found == std::string_view::npos) return;
    const Words words = split_values(line.substr(found + ply_position_comment.size()));
    Eigen::Vector3d position;
    if (words.size() != 3) return;
    for (int i = 0; i < 3; ++i) {
      const std::optional<double> value = parse_number(words[i]);
      if (!value) return;
      position[i] = *value;
    }
    if (position.allFinite()) header_.scanner_position = position;
  }

  void parse_element(const Words& words) {
    PlyElement element;
    if (words.size() != 3) fail("expected 'element NAME COUNT'");
    element.name = words[1];
    const std::string_view count = words[2];
    const auto [end, error] =
        std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc{} || end != count.data() + count.size())
      fail(fmt::format("'{}' is not a count", count.substr(0, 40)));
    header_.elements.push_back(std::move(element));
  }

  void parse_property(const Words& words) {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyProperty property;
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3)
      fail("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    if (list) property.count_type = type(words[2]);
    if (list && (*property.count_type == ScalarType::float32 ||
                 *property.count_type == ScalarType::float64))
      fail("the count of a list is an integer");
    property.type = type(words[words.size() - 2]);
    property.name = words.back();
    header_.elements.back().properties.push_back(std::move(property));
  }

  ScalarType type(std::string_view name) const {
    using enum ScalarType;
    static const std::map<std::string_view, ScalarType> types{
        {"char", int8},     {"int8", int8},       {"uchar", uint8},    {"uint8", uint8},
        {"short", int16},   {"int16", int16},     {"ushort", uint16},  {"uint16", uint16},
        {"int", int32},     {"int32", int32},     {"uint", uint32},    {"uint32", uint32},
        {"float", float32}, {"float32", float32}, {"double", float64}, {"float64", float64},
        {"long", int64},    {"int64", int64},     {"ulong", uint64},   {"uint64", uint64}};
    const auto found = types.find(name);
    if (found == types.end())
      fail(
          fmt::format("unknown type '{}'; expected char, uchar, short, ushort, int, uint, float or "
                      "double",
                      name.substr(0, 40)));
    return found->second;
  }

  const std::string& path_;
  std::string_view bytes_;
  std::size_t offset_ = 0;
  std::size_t line_ = 0;
  PlyHeader header_;
};

}  // namespace

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& property) { return property.count_type.has_value(); });
}

std::size_t PlyElement::record_size() const {
  std::size_t size = 0;
  for (const PlyProperty& property : properties)
    if (!property.count_type) size += size_of(property.type);
  return size;
}

PlyHeader parse_ply_header(const std::string& path, std::string_view bytes) {
  return PlyParser(path, bytes).parse();
}

}  // namespace alea
