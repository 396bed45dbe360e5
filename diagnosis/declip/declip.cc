#include "diagnosis/declip/declip.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "diagnosis/declip/unclipped_samples.h"
#include "diagnosis/noise/cut_noise.h"
#include "diagnosis/numerics/real_fft.h"
#include "diagnosis/numerics/real_gram.h"
#include "diagnosis/numerics/scaled_solve.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr std::size_t kStarts = 4;
constexpr int kMostFillings = 40;
constexpr double kConverged = 1e-6;  // change of the signal over the error, both squared

CutRecord WithPressure(CutRecord record, const Eigen::VectorXd& pressure) {
  record.pressure = pressure;
  record.pressure_spectrum = ForwardFft(pressure);
  record.windowed_pressure =
      ApplyWindow(record.pressure_spectrum.segment(record.first - kTapReach, record.extended()),
                  record.acoustic_count);
  return record;
}

// One Gauss-Newton step of the fit to the whole signal.
AcousticLocals Step(const CutRecord& record, const EffectFit& fit, const AcousticLocals& at) {
  const Effect& effect = *fit.effect;
  const Eigen::VectorXcd residual = AcousticResidual(record, effect, fit.values, at);
  const Eigen::VectorXcd r = RecordedTransfer(record, effect, fit.values, at);
  const Eigen::VectorXd noise =
      FitAcousticNoise(record, residual, r.segment(kTapReach, record.acoustic_count).cwiseAbs2());
  const Eigen::VectorXd weight = AcousticWeights(record, noise);
  const Eigen::MatrixXcd jacobian =
      AcousticJacobian(record, effect, fit.values, at, residual, Eigen::VectorXd());
  Eigen::VectorXd step = -SolveScaled(RealGram(weight, jacobian, jacobian),
                                      RealGram(weight, jacobian, residual), 1e-9);
  step[0] = std::clamp(step[0], -0.1, 0.1);
  step[1] = std::clamp(step[1], -0.5, 0.5);
  return at + step.head<4>();
}

// EM from the fit's own acoustics, which lie near.
Eigen::VectorXd Fill(const UnclippedSamples& unclipped, CutRecord filled, std::size_t e,
                     EffectFit* fit) {
  AcousticLocals& locals = fit->experiments[e].acoustics;
  for (int i = 0; i < kMostFillings; ++i) {
    const Eigen::ArrayXd error = unclipped.Error(filled, *fit->effect, fit->values, locals);
    const Eigen::VectorXd next = unclipped.Fill(error);
    const double change = (next - filled.pressure).squaredNorm();
    filled = WithPressure(std::move(filled), next);
    if (change <= kConverged * unclipped.WeightedSquares(error)) break;
    locals = Step(filled, *fit, locals);
  }
  return filled.pressure;
}

AcousticLocals FitAlone(const UnclippedSamples& unclipped, const CutRecord& filled,
                        const EffectFit& fit, std::size_t e) {
  std::vector<AcousticLocals> starts = {fit.experiments[e].acoustics};
  for (const AcousticLocals& other : AcousticStarts(filled, *fit.effect, fit.values, kStarts)) {
    starts.push_back(other);
  }
  AcousticLocals best = starts[0];
  double least = std::numeric_limits<double>::infinity();
  const std::vector<UnclippedSamples> one_unclipped = {unclipped};
  const std::vector<CutRecord> one_filled = {filled};
  for (const AcousticLocals& start : starts) {
    const PlateauFit one =
        FitUnclippedSamples(one_unclipped, one_filled, *fit.effect, {{}, {start}, 0.0}, 1);
    if (!(one.cost < least)) continue;
    least = one.cost;
    best = one.locals[0];
  }
  return best;
}

std::vector<UnclippedSamples> AllUnclippedSamples(const std::vector<CutRecord>& recorded) {
  return {recorded.begin(), recorded.end()};
}

Declipped FillAll(const std::vector<UnclippedSamples>& unclipped,
                  const std::vector<CutRecord>& filled, EffectFit fit, int threads) {
  Declipped out{std::vector<Eigen::VectorXd>(unclipped.size()), std::move(fit)};
  RunUnits(unclipped.size(), threads,
           [&](std::size_t e) { out.pressure[e] = Fill(unclipped[e], filled[e], e, &out.fit); });
  return out;
}

}  // namespace

Declipped DeclipAt(const std::vector<CutRecord>& recorded, const std::vector<CutRecord>& filled,
                   EffectFit fit, int threads) {
  return FillAll(AllUnclippedSamples(recorded), filled, std::move(fit), threads);
}

Declipped DeclipAnew(const std::vector<CutRecord>& recorded, const std::vector<CutRecord>& filled,
                     EffectFit fit, int threads) {
  const std::vector<UnclippedSamples> unclipped = AllUnclippedSamples(recorded);
  PlateauFit best{fit.values, std::vector<AcousticLocals>(recorded.size()), 0.0};
  RunUnits(recorded.size(), threads, [&](std::size_t e) {
    best.locals[e] = fit.values.empty() ? FitAlone(unclipped[e], filled[e], fit, e)
                                        : fit.experiments[e].acoustics;
  });
  if (!fit.values.empty()) {
    best = FitUnclippedSamples(unclipped, filled, *fit.effect, std::move(best), threads);
  }
  fit.values = best.values;
  for (std::size_t e = 0; e < recorded.size(); ++e) fit.experiments[e].acoustics = best.locals[e];
  return FillAll(unclipped, filled, std::move(fit), threads);
}

}  // namespace howl
