#include "experiments/engine/database.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cmath>
#include <utility>

#include "alea/core/error.hpp"

namespace alea::experiments {
namespace {

int flags_of(Database::Mode mode) {
  switch (mode) {
    case Database::Mode::read:
      return SQLITE_OPEN_READONLY;
    case Database::Mode::write:
      return SQLITE_OPEN_READWRITE;
    case Database::Mode::create:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  }
  return SQLITE_OPEN_READONLY;
}

const char* advice(int code) {
  switch (code & 0xFF) {
    case SQLITE_FULL:
    case SQLITE_IOERR:
      return "what was stored before is safe; free space and run again with --resume";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program holds it; wait for that one to end";
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return "the store is damaged; restore a copy, or remove it and run again";
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
      return "check that the folder exists and may be written";
    default:
      return "the store may be damaged or made by another version";
  }
}

}  // namespace

Database::Database(const std::filesystem::path& path, Mode mode) : path_(path) {
  const int code = sqlite3_open_v2(path.c_str(), &handle_, flags_of(mode), nullptr);
  if (code != SQLITE_OK) {
    const std::string message = fmt::format("{}: cannot be opened ({}); {}", path.string(),
                                            sqlite3_errstr(code), advice(code));
    sqlite3_close(handle_);
    throw input_error(message);
  }
  sqlite3_extended_result_codes(handle_, 1);
  sqlite3_busy_timeout(handle_, 5000);
}

Database::Database(Database&& other) noexcept
    : path_(std::move(other.path_)), handle_(std::exchange(other.handle_, nullptr)) {}

Database::~Database() {
  sqlite3_close(handle_);
}

void Database::run(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    fail("cannot be written or read");
}

void Database::fail(const std::string& doing) const {
  throw input_error(fmt::format("{}: {} ({}); {}", path_.string(), doing, sqlite3_errmsg(handle_),
                                advice(sqlite3_errcode(handle_))));
}

Statement::Statement(Database& database, const std::string& sql) : database_(database) {
  if (sqlite3_prepare_v2(database.handle_, sql.c_str(), -1, &handle_, nullptr) != SQLITE_OK)
    database.fail("is no store of trials, or a damaged one");
}

Statement::~Statement() {
  sqlite3_finalize(handle_);
}

void Statement::bind(int parameter, std::int64_t value) {
  sqlite3_bind_int64(handle_, parameter + 1, value);
}

void Statement::bind(int parameter, double value) {
  if (std::isnan(value))
    bind_null(parameter);
  else
    sqlite3_bind_double(handle_, parameter + 1, value);
}

void Statement::bind(int parameter, const std::string& value) {
  sqlite3_bind_text(handle_, parameter + 1, value.data(), static_cast<int>(value.size()),
                    SQLITE_TRANSIENT);
}

void Statement::bind_null(int parameter) {
  sqlite3_bind_null(handle_, parameter + 1);
}

bool Statement::next() {
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) {
    sqlite3_reset(handle_);
    database_.fail("cannot be written or read");
  }
  return false;
}

void Statement::run() {
  while (next()) {
  }
  sqlite3_reset(handle_);
}

int Statement::columns() const {
  return sqlite3_column_count(handle_);
}

std::string Statement::name(int column) const {
  return sqlite3_column_name(handle_, column);
}

Statement::Type Statement::type(int column) const {
  switch (sqlite3_column_type(handle_, column)) {
    case SQLITE_INTEGER:
      return Type::integer;
    case SQLITE_FLOAT:
      return Type::real;
    case SQLITE_TEXT:
      return Type::text;
    case SQLITE_NULL:
      return Type::null;
    default:
      return Type::other;
  }
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(handle_, column);
}

double Statement::real(int column) const {
  return sqlite3_column_double(handle_, column);
}

std::string Statement::text(int column) const {
  const auto* const begin = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  const int size = sqlite3_column_bytes(handle_, column);
  return begin == nullptr ? std::string() : std::string(begin, static_cast<std::size_t>(size));
}

Transaction::Transaction(Database& database) : database_(database) {
  database_.run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    database_.run("ROLLBACK");
  } catch (const Error&) {
    // SQLite has rolled back by itself.
  }
}

void Transaction::commit() {
  database_.run("COMMIT");
  open_ = false;
}

}  // namespace alea::experiments
