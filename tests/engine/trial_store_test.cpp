#include "experiments/engine/trial_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "alea/core/error.hpp"
#include "experiments/engine/comparable_rows.hpp"
#include "experiments/engine/configuration.hpp"
#include "experiments/engine/sweep_run.hpp"
#include "tests/engine/sweep_files.hpp"

namespace alea::experiments {
namespace {

namespace fs = std::filesystem;
using alea::testing::TemporaryFolder;
using ::testing::HasSubstr;
using testing::small_spec;

std::vector<TrialRow> rows_of(double value) {
  std::vector<TrialRow> rows(2);
  rows[0].estimator = "closed_form";
  rows[1].estimator = "paper";
  for (TrialRow& row : rows) {
    row.rotation_error_rad = value;
    row.translation_error_m = 0;
    row.extra = {no_number, -0.0};
    row.verdict = "registered";
    row.duration_s = 1e-3;
  }
  return rows;
}

/// A store with all trials of two cells.
void fill(const fs::path& folder) {
  TrialStore store = TrialStore::create(folder, small_spec(), {});
  store.begin_run(this_run());
  for (std::uint64_t cell = 0; cell < 2; ++cell)
    for (std::uint64_t trial = 0; trial < 7; ++trial)
      store.add(cell, trial, rows_of(1e-4 * static_cast<double>(1 + trial)));
  store.commit(1);
}

std::string message_of_reading(const fs::path& folder) {
  try {
    TrialStore::read(folder);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(TrialStore, KnowsWhatItHolds) {
  const TemporaryFolder folder;
  fill(folder.path());
  const TrialStore store = TrialStore::read(folder.path());
  EXPECT_EQ(store.done_units(), 14u);
  EXPECT_TRUE(store.has(1, 6));
  EXPECT_FALSE(store.has(2, 0));
  EXPECT_FALSE(store.complete());
  EXPECT_EQ(store.configuration(), configuration_of(small_spec()));
}

TEST(TrialStore, WhatWasNotCommittedIsNotThere) {
  const TemporaryFolder folder;
  {
    TrialStore store = TrialStore::create(folder.path(), small_spec(), {});
    store.add(0, 0, rows_of(1));
    store.commit(0);
    store.add(0, 1, rows_of(1));
  }
  EXPECT_EQ(TrialStore::read(folder.path()).done_units(), 1u);
}

TEST(TrialStore, IsNeverOverwritten) {
  const TemporaryFolder folder;
  fill(folder.path());
  EXPECT_THROW(TrialStore::create(folder.path(), small_spec(), {}), Error);
}

TEST(TrialStore, HasOneWriterAtATime) {
  const TemporaryFolder folder;
  fill(folder.path());
  const TrialStore first = TrialStore::resume(folder.path());
  EXPECT_THROW(TrialStore::resume(folder.path()), Error);
  EXPECT_EQ(TrialStore::read(folder.path()).done_units(), 14u) << "reading is free";
}

TEST(TrialStore, ReportsARowThatWasChangedOrTakenAway) {
  for (const std::string sql :
       {"UPDATE trials SET rotation_error_rad = rotation_error_rad * 1.0000001 WHERE trial = 3",
        "UPDATE trials SET verdict = 'registerec' WHERE trial = 3",
        "UPDATE trials SET trial = 8 WHERE trial = 3", "DELETE FROM trials WHERE trial = 3",
        "DELETE FROM trials WHERE estimator = 'paper' AND trial = 2", "DELETE FROM cells",
        "UPDATE cells SET digest = digest + 1",
        "UPDATE store SET value = replace(value, '\"step_mrad\":5.0', '\"step_mrad\":6.0') WHERE "
        "key = 'configuration'",
        "DROP TABLE trials"}) {
    const TemporaryFolder folder;
    fill(folder.path());
    Database database(folder.path() / TrialStore::file_name, Database::Mode::write);
    database.run(sql);
    EXPECT_THAT(message_of_reading(folder.path()), HasSubstr("damaged")) << sql;
  }
}

TEST(TrialStore, ReportsEveryTruncation) {
  const TemporaryFolder folder;
  fill(folder.path());
  const fs::path file = folder.path() / TrialStore::file_name;
  const auto size = fs::file_size(file);
  for (std::uintmax_t keep :
       {size - 1, size - 4096, size / 2, std::uintmax_t{100}, std::uintmax_t{0}}) {
    const TemporaryFolder copy;
    fs::copy_file(file, copy.path() / TrialStore::file_name);
    fs::resize_file(copy.path() / TrialStore::file_name, keep);
    EXPECT_THROW(TrialStore::read(copy.path()), Error) << keep << " of " << size;
    EXPECT_THROW(TrialStore::resume(copy.path()), Error) << keep << " of " << size;
  }
}

TEST(TrialStore, ReportsAFlippedByteInARow) {
  const TemporaryFolder folder;
  fill(folder.path());
  const fs::path file = folder.path() / TrialStore::file_name;
  const std::string bytes = alea::testing::read_text(file);
  const std::string rows = all_rows(folder.path());
  std::size_t changed = 0;
  for (std::size_t at = 100; at < bytes.size(); at += 97) {
    const TemporaryFolder copy;
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    std::ofstream(copy.path() / TrialStore::file_name, std::ios::binary) << flipped;
    std::string seen;
    try {
      seen = all_rows(copy.path());
    } catch (const Error&) {
    }
    if (seen == rows) continue;  // not in a row's values
    ++changed;
    EXPECT_THROW(TrialStore::read(copy.path()), Error) << "byte " << at;
  }
  EXPECT_GT(changed, 20u);
}

TEST(Shard, SpreadsEveryCellAndCountsItsUnits) {
  const Shard shard = parse_shard("2/3");
  std::uint64_t count = 0;
  for (std::uint64_t unit = 0; unit < 100; ++unit) count += shard.has(unit) ? 1 : 0;
  EXPECT_EQ(shard.size(100), count);
  EXPECT_EQ(
      parse_shard("1/3").size(100) + parse_shard("2/3").size(100) + parse_shard("3/3").size(100),
      100u);
  for (const char* const wrong : {"", "3", "0/3", "4/3", "1/0", "-1/3", "1/3x", "a/b", "1/"})
    EXPECT_THROW(parse_shard(wrong), Error) << wrong;
}

}  // namespace
}  // namespace alea::experiments
