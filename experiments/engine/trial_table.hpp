#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/engine/database.hpp"
#include "experiments/engine/sweep_spec.hpp"

namespace alea::experiments {

/// A column of the table `trials`.
struct TrialColumn {
  std::string name;
  std::string type;  ///< INTEGER, REAL or TEXT
};

/// The columns of a sweep's table in their order: sweep, cell, trial, estimator, one for each axis,
/// errors and bounds, the experiment's own, verdict, duration_s, crc32c (README.md of this folder).
std::vector<TrialColumn> trial_columns(const SweepSpec& spec);

/// Places of fixed columns; the axes begin at `first_axis`.
inline constexpr int sweep_column = 0, cell_column = 1, trial_column = 2, estimator_column = 3,
                     first_axis = 4;

/// Makes the table `trials`.
void create_trial_table(Database& database, const SweepSpec& spec);

/// A row of the table with its checksum.
struct CheckedRow {
  std::uint64_t cell = 0, trial = 0;
  std::uint32_t crc = 0;
};

/// Adds rows to the table and tells their checksums.
class TrialWriter {
 public:
  TrialWriter(Database& database, const SweepSpec& spec);
  CheckedRow write(std::uint64_t cell, std::uint64_t trial, const TrialRow& row);

 private:
  const SweepSpec& spec_;
  std::size_t extra_;
  Statement insert_;
};

/// CRC-32C over every column of the statement's row but the last: for each its type (i, r, t or n)
/// and its value, integers and doubles with their eight bytes, least first, texts with their length
/// before them.
std::uint32_t row_checksum(const Statement& row);

/// What a cell's digest sums up: the rows' checksums, each spread over 64 bits. A sum modulo 2^64
/// does not depend on the order of the rows, so shards and threads agree.
std::uint64_t digest_term(const CheckedRow& row);

}  // namespace alea::experiments
