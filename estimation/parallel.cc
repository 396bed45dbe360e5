#include "estimation/parallel.h"

#include <tbb/global_control.h>

#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "model/numerics/parallel_for.h"

namespace howl {
namespace {

UnitObserver& Observer() {
  static UnitObserver observer;
  return observer;
}

// A unit may run units of its own, for which no progress is shown.
thread_local bool is_inside = false;

}  // namespace

void AllowThreads(int threads) {
  using Control = tbb::global_control;
  static std::unique_ptr<Control> control;
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  if (threads > cores) {
    control = std::make_unique<Control>(Control::max_allowed_parallelism, threads);
  }
}

void ObserveUnits(UnitObserver observer) { Observer() = std::move(observer); }

void RunUnits(std::size_t count, int threads, const std::function<void(std::size_t)>& unit) {
  const bool is_shown = Observer() && !is_inside;
  std::mutex mutex;
  std::size_t done = 0;
  const auto run = [&](std::size_t i) {
    if (!is_shown) {
      unit(i);
      return;
    }
    const bool outer = std::exchange(is_inside, true);
    unit(i);
    is_inside = outer;
    const std::lock_guard lock(mutex);
    Observer()(++done, count);
  };
  if (threads == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) run(i);
    return;
  }
  ParallelFor(count, threads, run);
}

}  // namespace howl
