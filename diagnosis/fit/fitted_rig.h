// The loop that a fit with no effect describes, as a rig to simulate: one operating point.
//
//   q(t) = Phi(v(t - tau)) + n(t)      Phi by the fit's splines, constant beyond their range
//   p    = G q                         G by cut A
//   n      one-sided density 2 (V_B / (c N) - sigma_q^2) / f_s, not below zero
//   sigma_p^2, sigma_q^2 from V_A = c N (sigma_p^2 + |R|^2 sigma_q^2)
//
// c = 70 / 256 is the window's mean square (cut_record.h), N the record's samples and f_s its
// sampling rate. Below cut B's band n has the density of the lowest bin, above it that of the
// highest, falling as 1 / f^2.
#ifndef HOWL_DIAGNOSIS_FIT_FITTED_RIG_H_
#define HOWL_DIAGNOSIS_FIT_FITTED_RIG_H_

#include <cstdint>
#include <vector>

#include "diagnosis/fit/effect_fit.h"
#include "model/simulation/simulate.h"

namespace howl {

// The simulation's options: as long as the record, at its sampling rate.
SimulationOptions FittedRigOptions(const CutRecord& record);

// The power c N sigma_q^2 that the sensor of q adds to a bin of cut B.
double HeatReleaseSensorPower(const CutRecord& record, const ExperimentFit& fit);

// Records of all operating points, with the experiments' names and phi.
std::vector<DiagnosisExperiment> Replicate(const std::vector<CutRecord>& records,
                                           const EffectFit& base,
                                           const std::vector<DiagnosisExperiment>& experiments,
                                           std::uint64_t seed);

SimulationCase FittedRig(const CutRecord& record, const EffectFit& base, std::size_t experiment,
                         std::uint64_t seed);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_FIT_FITTED_RIG_H_
