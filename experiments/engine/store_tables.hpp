#pragma once

#include <string>

#include "experiments/engine/database.hpp"
#include "experiments/engine/sweep_spec.hpp"
#include "experiments/engine/trial_store.hpp"

namespace alea::experiments {

/// Makes the tables of a new store (README.md of this folder) for a sweep with this configuration,
/// which is that of `spec` as the program wrote it first.
void create_tables(Database& database, const SweepSpec& spec, const std::string& configuration,
                   const Shard& shard);

/// The configuration, verified against its checksum. Throws Error(input).
std::string stored_configuration(Database& database);
Shard stored_shard(Database& database);

/// Adds to the count of rows and to the digest of a cell.
void add_to_cell(Database& database, std::uint64_t cell, std::uint64_t rows, std::uint64_t digest);

/// A new file beside its final place; finish() makes it durable and moves it there. Throws
/// Error(input).
class NewStoreFile {
 public:
  /// Makes the folder; throws where there is a store in it already.
  explicit NewStoreFile(const std::filesystem::path& folder);
  ~NewStoreFile();
  NewStoreFile(const NewStoreFile&) = delete;
  NewStoreFile& operator=(const NewStoreFile&) = delete;
  const std::filesystem::path& unfinished() const { return unfinished_; }
  void finish();

 private:
  std::filesystem::path path_, unfinished_;
};

}  // namespace alea::experiments
