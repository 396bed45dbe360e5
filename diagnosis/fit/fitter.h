// Damped Gauss-Newton over the records of a rig at fixed noise spectra: an experiment's own
// parameters are eliminated (Schur complement), tau and the effect's parameters are shared
// (effect_fit.h has the objective). fitter.cc has the descent, fitter_step.cc a step of it,
// fitter_delay.cc the experiments' own delays.
#ifndef HOWL_DIAGNOSIS_FIT_FITTER_H_
#define HOWL_DIAGNOSIS_FIT_FITTER_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/fit/delay_scatter.h"
#include "diagnosis/fit/effect_fit.h"

namespace howl {

inline constexpr double kDescentConverged = 1e-3;  // of the cost, in units of a log-likelihood

// d x / d u, where u is the parameter's search coordinate, log x or x.
double ScaleOf(const EffectParameter& parameter, double x);
// The step in x for a derivative by differences.
double DifferenceStep(const EffectParameter& parameter, double x);
// x after a step in u, which is limited to what a descent may go at once and to the bounds.
double SteppedValue(const EffectParameter& parameter, double x, double step);

class Fitter {
 public:
  Fitter(const std::vector<CutRecord>& records, const Effect& effect,
         const std::vector<FlameColumns>* base_columns)
      : records_(records),
        effect_(effect),
        acoustic_(effect.ChangesAcousticCut()),
        flame_(effect.ChangesFlameCut()),
        own_columns_(effect.ChangesFlameInput() || effect.ModulatesDelay() || !base_columns),
        columns_(records.size()) {
    if (!own_columns_) columns_ = *base_columns;
  }

  void SetNoise(const EffectFit& fit);

  // Computes the residuals at the fit's parameters; the flame's coefficients are solved for.
  double Evaluate(EffectFit* fit);
  double EvaluateOne(EffectFit* fit, std::size_t e);

  // Damped Gauss-Newton at fixed noise. Returns the squares' sum.
  double Descend(EffectFit* fit, int iterations);

  // For use between descents: estimates how far the experiments' own delays scatter, and puts the
  // shared delay in their middle. The weights must be those of noise, not ones.
  void RefitScatter(EffectFit* fit);
  void RefitNoise(EffectFit* fit);

  // The largest gain that a parameter alone could have, to first order, and its value there. Only
  // tau and the locals are free with it.
  struct Score {
    double gain = 0.0;
    double value = 0.0;
  };
  Score ScoreOf(EffectFit* fit, std::size_t parameter);

  // Fills in the reduced gradients and curvatures, and the standard errors that follow from them.
  void Finish(EffectFit* fit, const EffectFit* base);

  // Fits the experiment's own parameters at fixed shared ones.
  void DescendLocals(EffectFit* fit, std::size_t e);

  // Fits cut A's locals from further starts too and keeps the best. True if they are better than
  // before.
  bool RestartLocals(EffectFit* fit);

  const std::vector<FlameColumns>& columns() const { return columns_; }

 private:
  struct Reduced {
    Eigen::MatrixXd local_curvature;  // cut A's locals
    Eigen::VectorXd local_gradient;
    Eigen::MatrixXd mixed;  // locals x shared
    // Cut B's local, log_delay, with its price.
    double delay_curvature = 0.0;
    double delay_gradient = 0.0;
    Eigen::VectorXd delay_mixed;  // x shared
    Eigen::VectorXd reduced_gradient;
    Eigen::MatrixXd reduced_curvature;
  };

  struct System {
    std::vector<Reduced> experiments;
    // Their sums: the normal equations in tau and the effect's parameters.
    Eigen::VectorXd gradient;
    Eigen::MatrixXd curvature;
  };

  // With a leak, the residuals are (E_A, E_B) = M (P, Q) with |det M| = |1 - leak R| instead of
  // one, because recorded p is in both. The likelihood needs the term - log |det M|^2; without it
  // the leak is biased by the combustion noise that reaches p at once.
  double LeakJacobian(EffectValues x, const AcousticLocals& locals, std::size_t e) const;

  double AcousticSquares(EffectFit* fit, std::size_t e) const;
  // The own delay that cut B alone would give an experiment; for use after Evaluate.
  OwnDelay OwnDelayOf(const EffectFit& fit, std::size_t e) const;
  std::vector<OwnDelay> OwnDelays(const EffectFit& fit) const;
  // Eliminates the own delay from cut B's normal equations in tau and the effect's parameters.
  void EliminateDelay(const EffectFit& fit, std::size_t e, Eigen::MatrixXd* curvature,
                      Eigen::VectorXd* gradient, Reduced* out) const;
  // shared: the step of tau and the effect's parameters.
  void StepDelay(const Reduced& part, const Eigen::VectorXd& shared, ExperimentFit* at) const;
  void DescendDelay(EffectFit* fit, std::size_t e);
  double DescendAcoustics(EffectFit* fit, std::size_t e, int iterations) const;
  System Linearise(const EffectFit& fit) const;
  // The step in tau and the effect's parameters that solves the normal equations, nothing clamped.
  Eigen::VectorXd SharedStep(const System& system, double damping) const;
  // What a full step would take off the cost, were it a square: g' H^-1 g.
  double Decrement(const System& system) const;
  void Step(const System& system, double damping, EffectFit* fit) const;

  const std::vector<CutRecord>& records_;
  const Effect& effect_;
  bool acoustic_;
  bool flame_;
  bool own_columns_;
  std::vector<FlameColumns> columns_;
  std::vector<FlameSolution> solutions_;
  std::vector<Eigen::VectorXd> weights_a_;
  std::vector<Eigen::VectorXd> weights_b_;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_FIT_FITTER_H_
