#include "alea/io/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "alea/core/error.hpp"

namespace alea {
namespace {

// What a signal handler may read: fixed memory, filled before the mapping is touched.
struct Slot {
  std::atomic<bool> taken{false};
  std::atomic<std::uintptr_t> begin{0};
  std::atomic<std::uintptr_t> end{0};
  std::array<char, 4096> path{};
};
std::array<Slot, 64> slots;

int take_slot(const std::string& path, const void* data, std::size_t size) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    bool expected = false;
    if (!slots[i].taken.compare_exchange_strong(expected, true)) continue;
    const std::size_t length = std::min(path.size(), slots[i].path.size() - 1);
    std::memcpy(slots[i].path.data(), path.data(), length);
    slots[i].path[length] = 0;
    slots[i].begin = reinterpret_cast<std::uintptr_t>(data);
    slots[i].end = slots[i].begin + size;
    return static_cast<int>(i);
  }
  return -1;
}

[[noreturn]] void fail(const std::string& path, int cause) {
  throw input_error(fmt::format("{}: cannot read: {}; check the path and its permissions", path,
                                std::generic_category().message(cause)));
}

}  // namespace

InputFile::InputFile(const std::string& path) : path_(path) {
  // Without O_NONBLOCK a named pipe would block here for ever.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) fail(path, errno);
  struct stat status {};
  const bool known = ::fstat(descriptor_, &status) == 0;
  if (!known || !S_ISREG(status.st_mode)) {
    ::close(descriptor_);
    throw input_error(fmt::format("{}: not a regular file; save the scan to a file first", path));
  }
  size_ = static_cast<std::size_t>(status.st_size);
  if (size_ == 0) return;
  void* mapped = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor_, 0);
  if (mapped == MAP_FAILED) {
    const int cause = errno;
    ::close(descriptor_);
    fail(path, cause);
  }
  ::madvise(mapped, size_, MADV_SEQUENTIAL);
  data_ = static_cast<const char*>(mapped);
  slot_ = take_slot(path_, mapped, size_);
}

InputFile::~InputFile() {
  if (data_ != nullptr) ::munmap(const_cast<char*>(data_), size_);
  if (slot_ >= 0) {
    slots[slot_].begin = slots[slot_].end = 0;
    slots[slot_].taken = false;
  }
  ::close(descriptor_);
}

void InputFile::release_before(std::size_t offset) const {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t whole = offset / page * page;
  if (whole > 0) ::madvise(const_cast<char*>(data_), whole, MADV_DONTNEED);
}

void InputFile::check_unchanged() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0 && static_cast<std::size_t>(status.st_size) == size_)
    return;
  throw input_error(fmt::format(
      "{}: the file changed while it was read; read it again when it is complete", path_));
}

const char* mapped_path_of(const void* address) noexcept {
  const auto where = reinterpret_cast<std::uintptr_t>(address);
  for (const Slot& slot : slots)
    if (slot.begin <= where && where < slot.end) return slot.path.data();
  return nullptr;
}

}  // namespace alea
