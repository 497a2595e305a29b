#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace alea::experiments {

/// A CSV file in memory: RFC 4180 quoting, lines that begin with '#' are comments.
struct CsvTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  /// Position of a column. Throws Error(input) where there is none.
  std::size_t column(const std::string& name) const;
  const std::string& text(std::size_t row, const std::string& name) const;
  /// Empty where the field is empty. Throws Error(input) where it is no number.
  std::optional<double> number(std::size_t row, const std::string& name) const;
};

/// Throws Error(input) naming file and line where a row has not as many fields as the header.
CsvTable read_csv(const std::string& path);

/// A field as it stands in CSV, quoted where it must be.
std::string csv_field(const std::string& text);

}  // namespace alea::experiments
