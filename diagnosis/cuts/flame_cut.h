// Cut B: delay and flame driven by measured p (the paper, section 3.2, and the places of
// model/effects/effect.h):
//
//   E_B = Q - leak P - HeatReleaseInstrument FlameOut e^(-tau s) Phi(v)
//   v   = FlameIn / PressureInstrument s P      in the time domain
//
// Phi has no memory and commutes with the delay, so its columns are computed once and the delay is
// a phase; an effect that changes the wave form before the flame needs them computed again. A delay
// that moves with the amplitude enters by v(t - tau - d), to second order in the slow part d(t -
// tau), which is that of the amplitude when the mixture left the nozzle.
#ifndef HOWL_DIAGNOSIS_CUTS_FLAME_CUT_H_
#define HOWL_DIAGNOSIS_CUTS_FLAME_CUT_H_

#include <Eigen/Core>

#include "diagnosis/records/cut_record.h"
#include "estimation/record_fit/spectra/flame_basis.h"

namespace howl {

struct FlameColumns {
  double range = 0.0;         // of v
  Eigen::VectorXd v;          // before the delay (after it where the delay moves)
  Eigen::MatrixXcd spectrum;  // extended band x kFlameTerms
};

FlameColumns MakeFlameColumns(const CutRecord& record, const Effect& effect, EffectValues x,
                              double tau_s);

// The factor that multiplies the columns, on the extended band.
Eigen::VectorXcd FlameMultiplier(const CutRecord& record, const Effect& effect, EffectValues x,
                                 double tau_s);

struct FlameSolution {
  Eigen::VectorXd coefficients;
  Eigen::VectorXcd residual;  // flame_count bins
  Eigen::MatrixXcd columns;   // windowed and multiplied: flame_count x kFlameTerms
};

// Least squares in the coefficients, weighted by 1 / variance (0 where masked).
FlameSolution SolveFlame(const CutRecord& record, const Effect& effect, EffectValues x,
                         double tau_s, const FlameColumns& columns, const Eigen::VectorXd& weight);

// Derivatives of E_B at fixed coefficients: tau, then one for each of `steps`.
Eigen::MatrixXcd FlameJacobian(const CutRecord& record, const Effect& effect, EffectValues x,
                               double tau_s, const FlameColumns& columns,
                               const FlameSolution& solution, const Eigen::VectorXd& steps);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_CUTS_FLAME_CUT_H_
