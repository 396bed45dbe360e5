// Numbers in the sentences of findings.
#ifndef HOWL_ESTIMATION_HEALTH_NUMBER_WORDS_H_
#define HOWL_ESTIMATION_HEALTH_NUMBER_WORDS_H_

#include <cstdio>
#include <string>

namespace howl {

// `digits` significant ones.
inline std::string NumberWord(double value, int digits = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_HEALTH_NUMBER_WORDS_H_
