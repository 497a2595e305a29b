#include "experiments/engine/trial_store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <charconv>

#include "alea/core/error.hpp"
#include "experiments/engine/configuration.hpp"
#include "experiments/engine/store_check.hpp"
#include "experiments/engine/store_tables.hpp"

namespace alea::experiments {
namespace {

namespace fs = std::filesystem;

/// PRAGMA page_count of a file with an unfinished transaction is that before it only after the
/// journal is rolled back, which the first read does.
void roll_back_unfinished(Database& database) {
  Statement first(database, "SELECT count(*) FROM sqlite_master");
  first.run();
}

}  // namespace

Shard parse_shard(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, shard.index);
  bool right = error == std::errc{} && slash != end && *slash == '/';
  if (right) {
    const auto [rest, second] = std::from_chars(slash + 1, end, shard.count);
    right = second == std::errc{} && rest == end;
  }
  if (!right || shard.index < 1 || shard.index > shard.count || shard.count > 1'000'000)
    throw usage_error(
        fmt::format("--shard: '{}' is not K/N with 1 <= K <= N; write e.g. 2/3", text));
  return shard;
}

std::string to_text(const Shard& shard) {
  return fmt::format("{}/{}", shard.index, shard.count);
}

/// An open-file-description lock far behind the bytes that SQLite locks. It must be closed after
/// the connection: closing any descriptor of a file drops the locks that SQLite holds on it.
class TrialStore::FileLock {
 public:
  explicit FileLock(const fs::path& file) : descriptor_(::open(file.c_str(), O_RDWR | O_CLOEXEC)) {
    struct flock wanted {};
    wanted.l_type = F_WRLCK;
    wanted.l_whence = SEEK_SET;
    wanted.l_start = std::int64_t{1} << 61;
    wanted.l_len = 1;
    // A file system without such locks gives another error, and the lock is done without.
    if (descriptor_ >= 0 && ::fcntl(descriptor_, F_OFD_SETLK, &wanted) != 0 &&
        (errno == EAGAIN || errno == EACCES)) {
      ::close(descriptor_);
      throw input_error(fmt::format(
          "{}: another run is writing to it; wait for that one, or choose another --out",
          file.string()));
    }
  }
  ~FileLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

TrialStore::~TrialStore() = default;
TrialStore::TrialStore(TrialStore&&) noexcept = default;

TrialStore::TrialStore(const fs::path& file, Database::Mode mode, std::unique_ptr<FileLock> lock)
    : lock_(std::move(lock)), database_(std::make_unique<Database>(file, mode)) {
  roll_back_unfinished(*database_);
  check_size(*database_);
  configuration_ = stored_configuration(*database_);
  spec_ = std::make_unique<SweepSpec>(spec_from(configuration_));
  shard_ = stored_shard(*database_);
  StoreContents contents = check_rows(*database_, *spec_);
  done_ = std::move(contents.done);
  done_units_ = contents.done_units;
}

TrialStore TrialStore::create(const fs::path& folder, const SweepSpec& spec, const Shard& shard) {
  NewStoreFile file(folder);
  {
    Database database(file.unfinished(), Database::Mode::create);
    create_tables(database, spec, configuration_of(spec), shard);
  }
  file.finish();
  return resume(folder);
}

TrialStore TrialStore::resume(const fs::path& folder) {
  const fs::path file = folder / file_name;
  TrialStore store(file, Database::Mode::write, std::make_unique<FileLock>(file));
  store.writer_ = std::make_unique<TrialWriter>(*store.database_, *store.spec_);
  return store;
}

TrialStore TrialStore::read(const fs::path& folder) {
  if (!fs::exists(folder / file_name))
    throw input_error(fmt::format("{}: there is no {} in it; name a folder that alea sweep wrote",
                                  folder.string(), file_name));
  // A killed run leaves a journal, which only a writer can roll back.
  const bool unfinished = fs::exists(folder / (std::string(file_name) + "-journal"));
  return {folder / file_name, unfinished ? Database::Mode::write : Database::Mode::read, nullptr};
}

bool TrialStore::has(std::uint64_t cell, std::uint64_t trial) const {
  return done_[cell * spec_->trials + trial];
}

void TrialStore::begin_run(const StoreRun& run) {
  Statement insert(*database_,
                   "INSERT INTO runs (started, version, git_commit, machine, threads, rows, "
                   "duration_s) VALUES (?, ?, ?, ?, ?, 0, 0) RETURNING run");
  insert.bind(0, run.started);
  insert.bind(1, run.version);
  insert.bind(2, run.git_commit);
  insert.bind(3, run.machine);
  insert.bind(4, static_cast<std::int64_t>(run.threads));
  while (insert.next()) run_ = insert.integer(0);
  run_rows_ = 0;
}

void TrialStore::add(std::uint64_t cell, std::uint64_t trial, const std::vector<TrialRow>& rows) {
  waiting_.push_back({cell, trial, rows});
}

void TrialStore::commit(double run_duration_s) {
  Transaction transaction(*database_);
  std::map<std::uint64_t, std::pair<std::uint64_t, std::uint64_t>> sums;  // rows, digest
  std::uint64_t rows = 0;
  for (const Waiting& unit : waiting_) {
    auto& [cell_rows, digest] = sums[unit.cell];
    for (const TrialRow& row : unit.rows)
      digest += digest_term(writer_->write(unit.cell, unit.trial, row));
    cell_rows += unit.rows.size();
    rows += unit.rows.size();
  }
  for (const auto& [cell, sum] : sums) add_to_cell(*database_, cell, sum.first, sum.second);
  Statement run(*database_, "UPDATE runs SET rows = ?, duration_s = ? WHERE run = ?");
  run.bind(0, static_cast<std::int64_t>(run_rows_ + rows));
  run.bind(1, run_duration_s);
  run.bind(2, run_);
  run.run();
  transaction.commit();
  for (const Waiting& unit : waiting_) done_[unit.cell * spec_->trials + unit.trial] = true;
  done_units_ += waiting_.size();
  run_rows_ += rows;
  waiting_.clear();
}

}  // namespace alea::experiments
