// The oscillations of one record. A rig may have several at once: a slow one of 5 to 20 Hz, of the
// supply or of the flame's place, that rules q beside an acoustic one that rules p, or two acoustic
// ones. Each is characterised as if it were alone (characteristics.h), the others being taken out
// (notch.h), and its amplitude judged with what goes in step with a slow one set aside
// (slow_modulation.h).
//
// An oscillation is a significant line (lines.h) that carries at least kLeastOscillationShare of
// the mean square of p or of q, and that no multiple, sum or difference of stronger ones explains:
// |a| f_1 + |b| f_2 with small whole numbers, such as the sidebands f +- k f_slow of a modulation.
#ifndef HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_OSCILLATIONS_H_
#define HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_OSCILLATIONS_H_

#include <vector>

#include "estimation/analysis/cycle/characteristics.h"
#include "estimation/analysis/spectra/record.h"

namespace howl {

inline constexpr double kLeastOscillationShare = 0.05;  // 13 dB below all that the channel has

struct Oscillation {
  Characteristics characteristics;      // phase and gain from q to p, as the cycle's
  double p_share = 0.0, q_share = 0.0;  // of the channel's mean square; its harmonics not counted
  bool is_cycle = false;                // the one that the characteristics of the record are of
};

// All oscillations, the strongest in its channel first. `cycle`: the record's, or one without.
std::vector<Oscillation> ListOscillations(const Record& record, const CrossSpectrum& spectrum,
                                          const Characteristics& cycle,
                                          const CharacteristicsOptions& options);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_OSCILLATIONS_OSCILLATIONS_H_
