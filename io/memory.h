// The most memory that a single array can have. A request beyond it is refused with a message of
// its own, because the system may grant it and then end the program when it is used.
#ifndef HOWL_IO_MEMORY_H_
#define HOWL_IO_MEMORY_H_

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace howl {

// The machine's memory, or less where the process is limited.
inline double MemoryBytes() {
  const double machine =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  rlimit limit{};
  const bool limited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return limited ? std::min(machine, static_cast<double>(limit.rlim_cur)) : machine;
}

}  // namespace howl

#endif  // HOWL_IO_MEMORY_H_
