// HDF5 is built without thread safety on most systems, and matio uses it too: one reader at a time.
// It prints its own stack of errors unless told not to.
#ifndef HOWL_IO_RECORDS_BINARY_HDF5_LOCK_H_
#define HOWL_IO_RECORDS_BINARY_HDF5_LOCK_H_

#include <mutex>

namespace howl {

// Held while the library is used, and the library silent.
class Hdf5Lock {
 public:
  Hdf5Lock();

 private:
  std::lock_guard<std::mutex> lock_;
};

}  // namespace howl

#endif  // HOWL_IO_RECORDS_BINARY_HDF5_LOCK_H_
