// The answer is negative before there is anything to write: one line on standard error, status 1.
#ifndef HOWL_APP_COMMAND_LINE_NEGATIVE_ANSWER_H_
#define HOWL_APP_COMMAND_LINE_NEGATIVE_ANSWER_H_

#include <stdexcept>

namespace howl {

class NegativeAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace howl

#endif  // HOWL_APP_COMMAND_LINE_NEGATIVE_ANSWER_H_
