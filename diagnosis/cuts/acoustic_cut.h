// Cut A: acoustics and instruments driven by measured q (the paper, (5a), and the places of
// model/effects/effect.h):
//
//   E_A = P - R Q,    R = K / (1 + leak K),    K = G PressureInstrument / HeatReleaseInstrument
//
// Where the acoustics move (acoustic_modulation.h), R is that of their mean, and what the movement
// adds to p is subtracted too.
//
// G may have modes beside the base's, each with its own damping and a complex residue:
//
//   sum over k of (a_k s + b_k omega_k) / (s^2 + 2 xi_k omega_k s + omega_k^2)
#ifndef HOWL_DIAGNOSIS_CUTS_ACOUSTIC_CUT_H_
#define HOWL_DIAGNOSIS_CUTS_ACOUSTIC_CUT_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/records/cut_record.h"

namespace howl {

// One experiment's own parameters in cut A: log omega (Hz), log xi, N, M. With one mode M is zero.
using AcousticLocals = Eigen::Vector4d;

// Whether the local of this number is free in the model.
inline bool IsFree(const BaseModel& model, Eigen::Index local) {
  return local < 3 || model.modes > 1;
}

Acoustics<double> ToAcoustics(const BaseModel& model, const AcousticLocals& locals);

struct FurtherMode {
  double omega_hz = 0.0;
  double xi = 0.0;
  double a = 0.0;  // both in the unit of N
  double b = 0.0;
};
Response FurtherResponse(const std::vector<FurtherMode>& modes, double frequency_hz);

// R on the extended band.
Eigen::VectorXcd RecordedTransfer(const CutRecord& record, const Effect& effect, EffectValues x,
                                  const AcousticLocals& locals,
                                  const std::vector<FurtherMode>& further = {});

// E_A on the band.
Eigen::VectorXcd AcousticResidual(const CutRecord& record, const Effect& effect, EffectValues x,
                                  const AcousticLocals& locals);

// Derivatives of E_A: four columns for the locals (zero where a local is not free), then one column
// for each entry of `steps`, by which the effect's parameters are moved.
Eigen::MatrixXcd AcousticJacobian(const CutRecord& record, const Effect& effect, EffectValues x,
                                  const AcousticLocals& locals, const Eigen::VectorXcd& residual,
                                  const Eigen::VectorXd& steps);

// Starts for a fit, the best first, from a grid over omega and xi with N and M by least squares: at
// most `count`, no two of them neighbours on the grid.
std::vector<AcousticLocals> AcousticStarts(const CutRecord& record, const Effect& effect,
                                           EffectValues x, std::size_t count);

// The same on the grid of loops whose second mode carries the cycle; empty with one mode or with a
// reference. Where the first mode carries the cycle these starts are no better, for they have a
// mode of no weight below the cycle.
std::vector<AcousticLocals> SecondModeStarts(const CutRecord& record, const Effect& effect,
                                             EffectValues x, std::size_t count);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CUTS_ACOUSTIC_CUT_H_
