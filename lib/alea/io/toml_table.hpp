#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace alea {

/// Which numbers a key of a TOML file may hold.
enum class Allowed { any, positive, not_negative };

/// A table of a TOML file that says where it is wrong. Every reading function takes a key and a
/// value for the case that the key is missing, and throws Error(input) with file, line, key, value
/// and expectation where it holds something else. The keys that were asked for are remembered, so
/// that finish() can name the others.
class TomlTable {
 public:
  /// Reads and parses a whole file. Throws Error(input).
  static TomlTable read(const std::filesystem::path& file);
  ~TomlTable();
  TomlTable(TomlTable&&) noexcept;
  TomlTable& operator=(TomlTable&&) noexcept;

  bool has(const std::string& key) const;
  double number(const std::string& key, double missing, Allowed allowed = Allowed::any) const;
  std::int64_t integer(const std::string& key, std::int64_t missing, std::int64_t low,
                       std::int64_t high) const;
  bool flag(const std::string& key, bool missing) const;
  std::string text(const std::string& key, const std::string& missing) const;
  /// One of the given words; returns its position.
  std::size_t choice(const std::string& key, std::size_t missing,
                     const std::vector<std::string>& words) const;
  /// Texts in quotes [..]; empty where missing.
  std::vector<std::string> texts(const std::string& key) const;
  /// Finite numbers [..], as many as there are; empty where missing.
  std::vector<double> numbers(const std::string& key) const;
  Eigen::Vector3d vector3(const std::string& key, const Eigen::Vector3d& missing) const;
  /// The same for a key that must be there.
  Eigen::Vector3d vector3(const std::string& key) const;
  /// Points [[x, y, z], ...]; empty where missing.
  std::vector<Eigen::Vector3d> vectors(const std::string& key) const;
  /// Two numbers, the first not above the second.
  Eigen::Vector2d interval(const std::string& key, const Eigen::Vector2d& missing) const;

  /// [key], empty where missing.
  std::optional<TomlTable> table(const std::string& key) const;
  /// [[key]], in the order of the file.
  std::vector<TomlTable> tables(const std::string& key) const;

  /// Throws Error(input) for a key that is missing.
  void require(const std::string& key) const;
  /// Throws Error(input) naming the first key that nobody asked for, and those that exist.
  void finish() const;
  /// Throws Error(input): file, line of the key (of the table where the key is empty or missing),
  /// and what was expected.
  [[noreturn]] void fail(const std::string& key, const std::string& expectation) const;

 private:
  struct State;
  explicit TomlTable(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace alea
