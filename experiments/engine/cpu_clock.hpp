#pragma once

#include <ctime>

namespace alea::experiments {

/// Seconds of CPU time of this thread: other processes on the machine do not lengthen it.
inline double cpu_s() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace alea::experiments
