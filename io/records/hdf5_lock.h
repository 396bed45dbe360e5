// HDF5 is built without thread safety on most systems, and matio uses it too: one reader at a time.
#ifndef HOWL_IO_RECORDS_HDF5_LOCK_H_
#define HOWL_IO_RECORDS_HDF5_LOCK_H_

#include <mutex>

namespace howl {

inline std::mutex& Hdf5Mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace howl

#endif  // HOWL_IO_RECORDS_HDF5_LOCK_H_
