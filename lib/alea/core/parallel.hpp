#pragma once

#include <cstddef>
#include <functional>

namespace alea {

/// Calls body(begin, end) for consecutive chunks of [0, count) on all threads. The chunks depend on
/// `count` and `chunk` alone, so a body that writes only to its own chunk gives the same bits for
/// any thread count.
void parallel_chunks(std::size_t count, std::size_t chunk,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Runs both, side by side where threads are free.
void parallel_pair(const std::function<void()>& first, const std::function<void()>& second);

/// Limits the threads of everything that runs while the object lives; 0 means all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

}  // namespace alea
