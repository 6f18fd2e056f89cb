#pragma once
// A clock that stands still while others have the processor.

#include <time.h>

#include <chrono>

namespace tutte {

/// Processor time of this thread, as a clock of <chrono>: what else the machine does changes measurements little.
struct CpuClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<CpuClock>;
  static constexpr bool is_steady = true;

  static time_point now() noexcept {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return time_point(std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec));
  }

  static double secondsSince(time_point start) { return std::chrono::duration<double>(now() - start).count(); }
};

}  // namespace tutte
