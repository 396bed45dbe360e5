// The first or the second half of a record.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_HALF_OF_RECORD_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_HALF_OF_RECORD_H_

#include <cstddef>
#include <vector>

#include "estimation/analysis/spectra/record.h"

namespace howl {

inline Record HalfOf(Record record, bool second) {
  std::vector<std::vector<double>*> signals = {&record.pressure, &record.heat_release};
  for (std::vector<double>& draw : record.pressure_errors) signals.push_back(&draw);
  for (std::vector<double>* signal : signals) {
    const auto middle = signal->begin() + static_cast<std::ptrdiff_t>(signal->size() / 2);
    if (second) {
      signal->erase(signal->begin(), middle);
    } else {
      signal->erase(middle, signal->end());
    }
  }
  return record;
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_HALF_OF_RECORD_H_
