#include "diagnosis/plan/plan_point.h"

#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "diagnosis/cut_noise.h"

namespace howl {
namespace {

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

Eigen::VectorXd PlanPoint::Change(const Effect& effect, EffectValues x) const {
  Eigen::VectorXcd acoustic = Eigen::VectorXcd::Zero(record_.acoustic_count);
  Eigen::VectorXcd flame = Eigen::VectorXcd::Zero(record_.flame_count);
  if (effect.ChangesAcousticCut()) {
    acoustic = AcousticResidual(record_, effect, x, at_.acoustics) - acoustic_residual_;
  }
  if (effect.ChangesFlameCut()) {
    const bool own_columns = effect.ChangesFlameInput() || effect.ModulatesDelay();
    const FlameColumns columns =
        own_columns ? MakeFlameColumns(record_, effect, x, tau_s_) : FlameColumns();
    flame =
        SolveFlame(record_, effect, x, tau_s_, own_columns ? columns : columns_, flame_bin_weight_)
            .residual -
        flame_residual_;
  }
  Eigen::VectorXd change = Whitened(acoustic, flame);
  if (!change.allFinite()) return Eigen::VectorXd::Zero(change.size());
  ProjectOut(&change);
  return change;
}

}  // namespace howl
