// Words that the sentences of a report's summary share.
#ifndef HOWL_IO_REPORT_SUMMARY_WORDS_H_
#define HOWL_IO_REPORT_SUMMARY_WORDS_H_

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/report/script.h"

namespace howl {

inline constexpr int kSummaryDigits = 3;

// "180 to 220 Hz"; one number where both are spelled alike.
inline std::string FromTo(double lo, double hi, const std::string& unit = "") {
  const std::string from = Spelled(lo, kSummaryDigits);
  const std::string to = Spelled(hi, kSummaryDigits);
  return (from == to ? from : from + " to " + to) + (unit.empty() ? "" : " " + unit);
}

// The same over values; those that are not finite do not count.
inline std::string FromTo(std::vector<double> values, const std::string& unit = "") {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return "";
  return FromTo(std::ranges::min(values), std::ranges::max(values), unit);
}

// "a, b and c"; of a long list the first eight.
inline std::string Listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 8;
  const std::size_t shown = std::min(names.size(), kMost);
  std::string out;
  for (std::size_t k = 0; k < shown; ++k) {
    const bool last = k + 1 == shown && shown == names.size();
    out += (k == 0 ? "" : last ? " and " : ", ") + names[k];
  }
  if (shown < names.size()) out += " and " + std::to_string(names.size() - shown) + " more";
  return out;
}

// "1 experiment", "3 experiments"
inline std::string Counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace howl

#endif  // HOWL_IO_REPORT_SUMMARY_WORDS_H_
