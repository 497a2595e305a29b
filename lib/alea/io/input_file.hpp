#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace alea {

/// A whole file, mapped for reading.
class InputFile {
 public:
  /// Throws Error(input) where the file cannot be opened or is not a regular file.
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }
  std::string_view bytes() const { return {data_, size_}; }

  /// Gives back the memory of everything before `offset`; it is read again if touched again.
  void release_before(std::size_t offset) const;
  /// Throws Error(input) if the file was changed in size since it was opened.
  void check_unchanged() const;

 private:
  std::string path_;
  int descriptor_ = -1;
  const char* data_ = nullptr;
  std::size_t size_ = 0;
  int slot_ = -1;
};

/// The path of the mapped file that holds this address, or null. Async-signal-safe: for a SIGBUS
/// handler, since a mapped file that is cut short by another program raises that signal.
const char* mapped_path_of(const void* address) noexcept;

}  // namespace alea
