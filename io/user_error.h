// A user's mistake: one line, `file:line: key: what is wrong, what was expected`, exit status 2.
#ifndef HOWL_IO_USER_ERROR_H_
#define HOWL_IO_USER_ERROR_H_

#include <stdexcept>
#include <string>

namespace howl {

class UserError : public std::runtime_error {
 public:
  // `line` counts from 1; 0 when the mistake has no line (a missing file), and is then left out,
  // as an empty key is. Control characters are escaped and over-long texts are cut.
  UserError(const std::string& file, int line, const std::string& key, const std::string& what);

  const std::string& file() const { return file_; }
  int line() const { return line_; }
  const std::string& key() const { return key_; }
  const std::string& mistake() const { return mistake_; }  // what is wrong, what was expected

 private:
  std::string file_;
  int line_ = 0;
  std::string key_;
  std::string mistake_;
};

}  // namespace howl

#endif  // HOWL_IO_USER_ERROR_H_
