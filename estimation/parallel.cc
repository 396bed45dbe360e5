#include "estimation/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace howl {

void RunUnits(std::size_t count, int threads, const std::function<void(std::size_t)>& unit) {
  if (threads == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) unit(i);
    return;
  }
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, unit); });
}

}  // namespace howl
