#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace alea {

/// A file that appears whole or not at all: written beside its final path, renamed by commit(),
/// removed if the object dies before that or the process is interrupted. A file that is replaced
/// keeps its permissions; a symbolic link stays one. A device or a pipe is written directly.
class AtomicFile {
 public:
  /// Throws Error(input) with path and cause where the folder or the old file cannot be written.
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
  [[noreturn]] void fail_to_open(int cause) const;
  void open_directly();
  void open_beside();

  std::filesystem::path path_;       ///< as the caller named it
  std::filesystem::path target_;     ///< that is replaced
  std::filesystem::path temporary_;  ///< empty for a device or a pipe
  std::FILE* file_ = nullptr;
  int slot_ = -1;
};

/// One call for small contents. Throws Error(input).
void write_file_atomically(const std::filesystem::path& path, std::string_view contents);

/// Unlinks every temporary file that is not committed yet. Async-signal-safe: for a SIGINT handler.
void remove_unfinished_files() noexcept;

}  // namespace alea
