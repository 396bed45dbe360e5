// Coherent lines that are no harmonics of the cycle, at the same frequency in all experiments, and
// where they come from. At a line the two cuts leave over
//
//   hum in recorded q   E_A = -R c,   E_B = c
//   hum in recorded p   E_A = c,      E_B = -F c      F: q from p through delay and flame
//   a source in the acoustics   E_A = c,   E_B = 0    the flame answers as always
//
// with c a free complex number for each experiment.
#ifndef HOWL_DIAGNOSIS_SAMPLES_COHERENT_LINES_H_
#define HOWL_DIAGNOSIS_SAMPLES_COHERENT_LINES_H_

#include <vector>

#include "diagnosis/fit/effect_fit.h"

namespace howl {

struct CoherentLine {
  double frequency_hz = 0.0;
  double strength = 0.0;  // mean over experiments of the peak's power over its surroundings'
};

struct LineOrigin {
  double heat_release_hum = 0.0;  // log-likelihood gains
  double pressure_hum = 0.0;
  double source = 0.0;
  double relative_amplitude = 0.0;  // of the strongest line over the cycle, in its channel
  double frequency_hz = 0.0;        // of the strongest line
  bool mains = false;               // all lines are multiples of 50 or of 60 Hz
  double mains_hz = 0.0;
};

std::vector<CoherentLine> FindCoherentLines(const std::vector<CutRecord>& records);

// The lines in the residual of cut A, where combustion noise, which is in p and in q, hides none.
std::vector<CoherentLine> FindLinesLeftOver(const std::vector<CutRecord>& records,
                                            const EffectFit& fit);

// Takes the lines' bins out of every fit.
void MaskLines(const std::vector<CoherentLine>& lines, std::vector<CutRecord>* records);

LineOrigin ExplainLines(const std::vector<CutRecord>& records, const EffectFit& base,
                        const std::vector<CoherentLine>& lines);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SAMPLES_COHERENT_LINES_H_
