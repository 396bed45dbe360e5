// Parametric bootstrap of the loop with no effect: the gain that noise alone gives the best of the
// whole catalogue. Each replicate simulates every operating point from the refitted base
// (fitted_rig.h) and goes through the same search as the records did. Many of the catalogue's null
// values lie on a bound, so that chi-square tables do not apply; the replicates' gains do.
#ifndef HOWL_DIAGNOSIS_SEARCH_BOOTSTRAP_H_
#define HOWL_DIAGNOSIS_SEARCH_BOOTSTRAP_H_

#include <vector>

#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/search/diagnosis_options.h"

namespace howl {

// The largest gain of each of options.bootstrap replicates, ascending; empty if the run was
// stopped.
std::vector<double> BootstrapGains(const std::vector<CutRecord>& records, const EffectFit& base,
                                   const std::vector<DiagnosisExperiment>& experiments,
                                   const DiagnosisOptions& options);

// A limit that noise alone does not reach for one candidate with all its forms: the mean of its
// gain over a few replicates plus six standard deviations. It is meant for a candidate whose gain
// is near what noise gave in trials.
double GainOfNoise(const std::vector<CutRecord>& records, const EffectFit& base,
                   const std::vector<DiagnosisExperiment>& experiments,
                   const std::vector<EffectPointer>& forms, const DiagnosisOptions& options);

// (1 + how many replicates reach the gain) / (1 + replicates)
double BootstrapPValue(const std::vector<double>& gains, double gain);

// The gain that one rig in twenty with no effect exceeds; with fewer than 19 replicates, their
// largest.
double BootstrapDetectionGain(const std::vector<double>& gains);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SEARCH_BOOTSTRAP_H_
