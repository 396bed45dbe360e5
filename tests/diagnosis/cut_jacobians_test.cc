// The Jacobians of the two cuts against central differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/cuts/acoustic_cut.h"
#include "diagnosis/cuts/flame_cut.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "model/effects/catalogue.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::cut_jacobians_test {
namespace {

// Away from the null, where effects do something.
std::vector<double> ValuesOf(const Effect& effect) {
  std::vector<double> out;
  for (const EffectParameter& p : effect.parameters()) out.push_back(p.starts.back());
  return out;
}

Eigen::VectorXd StepsAt(const std::vector<double>& x) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(x.size()));
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    out[i] = 1e-5 * std::max(std::abs(x[static_cast<std::size_t>(i)]), 1e-3);
  }
  return out;
}

TEST(AcousticCut, JacobianAgreesWithCentralDifferences) {
  const std::vector<CutRecord> records = MakeCutRecords({SimulateRig()[0]});
  const CutRecord& record = records[0];
  const AcousticLocals locals(std::log(200.0), std::log(0.2), 6000.0, 1500.0);
  for (const EffectPointer& effect : Catalogue()) {
    if (effect->kind() != EffectKind::kTransfer || !effect->ChangesAcousticCut()) continue;
    const std::vector<double> x = ValuesOf(*effect);
    const Eigen::VectorXd steps = StepsAt(x);
    const Eigen::VectorXcd residual = AcousticResidual(record, *effect, x, locals);
    const Eigen::MatrixXcd jacobian = AcousticJacobian(record, *effect, x, locals, residual, steps);
    for (Eigen::Index j = 0; j < steps.size(); ++j) {
      std::vector<double> up = x;
      std::vector<double> down = x;
      up[static_cast<std::size_t>(j)] += steps[j];
      down[static_cast<std::size_t>(j)] -= steps[j];
      const Eigen::VectorXcd numeric = (AcousticResidual(record, *effect, up, locals) -
                                        AcousticResidual(record, *effect, down, locals)) /
                                       (2.0 * steps[j]);
      EXPECT_LT((jacobian.col(4 + j) - numeric).norm(), 1e-3 * numeric.norm() + 1e-9)
          << effect->id() << " " << j;
    }
  }
}

// The columns of every transfer effect against central differences of the residual at fixed
// coefficients.
TEST(FlameCut, JacobianAgreesWithCentralDifferences) {
  const std::vector<CutRecord> records = MakeCutRecords({SimulateRig()[0]});
  const CutRecord& record = records[0];
  const double tau = 0.0035;
  const Eigen::VectorXd weight = Eigen::VectorXd::Ones(record.flame_count);
  std::size_t checked = 0;
  for (const EffectPointer& effect : Catalogue()) {
    if (effect->kind() != EffectKind::kTransfer || !effect->ChangesFlameCut()) continue;
    const std::vector<double> x = ValuesOf(*effect);
    const Eigen::VectorXd steps = StepsAt(x);
    const FlameColumns columns = MakeFlameColumns(record, *effect, x, tau);
    const FlameSolution at = SolveFlame(record, *effect, x, tau, columns, weight);
    const Eigen::MatrixXcd jacobian = FlameJacobian(record, *effect, x, tau, columns, at, steps);
    // The whole predicted signal, in time, with the coefficients held: another path than the
    // Jacobian's.
    const auto residual = [&](const std::vector<double>& values, double delay) {
      FlameColumns moved = columns;
      if (effect->ChangesFlameInput() || effect->ModulatesDelay()) {
        moved = MakeFlameColumns(record, *effect, values, delay);
        // Knots stay where they were.
        if (std::abs(moved.range / columns.range - 1.0) > 0.0) return Eigen::VectorXcd();
      }
      const Eigen::VectorXcd h = FlameMultiplier(record, *effect, values, delay);
      const Eigen::VectorXcd phi = moved.spectrum * at.coefficients;
      Eigen::VectorXcd out = record.windowed_heat_release.head(record.flame_count) -
                             ApplyWindow(h.cwiseProduct(phi), record.flame_count);
      const Response leak = effect->PressureLeak(record.at.cycle_frequency_hz, record.at, values);
      out -= leak * record.windowed_pressure.head(record.flame_count);
      return out;
    };
    const double by_tau = 1e-9;
    const Eigen::VectorXcd up = residual(x, tau + by_tau);
    const Eigen::VectorXcd down = residual(x, tau - by_tau);
    if (up.size() > 0 && down.size() > 0) {
      const Eigen::VectorXcd numeric = (up - down) / (2.0 * by_tau);
      EXPECT_LT((jacobian.col(0) - numeric).norm(), 1e-4 * numeric.norm()) << effect->id();
      ++checked;
    }
    for (Eigen::Index j = 0; j < steps.size(); ++j) {
      std::vector<double> more = x;
      std::vector<double> less = x;
      more[static_cast<std::size_t>(j)] += steps[j];
      less[static_cast<std::size_t>(j)] -= steps[j];
      const Eigen::VectorXcd right = residual(more, tau);
      const Eigen::VectorXcd left = residual(less, tau);
      if (right.size() == 0 || left.size() == 0) continue;
      const Eigen::VectorXcd numeric = (right - left) / (2.0 * steps[j]);
      EXPECT_LT((jacobian.col(1 + j) - numeric).norm(), 1e-3 * numeric.norm() + 1e-9)
          << effect->id() << " " << j;
      ++checked;
    }
  }
  EXPECT_GE(checked, 6U);
}

}  // namespace
}  // namespace howl::cut_jacobians_test
