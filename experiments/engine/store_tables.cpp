#include "experiments/engine/store_tables.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "alea/core/error.hpp"
#include "experiments/engine/crc32c.hpp"
#include "experiments/engine/folder.hpp"

namespace alea::experiments {
namespace {

namespace fs = std::filesystem;

constexpr int application_id = 0x416C6561;  // "Alea"

std::string value_of(Database& database, const std::string& key) {
  Statement get(database, "SELECT value FROM store WHERE key = ?");
  get.bind(0, key);
  if (!get.next())
    throw input_error(
        fmt::format("{}: damaged: it has no {}; restore a copy, or remove it and run "
                    "again",
                    database.path().string(), key));
  return get.text(0);
}

void make_durable(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void create_tables(Database& database, const SweepSpec& spec, const std::string& configuration,
                   const Shard& shard) {
  database.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", application_id,
                           sweep_schema));
  Transaction transaction(database);
  database.run("CREATE TABLE store (key TEXT PRIMARY KEY, value TEXT NOT NULL)");
  database.run(
      "CREATE TABLE cells (cell INTEGER PRIMARY KEY, rows INTEGER NOT NULL, digest INTEGER NOT "
      "NULL)");
  database.run(
      "CREATE TABLE runs (run INTEGER PRIMARY KEY, started TEXT, version TEXT, git_commit TEXT, "
      "machine TEXT, threads INTEGER, rows INTEGER, duration_s REAL)");
  create_trial_table(database, spec);
  Statement put(database, "INSERT INTO store VALUES (?, ?)");
  for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{
           {"configuration", configuration},
           {"configuration_crc32c", std::to_string(crc32c(configuration))},
           {"shard", to_text(shard)}}) {
    put.bind(0, key);
    put.bind(1, value);
    put.run();
  }
  Statement cell(database, "INSERT INTO cells VALUES (?, 0, 0)");
  for (std::uint64_t c = 0; c < spec.cells(); ++c) {
    cell.bind(0, static_cast<std::int64_t>(c));
    cell.run();
  }
  transaction.commit();
}

std::string stored_configuration(Database& database) {
  const std::string configuration = value_of(database, "configuration");
  if (value_of(database, "configuration_crc32c") != std::to_string(crc32c(configuration)))
    throw input_error(database.path().string() +
                      ": damaged: its configuration does not match its checksum; restore a copy, "
                      "or remove it and run again");
  return configuration;
}

Shard stored_shard(Database& database) {
  return parse_shard(value_of(database, "shard"));
}

void add_to_cell(Database& database, std::uint64_t cell, std::uint64_t rows, std::uint64_t digest) {
  // SQLite makes doubles of sums beyond 63 bits, so the sum is made here.
  Statement get(database, "SELECT rows, digest FROM cells WHERE cell = ?");
  get.bind(0, static_cast<std::int64_t>(cell));
  if (!get.next()) database.fail("has lost a cell");
  const auto all_rows = static_cast<std::uint64_t>(get.integer(0)) + rows;
  const auto all = static_cast<std::uint64_t>(get.integer(1)) + digest;
  Statement put(database, "UPDATE cells SET rows = ?, digest = ? WHERE cell = ?");
  put.bind(0, static_cast<std::int64_t>(all_rows));
  put.bind(1, static_cast<std::int64_t>(all));
  put.bind(2, static_cast<std::int64_t>(cell));
  put.run();
}

NewStoreFile::NewStoreFile(const fs::path& folder) : path_(folder / TrialStore::file_name) {
  make_folder(folder);
  if (fs::exists(path_))
    throw input_error(fmt::format(
        "{}: there is a store already; continue it with --resume or choose another --out",
        path_.string()));
  unfinished_ = folder / fmt::format(".{}.{}", TrialStore::file_name, ::getpid());
  std::error_code ignored;
  fs::remove(unfinished_, ignored);
}

NewStoreFile::~NewStoreFile() {
  std::error_code ignored;
  fs::remove(unfinished_, ignored);
}

void NewStoreFile::finish() {
  make_durable(unfinished_);
  std::error_code error;
  fs::rename(unfinished_, path_, error);
  if (error)
    throw input_error(fmt::format("{}: cannot be made ({}); choose another --out", path_.string(),
                                  error.message()));
  make_durable(path_.parent_path());
}

}  // namespace alea::experiments
