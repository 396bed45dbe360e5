// Declared effects (model/effects/declared_effect.h) that are no transfer functions.
//
// A static map of a recorded signal, y = m(x; theta): the record is mapped back by the inverse and
// the base refitted to it. A map of p compresses cut A's residual too, so the likelihood contains
// the map's slope (change of variables):
//
//   cost(theta) = Whittle cost of cut A at m^-1(y) + 2 K / kBinCorrelation mean(log m'(x))   (p)
//
// K bins. A map of q changes the regressor alone and has no such term.
//
// A line: the coherent lines between its two frequencies, by their origin (coherent_lines.h).
#ifndef HOWL_DIAGNOSIS_CANDIDATES_DECLARED_FIT_H_
#define HOWL_DIAGNOSIS_CANDIDATES_DECLARED_FIT_H_

#include <vector>

#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/samples/coherent_lines.h"
#include "model/effects/declared_effect.h"

namespace howl {

struct DeclaredMapFit {
  std::vector<double> values;  // of the map's parameters
  double gain = 0.0;           // log-likelihood over the base
  EffectFit fit;               // of the base to the repaired records
  std::vector<ExperimentFit> held_out;
};

DeclaredMapFit FitDeclaredMap(const std::vector<DiagnosisExperiment>& experiments,
                              const std::vector<CutRecord>& records, const EffectFit& base,
                              const DeclaredEffect& effect);

struct DeclaredLineFit {
  double gain = 0.0;
  double frequency_hz = 0.0;  // of the strongest line there
  double relative_amplitude = 0.0;
  bool all_lines = false;  // no coherent line lies elsewhere
};

DeclaredLineFit FitDeclaredLine(const std::vector<CutRecord>& records, const EffectFit& base,
                                const std::vector<CoherentLine>& lines,
                                const DeclaredEffect& effect);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CANDIDATES_DECLARED_FIT_H_
