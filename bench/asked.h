// What a study is asked for, by a list in its environment.
#ifndef HOWL_BENCH_ASKED_H_
#define HOWL_BENCH_ASKED_H_

#include <cstdlib>
#include <string>

namespace howl {

// Whether `name` is in the comma-separated list of the variable; all are where it is not set.
inline bool Asked(const char* variable, const std::string& name) {
  const char* const only = std::getenv(variable);
  return only == nullptr ||
         ("," + std::string(only) + ",").find("," + name + ",") != std::string::npos;
}

}  // namespace howl

#endif  // HOWL_BENCH_ASKED_H_
