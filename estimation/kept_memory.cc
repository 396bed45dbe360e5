#include "estimation/kept_memory.h"

#include <malloc.h>

namespace howl {

void KeepFreedMemory() {
#ifdef __GLIBC__
  // Bytes: the largest block that the allocator may keep, and the most that it keeps of them.
  constexpr int kLargestBlock = 1 << 25;
  constexpr int kMost = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kLargestBlock);
  mallopt(M_TRIM_THRESHOLD, kMost);
#endif
}

}  // namespace howl
