// A record that is not on this machine: its file is not there, or the environment variable that
// names its folder is not set. A user's mistake like any other where the record is needed; stored
// figures can only not be compared.
#ifndef HOWL_IO_CONFIG_SECTIONS_ABSENT_RECORD_H_
#define HOWL_IO_CONFIG_SECTIONS_ABSENT_RECORD_H_

#include "io/user_error.h"

namespace howl {

class AbsentRecord : public UserError {
 public:
  explicit AbsentRecord(const UserError& error) : UserError(error) {}
};

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SECTIONS_ABSENT_RECORD_H_
