#include "experiments/engine/trial_table.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>

#include "alea/core/error.hpp"
#include "experiments/engine/crc32c.hpp"

namespace alea::experiments {
namespace {

class Checksum {
 public:
  void add(std::int64_t value) {
    tag('i');
    word(static_cast<std::uint64_t>(value));
  }
  void add(double value) {
    if (std::isnan(value)) return add_null();
    tag('r');
    word(std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value));  // a store keeps no sign of zero
  }
  void add(const std::string& text) {
    tag('t');
    word(text.size());
    crc_ = crc32c(text, crc_);
  }
  void add_null() { tag('n'); }
  std::uint32_t value() const { return crc_; }

 private:
  void tag(char type) { crc_ = crc32c({&type, 1}, crc_); }
  void word(std::uint64_t value) {
    std::array<char, 8> bytes{};
    for (char& byte : bytes) {
      byte = static_cast<char>(value & 0xFF);
      value >>= 8;
    }
    crc_ = crc32c({bytes.data(), bytes.size()}, crc_);
  }
  std::uint32_t crc_ = 0;
};

/// Binds the values of a row one after the other and sums them up on the way.
class RowBinder {
 public:
  explicit RowBinder(Statement& statement) : statement_(statement) {}
  template <typename Value>
  void add(const Value& value) {
    statement_.bind(next_++, value);
    checksum_.add(value);
  }
  void add(const SweepValue& value) {
    std::visit([this](const auto& v) { add(v); }, value);
  }
  std::uint32_t finish() {
    statement_.bind(next_, static_cast<std::int64_t>(checksum_.value()));
    return checksum_.value();
  }

 private:
  Statement& statement_;
  Checksum checksum_;
  int next_ = 0;
};

std::string insert_sql(const SweepSpec& spec) {
  std::string places = "?";
  for (std::size_t k = 1; k < trial_columns(spec).size(); ++k) places += ", ?";
  return "INSERT INTO trials VALUES (" + places + ")";
}

}  // namespace

std::vector<TrialColumn> trial_columns(const SweepSpec& spec) {
  std::vector<TrialColumn> columns{
      {"sweep", "TEXT"}, {"cell", "INTEGER"}, {"trial", "INTEGER"}, {"estimator", "TEXT"}};
  for (const SweepAxis& axis : spec.axes)
    columns.push_back(
        {axis.name, std::holds_alternative<double>(axis.values.front()) ? "REAL" : "TEXT"});
  for (const char* const name : {"rotation_error_rad", "translation_error_m", "check_error_m",
                                 "bound_rotation_rad", "bound_translation_m", "bound_check_m"})
    columns.push_back({name, "REAL"});
  for (const std::string& name : sweep_experiment(spec.experiment).extra_columns)
    columns.push_back({name, "REAL"});
  columns.push_back({"verdict", "TEXT"});
  columns.push_back({"duration_s", "REAL"});
  columns.push_back({"crc32c", "INTEGER"});
  return columns;
}

void create_trial_table(Database& database, const SweepSpec& spec) {
  std::string sql = "CREATE TABLE trials (";
  for (const TrialColumn& column : trial_columns(spec))
    sql += fmt::format("{} {}, ", column.name, column.type);
  database.run(sql + "PRIMARY KEY (cell, trial, estimator)) WITHOUT ROWID");
}

TrialWriter::TrialWriter(Database& database, const SweepSpec& spec)
    : spec_(spec),
      extra_(sweep_experiment(spec.experiment).extra_columns.size()),
      insert_(database, insert_sql(spec)) {}

CheckedRow TrialWriter::write(std::uint64_t cell, std::uint64_t trial, const TrialRow& row) {
  if (row.extra.size() != extra_)
    throw usage_error(fmt::format("sweep {}: estimator {} gives {} numbers of its own, not {}",
                                  spec_.name, row.estimator, row.extra.size(), extra_));
  RowBinder binder(insert_);
  binder.add(spec_.name);
  binder.add(static_cast<std::int64_t>(cell));
  binder.add(static_cast<std::int64_t>(trial));
  binder.add(row.estimator);
  for (const SweepValue& value : spec_.axis_values(cell)) binder.add(value);
  for (const double value : {row.rotation_error_rad, row.translation_error_m, row.check_error_m,
                             row.bound_rotation_rad, row.bound_translation_m, row.bound_check_m})
    binder.add(value);
  for (const double value : row.extra) binder.add(value);
  binder.add(row.verdict);
  binder.add(row.duration_s);
  const std::uint32_t crc = binder.finish();
  insert_.run();
  return {cell, trial, crc};
}

std::uint32_t row_checksum(const Statement& row) {
  Checksum checksum;
  for (int column = 0; column + 1 < row.columns(); ++column) {
    switch (row.type(column)) {
      case Statement::Type::integer:
        checksum.add(row.integer(column));
        break;
      case Statement::Type::real:
        checksum.add(row.real(column));
        break;
      case Statement::Type::text:
      case Statement::Type::other:
        checksum.add(row.text(column));
        break;
      case Statement::Type::null:
        checksum.add_null();
    }
  }
  return checksum.value();
}

std::uint64_t digest_term(const CheckedRow& row) {
  // The finaliser of SplitMix64 (Steele, Lea, Flood 2014, doi 10.1145/2660193.2660195).
  std::uint64_t z = row.crc + 0x9E3779B97F4A7C15u * (row.trial + 1);
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
  z = (z ^ z >> 27) * 0x94D049BB133111EBu;
  return z ^ z >> 31;
}

}  // namespace alea::experiments
