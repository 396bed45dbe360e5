#include "diagnosis/likelihood/joint_residuals.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "diagnosis/cuts/acoustic_modulation.h"
#include "estimation/record_fit/spectra/flame_basis.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

// The mean over the record of d Phi / d v, by which a small signal on top of the cycle is
// multiplied, is the sum of the coefficients times these. Every seventh sample is used: the mean
// needs no more.
Eigen::VectorXd MeanSlopes(const FlameColumns& flame) {
  const FlameBasis basis(flame.range);
  const double step = 1e-3 * flame.range;
  const Eigen::Index count = flame.v.size() / 7;
  Eigen::VectorXd v(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    v[i] = std::clamp(flame.v[7 * i], step - flame.range, flame.range - step);
  }
  const Eigen::MatrixXd rise = basis.Columns(v.array() + step) - basis.Columns(v.array() - step);
  return rise.colwise().mean().transpose() / (2.0 * step);
}

// The factor of the flame's mean slope in F. A delay that moves with the amplitude is in the
// columns and not in the multiplier; F has its mean.
Eigen::VectorXcd FlamePath(const JointBand& band, const Effect& effect, EffectValues x,
                           double tau_s, const Eigen::VectorXcd& multiplier) {
  const bool moves = effect.ModulatesDelay() && effect.DelayPerAmplitude(x) != 0.0;
  const double delay_s = moves ? tau_s * effect.DelayFactor(band.record.at, x) : 0.0;
  Eigen::VectorXcd path(band.count);
  const bool bends = effect.ChangesFlameInput();
  for (Eigen::Index i = 0; i < band.count; ++i) {
    const double hz = band.frequency_hz[i];
    std::complex<double> in = band.record.derivative_filter[band.record.first + i];
    if (bends) {
      in *= effect.FlameIn(hz, band.record.at, x) / effect.PressureInstrument(hz, x);
    }
    path[i] = multiplier[i + kTapReach] * in;
    if (moves) path[i] *= std::exp(-LaplaceVariable(hz) * delay_s);
  }
  return path;
}

AcousticPart MakeAcousticPart(const JointBand& band, const Effect& effect, EffectValues x,
                              const PointLoop& point) {
  const CutRecord& record = band.record;
  const Eigen::Index start = record.first - kTapReach;
  const Eigen::Index extended = band.count + 2 * kTapReach;
  const Eigen::VectorXcd r =
      RecordedTransfer(record, effect, x, point.acoustics, FurtherModesOf(record.model, point));
  Eigen::VectorXcd driven =
      r.head(extended).cwiseProduct(record.heat_release_spectrum.segment(start, extended));
  const Eigen::VectorXcd moved = PressureOfMovement(record, effect, x, point.acoustics);
  if (moved.size() > 0) driven += moved.head(extended);
  return {r.segment(kTapReach, band.count), band.pressure - SineTapered(driven, band.count)};
}

FlamePart MakeFlamePart(const JointBand& band, const Effect& effect, EffectValues x, double tau_s,
                        const FlameColumns& input) {
  FlamePart out;
  const Eigen::Index n = band.count;
  const Eigen::Index extended = n + 2 * kTapReach;
  const Eigen::VectorXcd multiplier = FlameMultiplier(band.record, effect, x, tau_s);
  out.leak = effect.PressureLeak(band.record.at.cycle_frequency_hz, band.record.at, x).real();
  out.target = band.heat_release - out.leak * band.pressure;
  out.columns.resize(n, kFlameTerms);
  Eigen::VectorXcd column(extended);
  for (Eigen::Index j = 0; j < kFlameTerms; ++j) {
    for (Eigen::Index i = 0; i < extended; ++i) {
      column[i] = Times(multiplier[i], input.spectrum(i, j));
    }
    out.columns.col(j) = SineTapered(column, n);
  }
  out.slopes = MeanSlopes(input);
  out.path = FlamePath(band, effect, x, tau_s, multiplier);
  return out;
}

}  // namespace

std::vector<FurtherMode> FurtherModesOf(const BaseModel& model, const PointLoop& point) {
  std::vector<FurtherMode> out;
  for (Eigen::Index k = 0; k < point.base_b.size(); ++k) {
    const double ratio = k == 0 ? 1.0 : model.harmonic_ratio;
    out.push_back({ratio * std::exp(point.acoustics[0]), std::exp(point.acoustics[1]), 0.0,
                   point.residue_scale * point.base_b[k]});
  }
  for (const Eigen::Vector4d& mode : point.modes) {
    out.push_back({std::exp(mode[0]), std::exp(mode[1]), point.residue_scale * mode[2],
                   point.residue_scale * mode[3]});
  }
  return out;
}

JointResiduals MakeJointResiduals(const JointBand& band, const Effect& effect,
                                  const SharedLoop& shared, const PointLoop& point) {
  return MoveJointResiduals(band, effect, shared, point, {}, {});
}

JointResiduals MoveJointResiduals(const JointBand& band, const Effect& effect,
                                  const SharedLoop& shared, const PointLoop& point,
                                  const Moves& moves, const JointResiduals& before) {
  JointResiduals out = before;
  const double tau_s = shared.tau_s * std::exp(point.log_delay);
  if (moves.acoustic) {
    out.acoustic =
        std::make_shared<const AcousticPart>(MakeAcousticPart(band, effect, shared.values, point));
  }
  if (moves.flame_input) {
    out.input = std::make_shared<const FlameColumns>(
        MakeFlameColumns(band.record, effect, shared.values, tau_s));
  }
  if (moves.flame) {
    out.flame = std::make_shared<const FlamePart>(
        MakeFlamePart(band, effect, shared.values, tau_s, *out.input));
  }
  return out;
}

}  // namespace howl
