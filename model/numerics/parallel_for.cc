#include "model/numerics/parallel_for.h"

#include <algorithm>

#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace howl {

#ifdef __SANITIZE_THREAD__

// The thread sanitizer sees the order that threads of the system's own and atomics make, but not
// how libtbb, which is not built with it, hands work on: every unit would seem to race with its
// caller. So the units are run here by plain threads, and a race between two units, or of one with
// what comes before or after, is found as it is.
void ParallelFor(std::size_t count, int threads, const std::function<void(std::size_t)>& unit) {
  const auto cores = std::max(2U, std::thread::hardware_concurrency());
  const std::size_t asked = threads > 0 ? static_cast<std::size_t>(threads) : cores;
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        unit(i);
      } catch (...) {
        next = count;
        const std::lock_guard hold(mutex);
        if (!failure) failure = std::current_exception();
      }
    }
  };
  std::vector<std::thread> others;
  for (std::size_t k = 1; k < std::min(asked, count); ++k) others.emplace_back(run);
  run();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

void ParallelFor(std::size_t count, const std::function<void(std::size_t)>& unit) {
  ParallelFor(count, 0, unit);
}

#else

void ParallelFor(std::size_t count, const std::function<void(std::size_t)>& unit) {
  tbb::parallel_for(std::size_t{0}, count, unit);
}

void ParallelFor(std::size_t count, int threads, const std::function<void(std::size_t)>& unit) {
  // More than the cores that the process may use would have libtbb warn of it on standard error.
  const int most = tbb::info::default_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, most) : most);
  arena.execute([&] { ParallelFor(count, unit); });
}

#endif

}  // namespace howl
