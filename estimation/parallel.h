// Runs unit(0) ... unit(count - 1) on a number of threads. Units are independent and write to
// places of their own, so the result does not depend on the number.
#ifndef HOWL_ESTIMATION_PARALLEL_H_
#define HOWL_ESTIMATION_PARALLEL_H_

#include <cstddef>
#include <functional>

namespace howl {

// threads = 0: all cores.
void RunUnits(std::size_t count, int threads, const std::function<void(std::size_t)>& unit);

// To be called once, before any unit runs: without it no more threads are used than there are
// cores, whatever RunUnits is asked for.
void AllowThreads(int threads);

// Called after every unit of an outermost RunUnits, by one thread at a time: for a progress
// display. Set it before any unit runs; empty (the default) for none.
using UnitObserver = std::function<void(std::size_t done, std::size_t total)>;
void ObserveUnits(UnitObserver observer);

}  // namespace howl

#endif  // HOWL_ESTIMATION_PARALLEL_H_
