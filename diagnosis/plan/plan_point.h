// One experiment of a plan: how much an effect changes the residuals of its two cuts, in units of
// their noise, after the base's own parameters have taken what they can of it.
//
//   change = W^(1/2) (E(effect) - E(base)) - what omega, xi, N, M and the flame's coefficients undo
//
// |change|^2 is then the log-likelihood (nats) that the effect gains over the base in a record that
// has it. The base's parameters are refitted, because an effect that is almost one of them (a lag
// is almost a delay) leaves no more than second orders; only what the delay moves by enters to
// first order, for the experiments share it (plan_gains.h).
#ifndef HOWL_DIAGNOSIS_PLAN_PLAN_POINT_H_
#define HOWL_DIAGNOSIS_PLAN_PLAN_POINT_H_

#include <Eigen/Core>

#include "diagnosis/fit/effect_fit.h"

namespace howl {

class PlanPoint {
 public:
  // fit: the base's, of which this is experiment e. Both must outlive the point.
  PlanPoint(const CutRecord& record, const EffectFit& fit, std::size_t e);

  // Real and imaginary parts of both cuts' bins; zero where the values are out of reach.
  Eigen::VectorXd Change(const Effect& effect, EffectValues x) const;
  // The same for a unit of log tau.
  const Eigen::VectorXd& delay() const { return delay_; }

 private:
  Eigen::VectorXcd AcousticChange(const Effect& effect, EffectValues x) const;
  Eigen::VectorXd FlameChange(const Effect& effect, EffectValues x) const;
  Eigen::VectorXd Whitened(const Eigen::VectorXcd& acoustic, const Eigen::VectorXcd& flame) const;
  void ProjectOut(Eigen::VectorXd* change) const;

  const CutRecord& record_;
  const ExperimentFit& at_;
  double tau_s_;
  Eigen::VectorXd acoustic_weight_;  // roots
  Eigen::VectorXd flame_weight_;
  Eigen::VectorXd flame_bin_weight_;  // as SolveFlame takes it
  Eigen::VectorXcd acoustic_residual_;
  Eigen::VectorXcd flame_residual_;
  FlameColumns columns_;
  Eigen::MatrixXd nuisance_;  // orthonormal columns
  Eigen::VectorXd delay_;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PLAN_PLAN_POINT_H_
