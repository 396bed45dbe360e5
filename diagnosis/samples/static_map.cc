#include "diagnosis/samples/static_map.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/noise/cut_noise.h"
#include "diagnosis/numerics/real_fft.h"
#include "diagnosis/numerics/real_gram.h"
#include "diagnosis/numerics/scaled_solve.h"
#include "diagnosis/records/band_signal.h"
#include "diagnosis/records/channel_signal.h"
#include "diagnosis/samples/sample_limits.h"

namespace howl {
namespace {

constexpr double kTopQuantile = 0.995;
constexpr double kDepth = 0.06;  // of the plateau's threshold below the top, over the amplitude
constexpr Eigen::Index kBumps = kClippingShapes;
constexpr Eigen::Index kShapes = kBumps / 2;  // of a plateau
constexpr int kIterations = 5;
constexpr int kRounds = 3;

struct Bumps {
  Eigen::MatrixXcd spectrum;  // extended band x kBumps
  Eigen::VectorXd mean;       // of each column over the record, outwards
  double plateau = 0.0;
  Eigen::ArrayXd on;  // one on either plateau
};

Bumps MakeBumps(const CutRecord& record, Channel channel) {
  const Eigen::VectorXd& x = SignalOf(record, channel);
  Eigen::VectorXcd near =
      channel == Channel::kPressure ? record.pressure_spectrum : record.heat_release_spectrum;
  for (Eigen::Index k = 0; k < near.size(); ++k) {
    const double f = static_cast<double>(k) * record.bin_hz;
    if (std::abs(f - record.at.cycle_frequency_hz) > 0.4 * record.at.cycle_frequency_hz)
      near[k] = 0.0;
  }
  const Eigen::VectorXd cycle = InverseFft(near, record.samples);
  const double amplitude =
      0.5 * (SampleQuantile(x, kTopQuantile) - SampleQuantile(x, 1.0 - kTopQuantile));
  Bumps out;
  out.plateau = amplitude;
  out.spectrum.resize(record.extended(), kBumps);
  out.mean.resize(kBumps);
  out.on.setZero(record.samples);
  for (const int sign : {1, -1}) {
    const double threshold = SampleQuantile(sign * x, kTopQuantile) - kDepth * amplitude;
    const Eigen::ArrayXd on = (sign * x.array() > threshold).cast<double>();
    const double count = std::max(on.sum(), 1.0);
    const Eigen::ArrayXd x_1 = cycle.array() / amplitude;
    Eigen::ArrayXd shape = sign * amplitude * on;
    for (Eigen::Index j = sign > 0 ? 0 : kShapes; j < (sign > 0 ? kShapes : kBumps); ++j) {
      out.spectrum.col(j) = BandSpectrum(record, shape, record.acoustic_count);
      out.mean[j] = sign * shape.sum() / count;
      shape *= x_1;
    }
    out.on += on;
  }
  return out;
}

Eigen::ArrayXd FlameResidualInTime(const CutRecord& record, const EffectFit& base, std::size_t e) {
  const FlameColumns columns = MakeFlameColumns(record, *base.effect, {}, base.DelayOf(e));
  const Eigen::VectorXcd phi = FlameMultiplier(record, *base.effect, {}, base.DelayOf(e))
                                   .cwiseProduct(columns.spectrum * base.experiments[e].flame);
  const Eigen::VectorXcd q =
      record.heat_release_spectrum.segment(record.first - kTapReach, phi.size());
  Eigen::ArrayXd residual = InTime(record, q - phi).array();
  const auto ends = static_cast<Eigen::Index>(0.02 * static_cast<double>(record.samples));
  residual.head(ends) = 0.0;
  residual.tail(ends) = 0.0;
  return residual;
}

}  // namespace

ClippingFit FitClipping(const std::vector<CutRecord>& records, Channel channel,
                        const EffectFit& base) {
  const bool pressure = channel == Channel::kPressure;
  ClippingFit out;
  out.fit = base;
  double cost = 0.0;
  double expansion = 0.0;
  double plateau_noise = 0.0;
  const Effect& none = *base.effect;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const CutRecord& record = records[e];
    ExperimentFit& at = out.fit.experiments[e];
    const Bumps bumps = MakeBumps(record, channel);
    Eigen::VectorXd c = Eigen::VectorXd::Zero(kBumps);
    const auto columns = [&]() {
      Eigen::MatrixXcd windowed(record.acoustic_count, kBumps);
      const Eigen::VectorXcd r = RecordedTransfer(record, none, {}, at.acoustics);
      for (Eigen::Index j = 0; j < kBumps; ++j) {
        windowed.col(j) =
            pressure ? ApplyWindow(bumps.spectrum.col(j), record.acoustic_count)
                     : ApplyWindow(-r.cwiseProduct(bumps.spectrum.col(j)), record.acoustic_count);
      }
      return windowed;
    };
    for (int round = 0; round < kRounds; ++round) {
      const Eigen::VectorXd weight = AcousticWeights(record, at.acoustic_noise);
      for (int i = 0; i < kIterations; ++i) {
        const Eigen::VectorXcd bare = AcousticResidual(record, none, {}, at.acoustics);
        const Eigen::MatrixXcd extra = columns();
        const Eigen::VectorXcd residual = bare + extra * c;
        Eigen::MatrixXcd jacobian(record.acoustic_count, 4 + kBumps);
        jacobian.leftCols(4) =
            AcousticJacobian(record, none, {}, at.acoustics, bare, Eigen::VectorXd());
        jacobian.rightCols(kBumps) = extra;
        Eigen::VectorXd step = -SolveScaled(RealGram(weight, jacobian, jacobian),
                                            RealGram(weight, jacobian, residual), 1e-9);
        step[0] = std::clamp(step[0], -0.1, 0.1);
        step[1] = std::clamp(step[1], -0.5, 0.5);
        at.acoustics += step.head<4>();
        c += step.tail(kBumps);
      }
      at.acoustic_residual = AcousticResidual(record, none, {}, at.acoustics) + columns() * c;
      const Eigen::VectorXcd r = RecordedTransfer(record, none, {}, at.acoustics);
      at.acoustic_noise = FitAcousticNoise(record, at.acoustic_residual,
                                           r.segment(kTapReach, record.acoustic_count).cwiseAbs2());
    }
    if (!pressure) {
      const Eigen::ArrayXd noise = FlameResidualInTime(record, base, e);
      const double on = (noise.square() * bumps.on).sum() / std::max(bumps.on.sum(), 1.0);
      const double off =
          (noise.square() * (1.0 - bumps.on)).sum() / std::max((1.0 - bumps.on).sum(), 1.0);
      plateau_noise += on / off / static_cast<double>(records.size());
    }
    cost += AcousticCost(record, at.acoustic_residual, at.acoustic_noise);
    // The mean height of the bumps over the plateau.
    expansion += 0.5 * c.dot(bumps.mean) / bumps.plateau / static_cast<double>(records.size());
  }
  out.fit.acoustic_cost = cost;
  out.gain = expansion > 0.0 ? std::max(0.0, base.acoustic_cost - cost) : 0.0;
  // A bump's top is half as high again as its mean.
  out.fraction = 1.0 / (1.0 + 1.5 * std::max(expansion, 0.0));
  if (!pressure) out.plateau_noise = plateau_noise;
  out.sharp_edge = HasSharpEdge(records, channel);
  return out;
}

}  // namespace howl
