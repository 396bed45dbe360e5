// Independent units of work on several threads: what every part of howl runs in parallel, runs by
// these.
#ifndef HOWL_MODEL_NUMERICS_PARALLEL_FOR_H_
#define HOWL_MODEL_NUMERICS_PARALLEL_FOR_H_

#include <cstddef>
#include <functional>

namespace howl {

// Runs unit(0) to unit(count - 1), each once, in any order and on the caller's threads, and returns
// when all have ended. An exception of a unit is the caller's, and ends the units that have not
// begun.
void ParallelFor(std::size_t count, const std::function<void(std::size_t)>& unit);

// On `threads` threads; 0: as many as there are cores.
void ParallelFor(std::size_t count, int threads, const std::function<void(std::size_t)>& unit);

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_PARALLEL_FOR_H_
