#include "experiments/engine/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "alea/core/error.hpp"

namespace alea::experiments {
namespace {

std::vector<std::string> split_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

}  // namespace

std::size_t CsvTable::column(const std::string& name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) throw input_error("csv: no column '" + name + "'; check the header");
  return static_cast<std::size_t>(found - header.begin());
}

const std::string& CsvTable::text(std::size_t row, const std::string& name) const {
  return rows.at(row).at(column(name));
}

std::optional<double> CsvTable::number(std::size_t row, const std::string& name) const {
  const std::string& field = text(row, name);
  if (field.empty()) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size())
    throw input_error(fmt::format("csv: '{}' in column '{}' is no number", field, name));
  return value;
}

CsvTable read_csv(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw input_error(path + ": cannot be read; is the data folder of Alea complete?");
  CsvTable table;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> fields = split_fields(line);
    if (table.header.empty()) {
      table.header = std::move(fields);
    } else if (fields.size() != table.header.size()) {
      throw input_error(fmt::format("{}:{}: {} fields, the header has {}", path, number,
                                    fields.size(), table.header.size()));
    } else {
      table.rows.push_back(std::move(fields));
    }
  }
  return table;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

}  // namespace alea::experiments
