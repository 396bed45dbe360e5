// A record's cycle read with its other oscillations taken out (notch.h), and with what goes in step
// with a slow one set aside (slow_modulation.h): it is no less a cycle for them.
#ifndef HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_CYCLE_BESIDE_OTHERS_H_
#define HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_CYCLE_BESIDE_OTHERS_H_

#include <optional>
#include <vector>

#include "estimation/analysis/cycle/characteristics.h"
#include "estimation/analysis/oscillations/notch.h"
#include "estimation/analysis/spectra/record.h"

namespace howl {

struct CycleBesideOthers {
  Characteristics characteristics;
  std::vector<Notch> slow;  // the others far below the cycle, which no flame of the cycle makes
};

// Reads the cycle in the range of `options` with the other oscillations taken out. None where no
// peak of p stands out at any resolution, or the record has too few of its periods.
std::optional<CycleBesideOthers> ReadCycleBesideOthers(const Record& record,
                                                       const CrossSpectrum& spectrum,
                                                       const CharacteristicsOptions& options);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_CYCLE_BESIDE_OTHERS_H_
