// The libraries that read MATLAB and HDF5 files trust what they find there, and a damaged file
// makes them divide by zero, write where they must not, or never end. So a file is read by a child
// process first: what ends the child does not end the program.
#ifndef HOWL_IO_RECORDS_BINARY_SURVIVAL_H_
#define HOWL_IO_RECORDS_BINARY_SURVIVAL_H_

#include <functional>
#include <string>

namespace howl {

// Runs `read` in a child process. An exception that it throws is left to the caller's own reading.
// Throws UserError where a signal ends it, or it takes longer than any file of this size does. The
// child has this thread alone: `read` may wait for no other, and for no lock that is held.
void RequireSurvival(const std::string& file, const std::function<void()>& read);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_BINARY_SURVIVAL_H_
