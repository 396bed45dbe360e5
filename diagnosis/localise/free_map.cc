#include "diagnosis/localise/free_map.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "diagnosis/noise/cut_noise.h"
#include "diagnosis/numerics/real_fft.h"
#include "diagnosis/numerics/real_gram.h"
#include "diagnosis/numerics/scaled_solve.h"
#include "diagnosis/records/band_signal.h"
#include "diagnosis/records/channel_signal.h"

namespace howl {
namespace {

constexpr int kRounds = 3;
constexpr int kIterations = 5;
constexpr int kHalvings = 5;
constexpr double kDamping = 1e-9;
constexpr double kLeastGain = 25.0;  // what six coefficients cost, and a little

// The spectra of A T_j(x / A) on the extended band.
Eigen::MatrixXcd MapSpectra(const CutRecord& record, const Eigen::VectorXd& signal,
                            double largest) {
  const Eigen::ArrayXd x = (signal.array() / largest).max(-1.0).min(1.0);
  Eigen::ArrayXd before = Eigen::ArrayXd::Ones(x.size());
  Eigen::ArrayXd now = x;
  Eigen::MatrixXcd out(record.extended(), kMapTerms);
  for (Eigen::Index j = 0; j < kMapTerms; ++j) {
    const Eigen::ArrayXd next = 2.0 * x * now - before;
    before = now;
    now = next;
    out.col(j) = largest * BandSpectrum(record, now, record.acoustic_count);
  }
  return out;
}

Eigen::VectorXd PredictedPressure(const CutRecord& record, const Eigen::VectorXcd& transfer) {
  return InTime(record, transfer.cwiseProduct(record.driving_heat_release));
}

Eigen::MatrixXcd Columns(const CutRecord& record, Channel channel, double largest,
                         const AcousticLocals& locals) {
  const bool pressure = channel == Channel::kPressure;
  Eigen::MatrixXcd out(record.acoustic_count, kMapTerms);
  const Eigen::VectorXcd r = RecordedTransfer(record, *BaseEffect(), {}, locals);
  // A predicted p may be larger than any that was recorded.
  const Eigen::MatrixXcd spectra =
      pressure ? MapSpectra(record, PredictedPressure(record, r), 1.5 * largest)
               : MapSpectra(record, record.heat_release, largest);
  for (Eigen::Index j = 0; j < kMapTerms; ++j) {
    out.col(j) = pressure ? ApplyWindow(-spectra.col(j), record.acoustic_count)
                          : ApplyWindow(-r.cwiseProduct(spectra.col(j)), record.acoustic_count);
  }
  return out;
}

// The fit of cut B with the duct's response to recorded q in the place of the mapped p.
class FlameAlone final : public NamedEffect {
 public:
  FlameAlone() : NamedEffect("slack_p_map", LoopBlock::kPressureInstrument, {}) {}
  bool ChangesFlameCut() const override { return true; }
};

void DriveFlame(const std::vector<CutRecord>& records, EffectFit* fit) {
  std::vector<CutRecord> driven = records;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const Eigen::VectorXcd r =
        RecordedTransfer(records[e], *BaseEffect(), {}, fit->experiments[e].acoustics);
    driven[e].pressure = PredictedPressure(records[e], r);
    driven[e].pressure_spectrum = ForwardFft(driven[e].pressure);
  }
  const EffectFit flame = FitEffect(driven, std::make_shared<FlameAlone>(), *fit);
  fit->flame_cost = flame.flame_cost;
  fit->delay_cost = flame.delay_cost;
  for (std::size_t e = 0; e < records.size(); ++e) {
    fit->experiments[e].flame_residual = flame.experiments[e].flame_residual;
    fit->experiments[e].flame_noise = flame.experiments[e].flame_noise;
  }
}

}  // namespace

EffectFit FitFreeMap(const std::vector<CutRecord>& records, Channel channel,
                     const EffectFit& base) {
  EffectFit fit = base;
  const Effect& none = *base.effect;
  double largest = 0.0;
  for (const CutRecord& record : records) {
    largest = std::max(largest, SignalOf(record, channel).cwiseAbs().maxCoeff());
  }
  Eigen::VectorXd c = Eigen::VectorXd::Zero(kMapTerms);
  const auto residual = [&](std::size_t e, const Eigen::MatrixXcd& columns) {
    return (AcousticResidual(records[e], none, {}, fit.experiments[e].acoustics) + columns * c)
        .eval();
  };
  const auto squares = [&](std::size_t e, const Eigen::VectorXcd& error) {
    return error.cwiseAbs2().dot(AcousticWeights(records[e], fit.experiments[e].acoustic_noise));
  };
  EffectFit best = base;  // refitted noise may undo what the squares gained
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < kIterations; ++i) {
      double now = 0.0;
      Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(kMapTerms, kMapTerms);
      Eigen::VectorXd right = Eigen::VectorXd::Zero(kMapTerms);
      std::vector<Eigen::MatrixXd> local(records.size());  // of the experiment's own four
      for (std::size_t e = 0; e < records.size(); ++e) {
        const ExperimentFit& at = fit.experiments[e];
        const Eigen::VectorXd weight = AcousticWeights(records[e], at.acoustic_noise);
        const Eigen::MatrixXcd columns = Columns(records[e], channel, largest, at.acoustics);
        const Eigen::VectorXcd error = residual(e, columns);
        now += squares(e, error);
        const Eigen::MatrixXcd jacobian =
            AcousticJacobian(records[e], none, {}, at.acoustics, error, Eigen::VectorXd());
        Eigen::MatrixXd both(4, 1 + kMapTerms);
        both << RealGram(weight, jacobian, error), RealGram(weight, jacobian, columns);
        local[e] = SolveScaled(RealGram(weight, jacobian, jacobian), both, kDamping);
        const Eigen::MatrixXd mixed = both.rightCols(kMapTerms);
        gram +=
            RealGram(weight, columns, columns) - mixed.transpose() * local[e].rightCols(kMapTerms);
        right += RealGram(weight, columns, error) - mixed.transpose() * local[e].col(0);
      }
      const Eigen::VectorXd step = -SolveScaled(gram, right, kDamping);
      const EffectFit was = fit;
      const Eigen::VectorXd c_was = c;
      // The step is halved until the squares fall, because far from the truth the locals overshoot.
      double share = 1.0;
      for (int half = 0; half < kHalvings; ++half, share *= 0.5) {
        c = c_was + share * step;
        double moved = 0.0;
        for (std::size_t e = 0; e < records.size(); ++e) {
          Eigen::Vector4d move = -local[e].col(0) - local[e].rightCols(kMapTerms) * step;
          move[0] = std::clamp(move[0], -0.1, 0.1);
          move[1] = std::clamp(move[1], -0.5, 0.5);
          AcousticLocals& locals = fit.experiments[e].acoustics;
          locals = was.experiments[e].acoustics + share * move;
          moved += squares(e, residual(e, Columns(records[e], channel, largest, locals)));
        }
        if (moved < now) break;
        if (half + 1 == kHalvings) {
          fit = was;
          c = c_was;
        }
      }
    }
    fit.acoustic_cost = 0.0;
    for (std::size_t e = 0; e < records.size(); ++e) {
      ExperimentFit& at = fit.experiments[e];
      at.acoustic_residual = residual(e, Columns(records[e], channel, largest, at.acoustics));
      const Eigen::VectorXcd r = RecordedTransfer(records[e], none, {}, at.acoustics);
      at.acoustic_noise =
          FitAcousticNoise(records[e], at.acoustic_residual,
                           r.segment(kTapReach, records[e].acoustic_count).cwiseAbs2());
      fit.acoustic_cost += AcousticCost(records[e], at.acoustic_residual, at.acoustic_noise);
    }
    if (fit.acoustic_cost < best.acoustic_cost) best = fit;
  }
  // A flame that is driven by predicted p is free of p's sensor noise too, which is no evidence of
  // a static map.
  if (channel == Channel::kPressure && best.acoustic_cost < base.acoustic_cost - kLeastGain) {
    DriveFlame(records, &best);
  }
  return best;
}

}  // namespace howl
