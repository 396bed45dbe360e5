// A remark in words that goes with an unknown verdict, for the terminal and the page.
#ifndef HOWL_IO_RESULTS_VERDICT_REMARKS_H_
#define HOWL_IO_RESULTS_VERDICT_REMARKS_H_

#include <string>

namespace howl {

// together: two effects (diagnosis_result.h).
inline std::string RemarkOnTogether(const std::string& together) {
  return together + " together would come nearest: two causes, or one that is not listed";
}

}  // namespace howl

#endif  // HOWL_IO_RESULTS_VERDICT_REMARKS_H_
