#include "alea/io/ply_faces.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "alea/core/error.hpp"
#include "alea/io/byte_order.hpp"
#include "alea/io/ply_header.hpp"
#include "alea/io/text_lines.hpp"

namespace alea {
namespace {

template <typename T>
double value_at(const char* at, bool big_endian) {
  return static_cast<double>(big_endian ? load_value<T, true>(at) : load_value<T>(at));
}

double load_scalar(const char* at, ScalarType type, bool big_endian) {
  switch (type) {
    case ScalarType::int8:
      return value_at<std::int8_t>(at, big_endian);
    case ScalarType::uint8:
      return value_at<std::uint8_t>(at, big_endian);
    case ScalarType::int16:
      return value_at<std::int16_t>(at, big_endian);
    case ScalarType::uint16:
      return value_at<std::uint16_t>(at, big_endian);
    case ScalarType::int32:
      return value_at<std::int32_t>(at, big_endian);
    case ScalarType::uint32:
      return value_at<std::uint32_t>(at, big_endian);
    case ScalarType::int64:
      return value_at<std::int64_t>(at, big_endian);
    case ScalarType::uint64:
      return value_at<std::uint64_t>(at, big_endian);
    case ScalarType::float32:
      return value_at<float>(at, big_endian);
    case ScalarType::float64:
      return value_at<double>(at, big_endian);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Takes the values of the body one after the other, text or binary.
class PlyValues {
 public:
  PlyValues(const InputFile& file, const PlyHeader& header)
      : file_(file), encoding_(header.encoding), offset_(header.body_offset) {}

  double next(ScalarType type) {
    if (encoding_ == PlyEncoding::ascii) return next_word();
    const std::size_t size = size_of(type);
    if (file_.bytes().size() - offset_ < size) fail("the file ends early");
    const double value =
        load_scalar(file_.bytes().data() + offset_, type, encoding_ == PlyEncoding::big_endian);
    offset_ += size;
    return value;
  }
  std::int64_t next_index(ScalarType type) {
    const double value = next(type);
    if (!(std::abs(value) <= 4e9) || value != std::floor(value))
      fail("an index is no whole number");
    return static_cast<std::int64_t>(value);
  }
  std::string where() const { return fmt::format("{}: byte {}", file_.path(), offset_); }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw input_error(
        fmt::format("{}: {}; expected the faces that its header declares", where(), what));
  }
  double next_word() {
    const std::string_view bytes = file_.bytes();
    while (offset_ < bytes.size() && (is_separator(bytes[offset_]) || bytes[offset_] == '\n'))
      ++offset_;
    const NumberText number = read_number(bytes.data() + offset_, bytes.data() + bytes.size());
    const auto end = static_cast<std::size_t>(number.end - bytes.data());
    if (end == offset_) fail(offset_ == bytes.size() ? "the file ends early" : "no number");
    offset_ = end;
    return number.value;
  }

  const InputFile& file_;
  PlyEncoding encoding_;
  std::size_t offset_;
};

std::vector<std::int64_t> next_list(PlyValues& values, const PlyProperty& property) {
  const std::int64_t count = values.next_index(*property.count_type);
  std::vector<std::int64_t> list;
  for (std::int64_t i = 0; i < count; ++i) list.push_back(values.next_index(property.type));
  return list;
}

void skip(PlyValues& values, const PlyProperty& property) {
  const std::int64_t count =
      property.count_type ? values.next_index(*property.count_type) : std::int64_t{1};
  for (std::int64_t i = 0; i < count; ++i) values.next(property.type);
}

}  // namespace

std::vector<PlyFace> read_ply_faces(const InputFile& file) {
  const PlyHeader header = parse_ply_header(file.path(), file.bytes());
  PlyValues values(file, header);
  std::vector<PlyFace> faces;
  for (const PlyElement& element : header.elements) {
    for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      for (const PlyProperty& property : element.properties) {
        const bool corners = element.name == "face" && property.count_type &&
                             property.name.starts_with("vertex_ind");
        if (corners)
          faces.push_back({next_list(values, property), values.where()});
        else
          skip(values, property);
      }
    }
    if (element.name == "face") break;
  }
  return faces;
}

}  // namespace alea
