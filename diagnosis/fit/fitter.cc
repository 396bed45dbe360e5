#include "diagnosis/fit/fitter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/noise/cut_noise.h"
#include "diagnosis/numerics/scaled_solve.h"

namespace howl {
namespace {

double Squares(const Eigen::VectorXcd& residual, const Eigen::VectorXd& weight) {
  return residual.cwiseAbs2().dot(weight) / kBinCorrelation;
}

}  // namespace

double ScaleOf(const EffectParameter& p, double x) {
  return p.scale == ParameterScale::kLogarithmic ? x : 1.0;
}

void Fitter::SetNoise(const EffectFit& fit) {
  weights_a_.clear();
  weights_b_.clear();
  for (std::size_t e = 0; e < records_.size(); ++e) {
    weights_a_.push_back(AcousticWeights(records_[e], fit.experiments[e].acoustic_noise));
    weights_b_.push_back(FlameWeights(records_[e], fit.experiments[e].flame_noise));
  }
}

double Fitter::Evaluate(EffectFit* fit) {
  double cost = 0.0;
  for (std::size_t e = 0; e < records_.size(); ++e) cost += EvaluateOne(fit, e);
  return cost;
}

double Fitter::AcousticSquares(EffectFit* fit, std::size_t e) const {
  ExperimentFit& at = fit->experiments[e];
  at.acoustic_residual = AcousticResidual(records_[e], effect_, fit->values, at.acoustics);
  return Squares(at.acoustic_residual, weights_a_[e]) + LeakJacobian(fit->values, at.acoustics, e);
}

double Fitter::EvaluateOne(EffectFit* fit, std::size_t e) {
  ExperimentFit& at = fit->experiments[e];
  double cost = 0.0;
  if (acoustic_) cost += AcousticSquares(fit, e);
  if (flame_) {
    if (own_columns_) {
      columns_[e] = MakeFlameColumns(records_[e], effect_, fit->values, fit->DelayOf(e));
    }
    solutions_.resize(records_.size());
    solutions_[e] =
        SolveFlame(records_[e], effect_, fit->values, fit->DelayOf(e), columns_[e], weights_b_[e]);
    at.flame = solutions_[e].coefficients;
    at.flame_range = columns_[e].range;
    at.flame_residual = solutions_[e].residual;
    cost += Squares(at.flame_residual, weights_b_[e]);
    cost += DelayPrice(at.log_delay, fit->delay_scatter);
  }
  return cost;
}

double Fitter::Descend(EffectFit* fit, int iterations) {
  double cost = Evaluate(fit);
  double damping = 1e-4;
  bool at_fit = true;  // what was evaluated last
  for (int i = 0; i < iterations; ++i) {
    const System system = Linearise(*fit);
    if (Decrement(system) < kDescentConverged) break;
    bool better = false;
    double gain = 0.0;
    for (int attempt = 0; attempt < 6 && !better; ++attempt) {
      EffectFit next = *fit;
      Step(system, damping, &next);
      const double moved = Evaluate(&next);
      if (moved < cost) {
        gain = cost - moved;
        *fit = std::move(next);
        cost = moved;
        damping = std::max(damping * 0.1, 1e-9);
        better = true;
      } else {
        damping *= 20.0;
      }
      at_fit = better;
    }
    if (!better || gain < kDescentConverged) break;
  }
  if (!at_fit) Evaluate(fit);
  return cost;
}

void Fitter::RefitNoise(EffectFit* fit) {
  fit->acoustic_cost = 0.0;
  fit->flame_cost = 0.0;
  for (std::size_t e = 0; e < records_.size(); ++e) {
    ExperimentFit& at = fit->experiments[e];
    if (acoustic_) {
      const Eigen::VectorXcd r = RecordedTransfer(records_[e], effect_, fit->values, at.acoustics);
      at.acoustic_noise =
          FitAcousticNoise(records_[e], at.acoustic_residual,
                           r.segment(kTapReach, records_[e].acoustic_count).cwiseAbs2());
    }
    if (flame_) at.flame_noise = FitFlameNoise(records_[e], at.flame_residual);
    fit->acoustic_cost += AcousticCost(records_[e], at.acoustic_residual, at.acoustic_noise);
    fit->acoustic_cost += LeakJacobian(fit->values, at.acoustics, e);
    fit->flame_cost += FlameCost(records_[e], at.flame_residual, at.flame_noise);
  }
  SetNoise(*fit);
  // One delay for all costs nothing, and the numbers that the price needs may not be known yet.
  // Without cut B the price stays as it was, with the delays.
  if (flame_) {
    const bool scatters = fit->delay_scatter > 0.0;
    const std::vector<OwnDelay> delays = scatters ? OwnDelays(*fit) : std::vector<OwnDelay>();
    fit->delay_cost = ScatterCost(delays, fit->delay_scatter);
    fit->freedom_cost = FreedomCost(delays, fit->delay_scatter);
  }
}

void Fitter::Finish(EffectFit* fit, const EffectFit* base) {
  Evaluate(fit);
  const System system = Linearise(*fit);
  const Eigen::Index d = 1 + static_cast<Eigen::Index>(fit->values.size());
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(d, d);
  for (std::size_t e = 0; e < records_.size(); ++e) {
    ExperimentFit& at = fit->experiments[e];
    at.gradient = system.experiments[e].reduced_gradient;
    at.curvature = system.experiments[e].reduced_curvature;
    if (!flame_ && base) {
      at.gradient[0] += base->experiments[e].gradient[0];
      at.curvature(0, 0) += base->experiments[e].curvature(0, 0);
    }
    total += at.curvature;
  }
  // The cost is a sum of |E|^2 / V, twice the log-likelihood less a constant: its curvature over
  // two is the information.
  const Eigen::MatrixXd covariance =
      0.5 * SolveScaled(total, Eigen::MatrixXd::Identity(d, d), 1e-9);
  fit->standard_errors.assign(static_cast<std::size_t>(d), 0.0);
  for (Eigen::Index i = 0; i < d; ++i) {
    const double in_u = std::sqrt(std::max(covariance(i, i), 0.0));
    const double to_x = i == 0 ? 1.0
                               : ScaleOf(effect_.parameters()[static_cast<std::size_t>(i - 1)],
                                         fit->values[static_cast<std::size_t>(i - 1)]);
    fit->standard_errors[static_cast<std::size_t>(i)] = in_u * to_x;
  }
}

}  // namespace howl
