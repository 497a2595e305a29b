#include "experiments/engine/store_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alea/core/error.hpp"
#include "experiments/engine/trial_table.hpp"

namespace alea::experiments {
namespace {

[[noreturn]] void damaged(const Database& database, const std::string& what) {
  throw input_error(fmt::format("{}: damaged: {}; restore a copy, or remove it and run again",
                                database.path().string(), what));
}

struct CellSum {
  std::uint64_t rows = 0, digest = 0;
};

class RowCheck {
 public:
  RowCheck(const Database& database, const SweepSpec& spec)
      : database_(database), spec_(spec), axis_values_(spec.cells()), sums_(spec.cells()) {
    contents_.done.resize(spec.units());
  }

  void row(const Statement& row) {
    const std::int64_t cell = row.integer(cell_column), trial = row.integer(trial_column);
    const std::string place = fmt::format("row cell {}, trial {}, estimator '{}'", cell, trial,
                                          row.text(estimator_column));
    const int last = row.columns() - 1;
    if (row.type(last) != Statement::Type::integer || row_checksum(row) != row.integer(last))
      damaged(database_, place + " does not match its checksum");
    const auto& known = spec_.estimators;
    if (row.text(sweep_column) != spec_.name || cell < 0 || trial < 0 ||
        static_cast<std::uint64_t>(cell) >= spec_.cells() ||
        static_cast<std::uint64_t>(trial) >= spec_.trials ||
        std::find(known.begin(), known.end(), row.text(estimator_column)) == known.end() ||
        !has_axes_of(row, static_cast<std::uint64_t>(cell)))
      damaged(database_, place + " does not belong to this sweep");
    const CheckedRow checked{static_cast<std::uint64_t>(cell), static_cast<std::uint64_t>(trial),
                             static_cast<std::uint32_t>(row.integer(last))};
    CellSum& sum = sums_[checked.cell];
    ++sum.rows;
    sum.digest += digest_term(checked);
    count(checked.cell * spec_.trials + checked.trial);
  }

  void cell(const Statement& row) {
    const auto number = static_cast<std::uint64_t>(row.integer(0));
    if (number >= sums_.size()) damaged(database_, "a cell that the sweep does not have");
    if (static_cast<std::uint64_t>(row.integer(1)) != sums_[number].rows ||
        static_cast<std::uint64_t>(row.integer(2)) != sums_[number].digest)
      damaged(database_, fmt::format("cell {} has {} rows, or others than the {} once written",
                                     number, sums_[number].rows, row.integer(1)));
    ++cells_;
  }

  StoreContents finish() {
    if (of_unit_ > 0) whole_unit();
    if (cells_ != spec_.cells())
      damaged(database_, fmt::format("{} of {} cells are listed", cells_, spec_.cells()));
    return std::move(contents_);
  }

 private:
  bool has_axes_of(const Statement& row, std::uint64_t cell) {
    if (axis_values_[cell].empty()) axis_values_[cell] = spec_.axis_values(cell);
    int column = first_axis;
    for (const SweepValue& value : axis_values_[cell]) {
      const auto* const number = std::get_if<double>(&value);
      if (number != nullptr ? row.real(column) != *number
                            : row.text(column) != std::get<std::string>(value))
        return false;
      ++column;
    }
    return true;
  }

  // Rows come in the order of the primary key, so those of a trial stand together.
  void count(std::uint64_t unit) {
    if (of_unit_ > 0 && unit != unit_) whole_unit();
    unit_ = unit;
    ++of_unit_;
  }

  void whole_unit() {
    if (of_unit_ != spec_.estimators.size() || contents_.done[unit_])
      damaged(database_,
              fmt::format("cell {}, trial {} has {} rows for {} estimators", unit_ / spec_.trials,
                          unit_ % spec_.trials, of_unit_, spec_.estimators.size()));
    contents_.done[unit_] = true;
    ++contents_.done_units;
    of_unit_ = 0;
  }

  const Database& database_;
  const SweepSpec& spec_;
  std::vector<std::vector<SweepValue>> axis_values_;
  std::vector<CellSum> sums_;
  StoreContents contents_;
  std::uint64_t unit_ = 0, of_unit_ = 0, cells_ = 0;
};

}  // namespace

void check_size(Database& database) {
  Statement pages(database, "PRAGMA page_count"), size(database, "PRAGMA page_size");
  if (!pages.next() || !size.next()) damaged(database, "no pages");
  const auto expected = static_cast<std::uintmax_t>(pages.integer(0) * size.integer(0));
  const auto found = std::filesystem::file_size(database.path());
  if (found != expected)
    damaged(database, fmt::format("the file has {} bytes, not {}", found, expected));
}

StoreContents check_rows(Database& database, const SweepSpec& spec) {
  RowCheck check(database, spec);
  Statement rows(database, "SELECT * FROM trials ORDER BY cell, trial, estimator");
  if (rows.columns() != static_cast<int>(trial_columns(spec).size()))
    damaged(database, "the table trials has other columns");
  while (rows.next()) check.row(rows);
  Statement cells(database, "SELECT cell, rows, digest FROM cells ORDER BY cell");
  while (cells.next()) check.cell(cells);
  return check.finish();
}

}  // namespace alea::experiments
