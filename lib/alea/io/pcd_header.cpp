#include "alea/io/pcd_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

#include "alea/core/error.hpp"
#include "alea/io/text_lines.hpp"

namespace alea {
namespace {

// Values of one point: each takes memory before a point is read.
constexpr std::size_t value_limit = 1000000;

class PcdParser {
 public:
  PcdParser(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  PcdHeader parse() {
    for (bool done = false; !done;) {
      ++line_;
      if (offset_ >= bytes_.size()) fail("the header ends without a DATA line");
      const TextLine line = line_at(bytes_, offset_);
      if (line.text.size() > 65536) fail("a header line of more than 65536 bytes; is this a PCD?");
      offset_ = line.next;
      const Words words = split_values(line.text);
      if (words.empty() || words[0].starts_with('#')) continue;
      done = parse_line(words);
    }
    finish();
    return header_;
  }

 private:
  using Words = std::vector<std::string_view>;

  [[noreturn]] void fail(const std::string& expectation) const {
    throw input_error(fmt::format("{}: line {}: {}", path_, line_, expectation));
  }

  bool parse_line(const Words& words) {
    const Words values(words.begin() + 1, words.end());
    const std::string_view key = words[0];
    if (key == "VERSION") {
      check_version(values);
    } else if (key == "FIELDS" || key == "COLUMNS") {
      for (const std::string_view name : values) header_.fields.push_back({std::string(name)});
    } else if (key == "SIZE") {
      sizes_ = numbers(values);
    } else if (key == "TYPE") {
      types_.assign(values.begin(), values.end());
    } else if (key == "COUNT") {
      counts_ = numbers(values);
    } else if (key == "WIDTH" || key == "HEIGHT" || key == "POINTS") {
      if (values.size() != 1) fail(fmt::format("expected '{} NUMBER'", key));
      (key == "WIDTH" ? width_ : key == "HEIGHT" ? height_ : points_) = numbers(values)[0];
    } else if (key == "VIEWPOINT") {
      parse_viewpoint(values);
    } else if (key == "DATA") {
      parse_data(values);
      return true;
    } else {
      fail(
          fmt::format("'{}' is no PCD header entry; expected VERSION, FIELDS, SIZE, TYPE, COUNT, "
                      "WIDTH, HEIGHT, VIEWPOINT, POINTS or DATA",
                      key.substr(0, 40)));
    }
    return false;
  }

  void check_version(const Words& values) const {
    const std::string_view version = values.empty() ? std::string_view() : values[0];
    for (const char* known : {".5", "0.5", ".6", "0.6", ".7", "0.7"})
      if (version == known) return;
    fail(fmt::format("PCD version '{}'; versions 0.5 to 0.7 can be read", version.substr(0, 40)));
  }

  std::vector<std::size_t> numbers(const Words& values) const {
    std::vector<std::size_t> out;
    for (const std::string_view word : values) {
      std::size_t value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || end != word.data() + word.size())
        fail(fmt::format("'{}' is not a count", word.substr(0, 40)));
      out.push_back(value);
    }
    return out;
  }

  void parse_viewpoint(const Words& values) {
    if (values.size() != 7) fail("expected 'VIEWPOINT tx ty tz qw qx qy qz'");
    for (int i = 0; i < 3; ++i) {
      const std::optional<double> value = parse_number(values[i]);
      if (!value) fail(fmt::format("'{}' is not a number", values[i].substr(0, 40)));
      header_.viewpoint[i] = *value;
    }
    if (!header_.viewpoint.allFinite()) fail("a VIEWPOINT that is not finite");
  }

  void parse_data(const Words& values) {
    const std::string_view name = values.empty() ? std::string_view() : values[0];
    if (name == "ascii")
      header_.encoding = PcdEncoding::ascii;
    else if (name == "binary")
      header_.encoding = PcdEncoding::binary;
    else if (name == "binary_compressed")
      header_.encoding = PcdEncoding::binary_compressed;
    else
      fail(fmt::format("DATA '{}'; expected ascii, binary or binary_compressed",
                       name.substr(0, 40)));
  }

  void finish() {
    const std::size_t n = header_.fields.size();
    if (n == 0) fail("no FIELDS line before DATA");
    if (sizes_.size() != n || types_.size() != n || (!counts_.empty() && counts_.size() != n))
      fail(fmt::format("{} fields but {} in SIZE, {} in TYPE, {} in COUNT", n, sizes_.size(),
                       types_.size(), counts_.size()));
    std::size_t values = 0;
    for (std::size_t i = 0; i < n; ++i) {
      header_.fields[i].type = type(types_[i], sizes_[i]);
      if (!counts_.empty()) header_.fields[i].count = counts_[i];
      values += std::min(header_.fields[i].count, value_limit + 1);
      if (values > value_limit)
        fail(fmt::format("more than {} values a point by field '{}'; that is the limit",
                         value_limit, header_.fields[i].name));
    }
    finish_points();
    header_.body_offset = offset_;
    header_.body_line = line_ + 1;
  }

  void finish_points() {
    if (!points_ && !(width_ && height_)) fail("neither POINTS nor WIDTH and HEIGHT before DATA");
    if (width_ && height_) {
      if (*height_ != 0 && *width_ > SIZE_MAX / *height_) fail("WIDTH times HEIGHT is too large");
      header_.points = *width_ * *height_;
      if (*height_ > 1 && header_.points <= INT32_MAX) header_.image_columns = *width_;
      if (points_ && *points_ != header_.points)
        fail(fmt::format("POINTS {} but WIDTH times HEIGHT is {}", *points_, header_.points));
    } else {
      header_.points = *points_;
    }
  }

  ScalarType type(std::string_view letter, std::size_t size) const {
    using enum ScalarType;
    if (letter == "F" && size == 4) return float32;
    if (letter == "F" && size == 8) return float64;
    const bool is_signed = letter == "I";
    if (is_signed || letter == "U") {
      if (size == 1) return is_signed ? int8 : uint8;
      if (size == 2) return is_signed ? int16 : uint16;
      if (size == 4) return is_signed ? int32 : uint32;
      if (size == 8) return is_signed ? int64 : uint64;
    }
    fail(fmt::format("TYPE {} with SIZE {}; expected F with 4 or 8, I or U with 1, 2, 4 or 8",
                     letter.substr(0, 40), size));
  }

  const std::string& path_;
  std::string_view bytes_;
  std::size_t offset_ = 0;
  std::size_t line_ = 0;
  PcdHeader header_;
  std::vector<std::size_t> sizes_;
  std::vector<std::size_t> counts_;
  std::vector<std::string> types_;
  std::optional<std::size_t> width_, height_, points_;
};

}  // namespace

std::size_t PcdHeader::record_size() const {
  std::size_t size = 0;
  for (const PcdField& field : fields) size += size_of(field.type) * field.count;
  return size;
}

PcdHeader parse_pcd_header(const std::string& path, std::string_view bytes) {
  return PcdParser(path, bytes).parse();
}

}  // namespace alea
