#include "experiments/engine/sweep_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "experiments/engine/comparable_rows.hpp"
#include "experiments/engine/csv_table.hpp"
#include "experiments/engine/sweep_export.hpp"
#include "tests/engine/sweep_files.hpp"

namespace alea::experiments {
namespace {

namespace fs = std::filesystem;
using alea::testing::TemporaryFolder;
using ::testing::HasSubstr;
using testing::small_spec;
using testing::spec_of;

void run(const fs::path& folder, const Shard& shard = {}, const SweepRunOptions& options = {},
         const SweepSpec& spec = small_spec()) {
  TrialStore store = fs::exists(folder / TrialStore::file_name)
                         ? TrialStore::resume(folder)
                         : TrialStore::create(folder, spec, shard);
  store.begin_run(this_run());
  run_sweep(store, options);
}

std::string whole_run() {
  const TemporaryFolder folder;
  run(folder.path());
  return comparable_rows(folder.path());
}

std::string message_of_merge(const std::vector<fs::path>& folders, const fs::path& out) {
  try {
    merge_stores(folders, out);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SweepRun, ThreadsAndOrderLeaveNoTrace) {
  const std::string rows = whole_run();
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 4 * 7 * 2);
  const TemporaryFolder one, reversed;
  {
    const ThreadLimit limit(1);
    run(one.path());
  }
  run(reversed.path(), {}, {.reversed = true});
  EXPECT_EQ(comparable_rows(one.path()), rows);
  EXPECT_EQ(comparable_rows(reversed.path()), rows);
}

TEST(SweepRun, ShardsMergeToTheWhole) {
  const TemporaryFolder folder;
  std::vector<fs::path> shards;
  for (std::uint64_t k = 1; k <= 3; ++k) {
    shards.push_back(folder.path() / std::to_string(k));
    run(shards.back(), {k, 3});
  }
  EXPECT_EQ(merge_stores(shards, folder.path() / "all"), 28u);
  EXPECT_EQ(comparable_rows(folder.path() / "all"), whole_run());
  EXPECT_TRUE(TrialStore::read(folder.path() / "all").complete());
}

TEST(SweepRun, AMergeRefusesGapsDoublesAndAnotherConfiguration) {
  const TemporaryFolder folder;
  const fs::path one = folder.path() / "1", two = folder.path() / "2", other = folder.path() / "x";
  run(one, {1, 2});
  run(two, {2, 2});
  run(other, {2, 2}, {}, spec_of(testing::replaced(testing::small_sweep(), "[0.5, 2]", "[1, 2]")));
  const fs::path out = folder.path() / "out";
  EXPECT_THAT(message_of_merge({one}, out), HasSubstr("14 of 28 trials are missing"));
  EXPECT_THAT(message_of_merge({one, two, one}, out), HasSubstr("is in"));
  EXPECT_THAT(message_of_merge({one, other}, out), HasSubstr("another configuration"));
  EXPECT_FALSE(fs::exists(out / TrialStore::file_name));
  EXPECT_THAT(message_of_merge({one, two}, two), HasSubstr("there is a store already"));
}

TEST(SweepRun, GoesOnWhereItWasStopped) {
  const TemporaryFolder folder;
  std::atomic<bool> stop = false;
  SweepRunOptions options;
  options.commit_interval_s = 0;
  options.stop = &stop;
  options.progress = [&](const std::string&, std::uint64_t done, std::uint64_t) {
    stop = done >= 5;
  };
  run(folder.path(), {}, options);
  const std::uint64_t first = TrialStore::read(folder.path()).done_units();
  EXPECT_GE(first, 5u);
  EXPECT_LT(first, 28u);
  run(folder.path());
  EXPECT_EQ(comparable_rows(folder.path()), whole_run());
  const std::string again = all_rows(folder.path());
  run(folder.path());
  EXPECT_EQ(all_rows(folder.path()), again) << "nothing is done twice";
}

TEST(SweepRun, ACellOfASweepIsTheSameInAnotherSweep) {
  const TemporaryFolder small, one_cell;
  run(small.path());
  const std::string text =
      testing::replaced(testing::replaced(testing::small_sweep(), "[0.5, 2]", "[2]"),
                        "[\"random\", \"parallelepiped\"]", "[\"parallelepiped\"]");
  run(one_cell.path(), {}, {}, spec_of(text));
  // Cell 3 of the one, cell 0 of the other: the trials are paired over cells and sweeps.
  const std::string all = comparable_rows(small.path()), part = comparable_rows(one_cell.path());
  const auto values = [](const std::string& line) { return line.substr(line.find("closed_form")); };
  EXPECT_EQ(values(all.substr(all.find("03|00|"))).substr(0, 80), values(part).substr(0, 80));
}

TEST(SweepExport, WritesTidyCsv) {
  const TemporaryFolder folder;
  run(folder.path());
  TrialStore store = TrialStore::read(folder.path());
  EXPECT_EQ(export_csv(store, folder.file("rows.csv")), 56u);
  const CsvTable table = read_csv(folder.file("rows.csv"));
  EXPECT_EQ(table.rows.size(), 56u);
  EXPECT_EQ(table.text(0, "estimator"), "closed_form");
  EXPECT_EQ(table.number(0, "range_noise_mm"), 0.5);
  EXPECT_GT(table.number(0, "rotation_error_rad").value(), 0);
  EXPECT_GT(table.number(0, "bound_rotation_rad").value(), 0);
  EXPECT_EQ(table.text(55, "tilt_kind"), "parallelepiped");
}

}  // namespace
}  // namespace alea::experiments
