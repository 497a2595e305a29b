#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace alea::experiments {

/// A SQLite file. Every failure throws Error(input) with the file, SQLite's words and what to do.
class Database {
 public:
  enum class Mode { read, write, create };

  Database(const std::filesystem::path& path, Mode mode);
  ~Database();
  Database(Database&&) noexcept;
  Database& operator=(Database&&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Runs SQL that returns nothing.
  void run(const std::string& sql);
  [[noreturn]] void fail(const std::string& doing) const;

 private:
  friend class Statement;
  std::filesystem::path path_;
  sqlite3* handle_ = nullptr;
};

/// A prepared statement; parameters and columns count from zero.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(int parameter, std::int64_t value);
  /// Not-a-number becomes NULL.
  void bind(int parameter, double value);
  void bind(int parameter, const std::string& value);
  void bind_null(int parameter);
  /// The next row; false where there is none.
  bool next();
  /// Runs it to the end and makes it ready for new parameters.
  void run();

  enum class Type { integer, real, text, null, other };
  int columns() const;
  std::string name(int column) const;
  Type type(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;

 private:
  Database& database_;
  sqlite3_stmt* handle_ = nullptr;
};

/// A transaction that is undone unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace alea::experiments
