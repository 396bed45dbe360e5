// libFuzzer's entry to the target that HOWL_FUZZ_TARGET names.
#include <gflags/gflags_declare.h>
#include <glog/logging.h>
#include <pthread.h>
#include <sanitizer/common_interface_defs.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/target.h"

// libhdf5 keeps a few hundred bytes of some damaged files for good, which nobody else can free.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

// Where libmatio and libhdf5 read beyond a damaged file's parts, a child process finds that out
// (survival.h) and ends: that is no crash of the target, and must not be written down as one.
extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  pthread_atfork(nullptr, nullptr, [] { __sanitizer_set_death_callback(nullptr); });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const howl::FuzzTarget target = [] {
    const auto all = howl::AllTargets();
    const auto found = std::ranges::find(all, HOWL_FUZZ_TARGET, &howl::FuzzTarget::name);
    CHECK(found != all.end());
    return *found;
  }();
  target.run({reinterpret_cast<const char*>(data), size});
  return 0;
}
