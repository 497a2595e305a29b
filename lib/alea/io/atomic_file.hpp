#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace alea {

/// A file that appears whole or not at all: written beside its final path, renamed by commit(),
/// removed if the object dies before that or the process is interrupted.
class AtomicFile {
 public:
  /// Throws Error(input) with path and cause where the folder cannot be written.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes; throws Error(input) where they cannot be written (disk full).
  void write(std::string_view bytes);
  /// Overwrites bytes at an earlier offset, e.g. a header's count.
  void write_at(std::uint64_t offset, std::string_view bytes);
  /// Flushes, syncs and renames onto the final path. Throws Error(input).
  void commit();

 private:
  [[noreturn]] void fail(const char* action) const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::FILE* file_ = nullptr;
  int slot_ = -1;
};

/// One call for small contents. Throws Error(input).
void write_file_atomically(const std::filesystem::path& path, std::string_view contents);

/// Unlinks every temporary file that is not committed yet. Async-signal-safe: for a SIGINT handler.
void remove_unfinished_files() noexcept;

}  // namespace alea
