// The joint fit of base and effect to both cuts of all experiments:
//
//   minimise  sum over experiments of  sum |E_A|^2 / V_A + sum |E_B|^2 / V_B
//
// over omega, xi, N, M and the flame's coefficients of each experiment, and over tau and the
// effect's parameters, which all experiments share; an experiment's delay may differ from the
// shared one at a price (delay_scatter.h). The method is Gauss-Newton with damping. An experiment's
// own parameters are eliminated (Schur complement), so that each experiment contributes a small
// gradient and curvature in the shared ones; leaving an experiment out then costs one small solve.
// The noise spectra V are refitted between rounds (noise_fit.h).
#ifndef HOWL_DIAGNOSIS_FIT_EFFECT_FIT_H_
#define HOWL_DIAGNOSIS_FIT_EFFECT_FIT_H_

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "diagnosis/cuts/acoustic_cut.h"
#include "diagnosis/cuts/flame_cut.h"
#include "model/effects/effect.h"

namespace howl {

struct ExperimentFit {
  AcousticLocals acoustics;
  Eigen::VectorXd flame;  // coefficients
  double flame_range = 0.0;
  double log_delay = 0.0;  // of its delay over tau
  Eigen::VectorXcd acoustic_residual;
  Eigen::VectorXcd flame_residual;
  Eigen::VectorXd acoustic_noise;  // V_A
  Eigen::VectorXd flame_noise;     // V_B
  Eigen::VectorXd gradient;        // in tau and the free parameters of the effect
  Eigen::MatrixXd curvature;
};

struct EffectFit {
  EffectPointer effect;
  std::vector<double> values;  // the effect's parameters
  double tau_s = 0.0;          // shared
  double delay_scatter = 0.0;  // standard deviation of the experiments' log_delay
  std::vector<ExperimentFit> experiments;
  double acoustic_cost = 0.0;  // Whittle, per independent bin
  double flame_cost = 0.0;
  double delay_cost = 0.0;              // of the delays that differ from tau: ScatterCost
  double freedom_cost = 0.0;            // the part of it that is FreedomCost
  std::vector<double> standard_errors;  // tau, then the parameters
  double cost() const { return acoustic_cost + flame_cost + delay_cost; }
  double DelayOf(std::size_t experiment) const {
    return tau_s * std::exp(experiments[experiment].log_delay);
  }
};

// The loop with no effect.
EffectPointer BaseEffect();

EffectFit FitBase(const std::vector<CutRecord>& records);

// The best fit from several starts, of which the first is the base's fit.
EffectFit FitEffect(const std::vector<CutRecord>& records, const EffectPointer& effect,
                    const EffectFit& base);

// How much the effect lowers the cost. A lower cost of the delays' freedom is not counted where the
// effect has that freedom itself (delay_scatter.h).
double GainOver(const EffectFit& base, const EffectFit& fit);

// The fit of a combination whose first effect was fitted already comes in two stages, so that many
// combinations can be compared before the best of them are fitted until they converge.
//
// PreliminaryFit takes a few steps from each start of the second effect's parameters, at the noise
// that the first effect's fit left over, and returns the best of the ends. ConvergedFit goes on
// from a preliminary fit.
EffectFit PreliminaryFit(const std::vector<CutRecord>& records, const EffectPointer& combined,
                         const EffectFit& base, const EffectFit& first);
EffectFit ConvergedFit(const std::vector<CutRecord>& records, const EffectFit& base,
                       const EffectFit& preliminary);

// The experiment's residuals with tau and the effect's parameters from the other experiments, as
// far as those determine them; the experiment's own parameters are refitted.
ExperimentFit HeldOut(const std::vector<CutRecord>& records, const EffectFit& fit,
                      std::size_t experiment);
std::vector<ExperimentFit> HoldOutEach(const std::vector<CutRecord>& records, const EffectFit& fit);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_FIT_EFFECT_FIT_H_
