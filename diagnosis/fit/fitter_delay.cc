// The experiments' own delays in a descent: eliminated in each step, their scatter refitted between
// the steps.
#include <algorithm>
#include <cmath>

#include "diagnosis/fit/bin_gram.h"
#include "diagnosis/fit/fitter.h"
#include "diagnosis/numerics/scaled_solve.h"

namespace howl {
namespace {

constexpr double kRidge = 1e-10;
constexpr double kLargestMove = 0.1;  // of log delay: as far as the phase of a cycle is linear
constexpr int kDelayIterations = 3;

}  // namespace

OwnDelay Fitter::OwnDelayOf(const EffectFit& fit, std::size_t e) const {
  const double tau_s = fit.DelayOf(e);
  const Eigen::MatrixXcd j = tau_s * FlameJacobian(records_[e], effect_, fit.values, tau_s,
                                                   columns_[e], solutions_[e], Eigen::VectorXd());
  const Eigen::MatrixXcd& c = solutions_[e].columns;
  const Eigen::MatrixXd mixed = BinGram(c, weights_b_[e], j);
  const double curvature =
      BinGram(j, weights_b_[e], j)(0, 0) -
      (mixed.transpose() * SolveScaled(BinGram(c, weights_b_[e], c), mixed, kRidge))(0, 0);
  const double gradient = BinGram(j, weights_b_[e], fit.experiments[e].flame_residual)(0, 0);
  const double own = fit.experiments[e].log_delay;
  if (!(curvature > 0.0)) return {own, own, 0.0};
  // The cost is c + 2 g x + h x^2.
  const double move = std::clamp(-gradient / curvature, -kLargestMove, kLargestMove);
  return {own, own + move, 2.0 * curvature};
}

std::vector<OwnDelay> Fitter::OwnDelays(const EffectFit& fit) const {
  std::vector<OwnDelay> delays;
  for (std::size_t e = 0; e < records_.size(); ++e) delays.push_back(OwnDelayOf(fit, e));
  return delays;
}

void Fitter::RefitScatter(EffectFit* fit) {
  if (!flame_ || records_.size() < 2 || !records_[0].model.own_delays) return;
  EffectFit next = *fit;
  double before = Evaluate(&next);
  const std::vector<OwnDelay> delays = OwnDelays(next);
  const DelayScatter scatter = FitScatter(delays);
  before += FreedomCost(delays, next.delay_scatter);
  next.delay_scatter = scatter.standard_deviation;
  next.tau_s *= std::exp(scatter.mean);
  for (std::size_t e = 0; e < records_.size(); ++e) {
    next.experiments[e].log_delay = ShrunkenDelay(delays[e], scatter);
  }
  const double after = Evaluate(&next) + FreedomCost(delays, next.delay_scatter);
  if (after < before) {
    *fit = std::move(next);
  } else {
    Evaluate(fit);
  }
}

void Fitter::EliminateDelay(const EffectFit& fit, std::size_t e, Eigen::MatrixXd* curvature,
                            Eigen::VectorXd* gradient, Reduced* out) const {
  const double s = fit.delay_scatter;
  if (s == 0.0) return;
  // The column of log delay is tau's column times tau; the price is added.
  out->delay_mixed = fit.tau_s * curvature->col(0);
  out->delay_curvature = fit.tau_s * out->delay_mixed[0] + 0.5 / (s * s);
  out->delay_gradient = fit.tau_s * (*gradient)[0] + 0.5 * fit.experiments[e].log_delay / (s * s);
  *curvature -= out->delay_mixed * out->delay_mixed.transpose() / out->delay_curvature;
  *gradient -= out->delay_mixed * (out->delay_gradient / out->delay_curvature);
}

// The step is not damped: where a law of the delays replaces their scatter, each delay has to
// follow it to within its record's error, which is many times less than the step.
void Fitter::StepDelay(const Reduced& part, const Eigen::VectorXd& shared,
                       ExperimentFit* at) const {
  if (part.delay_curvature == 0.0) return;
  const double move = -(part.delay_gradient + part.delay_mixed.dot(shared)) / part.delay_curvature;
  at->log_delay += std::clamp(move, -kLargestMove, kLargestMove);
}

void Fitter::DescendDelay(EffectFit* fit, std::size_t e) {
  if (!flame_ || fit->delay_scatter == 0.0) return;
  double cost = EvaluateOne(fit, e);
  for (int i = 0; i < kDelayIterations; ++i) {
    const ExperimentFit before = fit->experiments[e];
    fit->experiments[e].log_delay = ShrunkenDelay(OwnDelayOf(*fit, e), {0.0, fit->delay_scatter});
    const double moved = EvaluateOne(fit, e);
    if (!(moved < cost)) {
      fit->experiments[e] = before;
      break;
    }
    cost = moved;
  }
}

}  // namespace howl
