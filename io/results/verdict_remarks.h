// Remarks in words that go with an unknown verdict, for the terminal and the page.
#ifndef HOWL_IO_RESULTS_VERDICT_REMARKS_H_
#define HOWL_IO_RESULTS_VERDICT_REMARKS_H_

#include <string>
#include <vector>

namespace howl {

// One for each that is not empty (diagnosis.h).
inline std::vector<std::string> RemarksOnUnknown(const std::string& repaired,
                                                 const std::string& together) {
  std::vector<std::string> out;
  if (!repaired.empty()) {
    out.push_back(repaired +
                  " is detected in the samples; unknown is what is left once it is repaired");
  }
  if (!together.empty()) {
    out.push_back(together + " together would come nearest: two causes, or one that is not listed");
  }
  return out;
}

}  // namespace howl

#endif  // HOWL_IO_RESULTS_VERDICT_REMARKS_H_
