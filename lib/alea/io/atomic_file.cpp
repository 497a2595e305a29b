#include "alea/io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "alea/core/error.hpp"

namespace alea {
namespace {

// What a signal handler may read: fixed memory, filled before the file exists and emptied after it
// is gone.
constexpr int slot_count = 64;
struct Slot {
  std::atomic<bool> taken{false};
  std::atomic<bool> armed{false};
  std::array<char, 4096> path{};
};
std::array<Slot, slot_count> slots;

int take_slot(const std::string& path) {
  if (path.size() + 1 > slots[0].path.size()) return -1;
  for (int i = 0; i < slot_count; ++i) {
    bool expected = false;
    if (!slots[i].taken.compare_exchange_strong(expected, true)) continue;
    std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
    slots[i].armed = true;
    return i;
  }
  return -1;
}

void release_slot(int slot) {
  if (slot < 0) return;
  slots[slot].armed = false;
  slots[slot].taken = false;
}

std::atomic<unsigned> temporary_number{0};

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path) {
  struct stat old {};
  const bool exists = ::stat(path_.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode))
    throw input_error(
        fmt::format("{}: cannot write: it is a directory; name a file", path_.string()));
  if (exists && ::access(path_.c_str(), W_OK) != 0) fail_to_open(errno);
  if (exists && !S_ISREG(old.st_mode)) {
    open_directly();
    return;
  }
  open_beside();
  // A file that only its owner may read stays one.
  if (exists) ::fchmod(::fileno(file_), old.st_mode & 07777);
}

void AtomicFile::fail_to_open(int cause) const {
  throw input_error(
      fmt::format("{}: cannot write: {}; choose a folder that exists and can be written",
                  path_.string(), std::generic_category().message(cause)));
}

// A device or a pipe (/dev/stdout, /dev/null) stays what it is: it is written, not replaced.
void AtomicFile::open_directly() {
  file_ = std::fopen(path_.c_str(), "wbe");
  if (file_ == nullptr) fail_to_open(errno);
}

void AtomicFile::open_beside() {
  // The file that a symbolic link names is replaced, not the link.
  std::error_code ignored;
  const std::filesystem::path target = std::filesystem::canonical(path_, ignored);
  target_ = target.empty() ? path_ : target;
  const unsigned number = temporary_number++;
  temporary_ = target_;
  temporary_ += fmt::format(".part-{}-{}", ::getpid(), number);
  slot_ = take_slot(temporary_.string());
  const int descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    const int cause = errno;
    release_slot(slot_);
    slot_ = -1;
    fail_to_open(cause);
  }
  file_ = ::fdopen(descriptor, "wb");
  std::setvbuf(file_, nullptr, _IOFBF, 1 << 20);
}

AtomicFile::~AtomicFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  release_slot(slot_);
}

void AtomicFile::fail(const char* action) const {
  throw input_error(fmt::format("{}: cannot {}: {}; the old file, if any, is untouched",
                                path_.string(), action, std::generic_category().message(errno)));
}

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("write");
}

void AtomicFile::write_at(std::uint64_t offset, std::string_view bytes) {
  const off_t end = ::ftello(file_);
  if (::fseeko(file_, static_cast<off_t>(offset), SEEK_SET) != 0) fail("seek");
  write(bytes);
  if (::fseeko(file_, end, SEEK_SET) != 0) fail("seek");
}

void AtomicFile::commit() {
  const bool direct = temporary_.empty();
  if (std::fflush(file_) != 0 || (!direct && ::fsync(::fileno(file_)) != 0)) fail("write");
  const int closed = std::fclose(file_);
  file_ = nullptr;
  if (closed != 0 || (!direct && ::rename(temporary_.c_str(), target_.c_str()) != 0)) {
    const int cause = errno;
    if (!direct) ::unlink(temporary_.c_str());
    release_slot(slot_);
    errno = cause;
    fail("finish");
  }
  release_slot(slot_);
}

void write_file_atomically(const std::filesystem::path& path, std::string_view contents) {
  AtomicFile file(path);
  file.write(contents);
  file.commit();
}

void remove_unfinished_files() noexcept {
  for (Slot& slot : slots)
    if (slot.armed) ::unlink(slot.path.data());
}

}  // namespace alea
