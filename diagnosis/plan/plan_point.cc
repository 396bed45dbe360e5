#include "diagnosis/plan/plan_point.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/noise/cut_noise.h"
#include "diagnosis/numerics/real_gram.h"
#include "diagnosis/numerics/scaled_solve.h"

namespace howl {
namespace {

constexpr int kRefits = 4;
constexpr double kRefitted = 0.05;  // nats that another step would still take off
constexpr double kRidge = 1e-10;
// The longest steps, as a fit has them (fitter_step.cc, fitter_delay.cc).
constexpr double kMostLogOmega = 0.1;
constexpr double kMostLogXi = 0.6;
constexpr double kMostLogDelay = 0.1;

Eigen::VectorXd Root(const Eigen::VectorXd& weight) {
  return (weight / kBinCorrelation).cwiseSqrt();
}

}  // namespace

PlanPoint::PlanPoint(const CutRecord& record, const EffectFit& fit, std::size_t e)
    : record_(record),
      at_(fit.experiments[e]),
      tau_s_(fit.DelayOf(e)),
      acoustic_weight_(Root(AcousticWeights(record, at_.acoustic_noise))),
      flame_bin_weight_(FlameWeights(record, at_.flame_noise)),
      acoustic_residual_(AcousticResidual(record, *BaseEffect(), {}, at_.acoustics)),
      columns_(MakeFlameColumns(record, *BaseEffect(), {}, tau_s_)) {
  flame_weight_ = Root(flame_bin_weight_);
  const FlameSolution solution =
      SolveFlame(record, *BaseEffect(), {}, tau_s_, columns_, flame_bin_weight_);
  flame_residual_ = solution.residual;
  const Eigen::MatrixXcd locals = AcousticJacobian(record, *BaseEffect(), {}, at_.acoustics,
                                                   acoustic_residual_, Eigen::VectorXd());
  std::vector<Eigen::VectorXd> columns;
  const Eigen::VectorXcd no_acoustic = Eigen::VectorXcd::Zero(record.acoustic_count);
  const Eigen::VectorXcd no_flame = Eigen::VectorXcd::Zero(record.flame_count);
  for (Eigen::Index j = 0; j < locals.cols(); ++j) {
    if (IsFree(record.model, j)) columns.push_back(Whitened(locals.col(j), no_flame));
  }
  for (Eigen::Index j = 0; j < solution.columns.cols(); ++j) {
    columns.push_back(Whitened(no_acoustic, solution.columns.col(j)));
  }
  Eigen::MatrixXd all(columns[0].size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const double length = columns[j].norm();
    all.col(static_cast<Eigen::Index>(j)) = columns[j] / (length > 0.0 ? length : 1.0);
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(all);
  nuisance_ = qr.householderQ() * Eigen::MatrixXd::Identity(all.rows(), qr.rank());
  const Eigen::MatrixXcd by_tau =
      FlameJacobian(record, *BaseEffect(), {}, tau_s_, columns_, solution, Eigen::VectorXd());
  delay_ = Whitened(no_acoustic, tau_s_ * by_tau.col(0));
  ProjectOut(&delay_);
}

Eigen::VectorXd PlanPoint::Whitened(const Eigen::VectorXcd& acoustic,
                                    const Eigen::VectorXcd& flame) const {
  const Eigen::Index a = acoustic.size();
  const Eigen::Index b = flame.size();
  Eigen::VectorXd out(2 * (a + b));
  out.segment(0, a) = acoustic.real().cwiseProduct(acoustic_weight_);
  out.segment(a, a) = acoustic.imag().cwiseProduct(acoustic_weight_);
  out.segment(2 * a, b) = flame.real().cwiseProduct(flame_weight_);
  out.segment(2 * a + b, b) = flame.imag().cwiseProduct(flame_weight_);
  return out;
}

void PlanPoint::ProjectOut(Eigen::VectorXd* change) const {
  *change -= nuisance_ * (nuisance_.transpose() * *change);
}

Eigen::VectorXcd PlanPoint::AcousticChange(const Effect& effect, EffectValues x) const {
  AcousticLocals locals = at_.acoustics;
  Eigen::VectorXcd change;
  for (int i = 0;; ++i) {
    const Eigen::VectorXcd residual = AcousticResidual(record_, effect, x, locals);
    change = residual - acoustic_residual_;
    if (i == kRefits || !change.allFinite()) break;
    const Eigen::MatrixXcd jacobian =
        AcousticJacobian(record_, effect, x, locals, residual, Eigen::VectorXd());
    const Eigen::VectorXd weight = acoustic_weight_.cwiseAbs2();
    const Eigen::MatrixXd gradient = RealGram(weight, jacobian, change);
    AcousticLocals step =
        -SolveScaled(RealGram(weight, jacobian, jacobian), gradient, kRidge).col(0);
    if (-step.dot(gradient.col(0)) < kRefitted) break;
    step[0] = std::clamp(step[0], -kMostLogOmega, kMostLogOmega);
    step[1] = std::clamp(step[1], -kMostLogXi, kMostLogXi);
    locals += step;
  }
  return change;
}

// Its delay is the one that the effect's own lag leaves: a lag is to first order a delay, and the
// second order of that delay is no effect.
Eigen::VectorXd PlanPoint::FlameChange(const Effect& effect, EffectValues x) const {
  const bool own_columns = effect.ChangesFlameInput() || effect.ModulatesDelay();
  const double information = delay_.squaredNorm();
  const Eigen::VectorXcd no_acoustic = Eigen::VectorXcd::Zero(record_.acoustic_count);
  FlameColumns columns;
  double moved = 0.0;  // of log tau
  Eigen::VectorXd change;
  for (int i = 0;; ++i) {
    const double tau_s = tau_s_ * std::exp(moved);
    if (own_columns && (i == 0 || effect.ModulatesDelay())) {
      columns = MakeFlameColumns(record_, effect, x, tau_s);
    }
    change = Whitened(no_acoustic, SolveFlame(record_, effect, x, tau_s,
                                              own_columns ? columns : columns_, flame_bin_weight_)
                                           .residual -
                                       flame_residual_);
    if (i == kRefits || !change.allFinite() || !(information > 0.0)) break;
    ProjectOut(&change);
    const double step = -change.dot(delay_) / information;
    if (step * step * information < kRefitted) break;
    moved += std::clamp(step, -kMostLogDelay, kMostLogDelay);
  }
  return change - moved * delay_;
}

Eigen::VectorXd PlanPoint::Change(const Effect& effect, EffectValues x) const {
  const Eigen::VectorXcd no_flame = Eigen::VectorXcd::Zero(record_.flame_count);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(delay_.size());
  if (effect.ChangesAcousticCut()) change += Whitened(AcousticChange(effect, x), no_flame);
  if (effect.ChangesFlameCut()) change += FlameChange(effect, x);
  if (!change.allFinite()) return Eigen::VectorXd::Zero(change.size());
  ProjectOut(&change);
  return change;
}

}  // namespace howl
