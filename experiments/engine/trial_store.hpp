#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/engine/database.hpp"
#include "experiments/engine/sweep_spec.hpp"
#include "experiments/engine/trial_table.hpp"

namespace alea::experiments {

/// Every N-th trial: shard K of N, from one. Unit u = cell * trials + trial belongs to shard
/// u mod N + 1, so that each cell is spread over all shards.
struct Shard {
  std::uint64_t index = 1;
  std::uint64_t count = 1;
  bool has(std::uint64_t unit) const { return unit % count == index - 1; }
  /// How many of `units` it has.
  std::uint64_t size(std::uint64_t units) const {
    return units / count + (units % count >= index ? 1 : 0);
  }
  bool operator==(const Shard&) const = default;
};

/// "2/3". Throws Error(usage) unless 1 <= K <= N.
Shard parse_shard(const std::string& text);
std::string to_text(const Shard& shard);

/// Who ran when; a row of the table `runs`.
struct StoreRun {
  std::string started;  ///< UTC, ISO 8601
  std::string version, git_commit, machine;
  int threads = 0;
};

/// The results of a sweep in DIR/results.sqlite: one row a trial and estimator, written in
/// transactions, so that a process killed at any moment leaves whole trials. SQLite's rollback
/// journal works on network file systems too. One writer at a time.
class TrialStore {
 public:
  static constexpr const char* file_name = "results.sqlite";

  /// Makes the store, which appears whole or not at all. Throws Error(input) where there is one.
  static TrialStore create(const std::filesystem::path& folder, const SweepSpec& spec,
                           const Shard& shard);
  /// Opens a store for adding to it and verifies every row. Throws Error(input) where anything is
  /// not as it was written.
  static TrialStore resume(const std::filesystem::path& folder);
  /// Opens and verifies for reading alone.
  static TrialStore read(const std::filesystem::path& folder);

  ~TrialStore();
  TrialStore(TrialStore&&) noexcept;

  const SweepSpec& spec() const { return *spec_; }
  /// As it was when the store was made: see configuration_of.
  const std::string& configuration() const { return configuration_; }
  const Shard& shard() const { return shard_; }
  bool has(std::uint64_t cell, std::uint64_t trial) const;
  std::uint64_t done_units() const { return done_units_; }
  bool complete() const { return done_units_ == shard_.size(spec_->units()); }

  /// Opens a row of the table `runs`, which later commits keep up to date.
  void begin_run(const StoreRun& run);
  /// Adds the rows of a trial; they are safe after commit().
  void add(std::uint64_t cell, std::uint64_t trial, const std::vector<TrialRow>& rows);
  void commit(double run_duration_s);
  Database& database() { return *database_; }

 private:
  struct Waiting {
    std::uint64_t cell, trial;
    std::vector<TrialRow> rows;
  };
  class FileLock;
  TrialStore(const std::filesystem::path& file, Database::Mode mode,
             std::unique_ptr<FileLock> lock);

  std::unique_ptr<FileLock> lock_;  // outlives the connection
  std::unique_ptr<Database> database_;
  std::string configuration_;
  std::unique_ptr<SweepSpec> spec_;
  Shard shard_;
  std::vector<bool> done_;  // by unit
  std::uint64_t done_units_ = 0;
  std::vector<Waiting> waiting_;
  std::unique_ptr<TrialWriter> writer_;
  std::int64_t run_ = 0;
  std::uint64_t run_rows_ = 0;
};

}  // namespace alea::experiments
