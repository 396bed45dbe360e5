// Memory that units of work give back is kept for the next ones. The system's allocator returns
// large blocks to the kernel at once and takes them again, each page cleared: with two threads a
// fit of records spends a fifth of its time so.
#ifndef HOWL_ESTIMATION_KEPT_MEMORY_H_
#define HOWL_ESTIMATION_KEPT_MEMORY_H_

namespace howl {

// To be called once, by a program, before any unit runs (parallel.h).
void KeepFreedMemory();

}  // namespace howl

#endif  // HOWL_ESTIMATION_KEPT_MEMORY_H_
