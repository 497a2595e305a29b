#include <fmt/format.h>

#include "alea/core/error.hpp"
#include "experiments/engine/configuration.hpp"
#include "experiments/engine/store_tables.hpp"
#include "experiments/engine/sweep_export.hpp"

namespace alea::experiments {
namespace {

namespace fs = std::filesystem;

std::string place_of(std::uint64_t unit, const SweepSpec& spec) {
  return fmt::format("cell {}, trial {}", unit / spec.trials, unit % spec.trials);
}

/// Verifies the stores one by one and who has which trial.
class Census {
 public:
  void add(const fs::path& folder) {
    const TrialStore store = TrialStore::read(folder);
    if (folders_.empty()) {
      configuration_ = store.configuration();
      owner_.assign(store.spec().units(), 0);
    } else if (store.configuration() != configuration_) {
      throw input_error(fmt::format("{}: another configuration than {}; merge shards of one sweep",
                                    folder.string(), folders_.front().string()));
    }
    folders_.push_back(folder);
    const SweepSpec& spec = store.spec();
    for (std::uint64_t unit = 0; unit < owner_.size(); ++unit) {
      if (!store.has(unit / spec.trials, unit % spec.trials)) continue;
      if (owner_[unit] > 0)
        throw input_error(fmt::format("{}: {} is in {} too; name every shard once", folder.string(),
                                      place_of(unit, spec), folders_[owner_[unit] - 1].string()));
      owner_[unit] = static_cast<std::uint32_t>(folders_.size());
    }
  }

  void finish() const {
    std::uint64_t missing = 0, first = 0;
    for (std::uint64_t unit = owner_.size(); unit-- > 0;)
      if (owner_[unit] == 0) ++missing, first = unit;
    if (missing > 0)
      throw input_error(fmt::format(
          "{}: {} of {} trials are missing here and in the others, the first is {}; finish the "
          "shards with --resume and name them all",
          folders_.front().string(), missing, owner_.size(),
          place_of(first, spec_from(configuration_))));
  }

  const std::string& configuration() const { return configuration_; }

 private:
  std::vector<fs::path> folders_;
  std::string configuration_;
  std::vector<std::uint32_t> owner_;  // of each unit: place in folders_ plus one
};

void copy_rows(Database& out, const fs::path& part) {
  {
    Statement attach(out, "ATTACH ? AS part");
    attach.bind(0, part.string());
    attach.run();
  }
  {
    Transaction transaction(out);
    out.run("INSERT INTO trials SELECT * FROM part.trials");
    out.run(
        "INSERT INTO runs SELECT NULL, started, version, git_commit, machine, threads, rows, "
        "duration_s FROM part.runs");
    Statement cells(out, "SELECT cell, rows, digest FROM part.cells");
    while (cells.next())
      add_to_cell(out, static_cast<std::uint64_t>(cells.integer(0)),
                  static_cast<std::uint64_t>(cells.integer(1)),
                  static_cast<std::uint64_t>(cells.integer(2)));
    transaction.commit();
  }
  out.run("DETACH part");
}

}  // namespace

std::uint64_t merge_stores(const std::vector<fs::path>& folders, const fs::path& out) {
  if (folders.empty()) throw usage_error("merge: name the folders of the shards");
  Census census;
  for (const fs::path& folder : folders) census.add(folder);
  census.finish();
  const SweepSpec spec = spec_from(census.configuration());
  NewStoreFile file(out);
  {
    Database database(file.unfinished(), Database::Mode::create);
    // The file is nobody's yet: it is made durable as a whole at the end.
    database.run("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF");
    create_tables(database, spec, census.configuration(), {});
    for (const fs::path& folder : folders) copy_rows(database, folder / TrialStore::file_name);
  }
  file.finish();
  return spec.units();
}

}  // namespace alea::experiments
