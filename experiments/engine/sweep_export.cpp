#include "experiments/engine/sweep_export.hpp"

#include <fmt/format.h>

#include <charconv>

#include "alea/core/error.hpp"
#include "alea/io/atomic_file.hpp"
#include "experiments/engine/csv_table.hpp"

namespace alea::experiments {
namespace {

std::string field_of(const Statement& row, int column) {
  switch (row.type(column)) {
    case Statement::Type::integer:
      return std::to_string(row.integer(column));
    case Statement::Type::real:
      return fmt::format("{}", row.real(column));  // shortest text that reads back as the same
    case Statement::Type::null:
      return "";
    default:
      return csv_field(row.text(column));
  }
}

}  // namespace

std::uint64_t export_csv(TrialStore& store, const std::filesystem::path& path) {
  AtomicFile file(path);
  Statement rows(store.database(), "SELECT * FROM trials ORDER BY cell, trial, estimator");
  const int columns = rows.columns() - 1;  // the last is the checksum
  std::string line;
  for (int column = 0; column < columns; ++column) {
    line += rows.name(column);
    line += column + 1 < columns ? ',' : '\n';
  }
  file.write(line);
  std::uint64_t count = 0;
  for (; rows.next(); ++count) {
    line.clear();
    for (int column = 0; column < columns; ++column) {
      line += field_of(rows, column);
      line += column + 1 < columns ? ',' : '\n';
    }
    file.write(line);
  }
  file.commit();
  return count;
}

}  // namespace alea::experiments
