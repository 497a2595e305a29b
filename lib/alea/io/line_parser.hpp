#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/io/field_role.hpp"
#include "alea/io/text_columns.hpp"

namespace alea {

/// Parses the lines of a text table into a cloud's arrays. Throws Error(input) with file, line and
/// column.
class LineParser {
 public:
  /// All three must outlive the parser.
  LineParser(const TextTable& table, const TextPlace& place, Cloud& cloud);

  /// Parses the line at `at`, which has this number in the file, as this point; returns where the
  /// next line starts.
  const char* parse(const char* at, const char* end, std::size_t number, std::size_t point) const;

 private:
  bool is_blank(char c) const { return blank_[static_cast<unsigned char>(c)]; }
  bool is_separator(char c) const { return static_cast<unsigned char>(c) == separator_; }
  bool ends_value(char c) const { return is_blank(c) || c == '\n' || is_separator(c); }
  void skip_blanks(const char*& at, const char* end) const {
    while (at != end && is_blank(*at)) ++at;
  }
  void to_column(const char*& at, const char* end, std::size_t number, std::size_t c) const;
  void skip_text(const char*& at, const char* end) const;
  void skip_list(double count, const char*& at, const char* end, std::size_t number,
                 std::size_t c) const;
  double next_value(const char*& at, const char* end, std::size_t number, std::size_t c) const;
  void store(FieldRole role, std::size_t c, double value, std::size_t i) const;
  std::uint16_t colour(double value) const;

  const TextTable& table_;
  const TextPlace& place_;
  Cloud& cloud_;
  std::vector<std::optional<FieldRole>> roles_;
  std::array<bool, 256> blank_{};
  int separator_ = -1;
};

}  // namespace alea
