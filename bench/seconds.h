// The time that studies take, in seconds from some moment on.
#ifndef HOWL_BENCH_SECONDS_H_
#define HOWL_BENCH_SECONDS_H_

#include <chrono>

namespace howl {

inline double Seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace howl

#endif  // HOWL_BENCH_SECONDS_H_
