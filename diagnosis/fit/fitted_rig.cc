#include "diagnosis/fit/fitted_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "diagnosis/numerics/real_fft.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "estimation/unit_seed.h"
#include "model/loop/loop_effect.h"
#include "model/noise/random_stream.h"
#include "model/numerics/smooth_length.h"

namespace howl {
namespace {

constexpr double kSettle_s = 1.0;
constexpr double kStartOfCycle = 0.5;  // of the recorded amplitude of q
constexpr double kWindowSquare =
    kWindowTaps[0] * kWindowTaps[0] +
    2.0 * (kWindowTaps[1] * kWindowTaps[1] + kWindowTaps[2] * kWindowTaps[2]);

// Variances of a sample.
struct SensorVariances {
  double pressure = 0.0;
  double heat_release = 0.0;
};

// V_A is linear in both: least squares give them exactly.
SensorVariances SensorsOf(const CutRecord& record, const ExperimentFit& fit) {
  const Eigen::VectorXd gain_squared = RecordedTransfer(record, *BaseEffect(), {}, fit.acoustics)
                                           .segment(kTapReach, record.acoustic_count)
                                           .cwiseAbs2();
  const double n = static_cast<double>(record.acoustic_count);
  const Eigen::VectorXd dx = gain_squared.array() - gain_squared.mean();
  const double slope = std::max(0.0, dx.dot(fit.acoustic_noise) / std::max(dx.dot(dx), 1e-300));
  const double rest = std::max(0.0, (fit.acoustic_noise.sum() - slope * gain_squared.sum()) / n);
  const double scale = 1.0 / (kWindowSquare * static_cast<double>(record.samples));
  return {rest * scale, slope * scale};
}

class NoiseDensity {
 public:
  NoiseDensity(const CutRecord& record, const Eigen::VectorXd& flame_noise,
               double heat_release_variance)
      : low_hz_(record.frequency(0)),
        high_hz_(record.frequency(record.flame_count - 1)),
        bin_hz_(record.bin_hz) {
    const double scale = 1.0 / (kWindowSquare * static_cast<double>(record.samples));
    density_ = 2.0 / record.sampling_hz *
               (scale * flame_noise.array() - heat_release_variance).max(0.0).matrix();
  }

  // One-sided, (units of q)^2 / Hz.
  double At(double frequency_hz) const {
    const double inside = std::clamp(frequency_hz, low_hz_, high_hz_);
    const double beyond = std::min(1.0, high_hz_ / std::max(frequency_hz, high_hz_));
    const auto bin = static_cast<Eigen::Index>(std::lround((inside - low_hz_) / bin_hz_));
    return density_[std::min(bin, density_.size() - 1)] * beyond * beyond;
  }

 private:
  double low_hz_;
  double high_hz_;
  double bin_hz_;
  Eigen::VectorXd density_;
};

// Phi by splines in the place of the rig's own flame, and noise of any colour.
class FittedFlame final : public LoopEffect {
 public:
  FittedFlame(const ExperimentFit& fit, NoiseDensity density, double duration_s)
      : basis_(fit.flame_range),
        coefficients_(fit.flame),
        at_rest_(basis_.At(0.0, coefficients_)),
        density_(std::move(density)),
        duration_s_(duration_s) {}

  std::unique_ptr<LoopEffect> Clone() const override {
    return std::make_unique<FittedFlame>(*this);
  }

  void Start(const RigParameters& /*rig*/, double step_s, std::uint64_t seed) override {
    const Eigen::Index samples =
        SmoothLength(static_cast<Eigen::Index>(std::ceil(duration_s_ / step_s)));
    const double bin_hz = 1.0 / (step_s * static_cast<double>(samples));
    RandomStream random(seed);
    Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(samples / 2 + 1);
    for (Eigen::Index k = 1; k < samples / 2; ++k) {
      const double density = density_.At(static_cast<double>(k) * bin_hz);
      const double each = std::sqrt(0.25 * density * static_cast<double>(samples) / step_s);
      const double real = random.Normal();
      spectrum[k] = each * Response(real, random.Normal());
    }
    noise_ = InverseFft(spectrum, samples);
    next_ = 0;
  }

  void FlameIn(const LoopContext& /*at*/, std::span<double> v) override {
    std::copy(v.begin(), v.end(), v_.begin());
  }

  void FlameOut(const LoopContext& /*at*/, std::span<double> heat_release) override {
    for (std::size_t i = 0; i < heat_release.size(); ++i) {
      heat_release[i] = basis_.At(v_[i], coefficients_) - at_rest_;
    }
  }

  // The noise is periodic: beyond its length it begins anew.
  void Source(const LoopContext& /*at*/, std::span<double> heat_release) override {
    for (double& q : heat_release) {
      q += noise_[next_];
      next_ = next_ + 1 < noise_.size() ? next_ + 1 : 0;
    }
  }

 private:
  FlameBasis basis_;
  Eigen::VectorXd coefficients_;
  double at_rest_;
  NoiseDensity density_;
  double duration_s_;
  Eigen::VectorXd noise_;
  Eigen::Index next_ = 0;
  std::array<double, kLoopBlock> v_{};
};

}  // namespace

double HeatReleaseSensorPower(const CutRecord& record, const ExperimentFit& fit) {
  return SensorsOf(record, fit).heat_release * kWindowSquare * static_cast<double>(record.samples);
}

SimulationOptions FittedRigOptions(const CutRecord& record) {
  SimulationOptions options;
  options.sampling_hz = record.sampling_hz;
  options.duration_s = static_cast<double>(record.samples) / record.sampling_hz;
  options.settle_s = kSettle_s;
  options.threads = 1;
  return options;
}

SimulationCase FittedRig(const CutRecord& record, const EffectFit& base, std::size_t experiment,
                         std::uint64_t seed) {
  const ExperimentFit& fit = base.experiments[experiment];
  const SensorVariances sensors = SensorsOf(record, fit);
  SimulationCase out;
  out.seed = seed;
  RigParameters& rig = out.rig;
  // The flame's own output is replaced.
  rig.model = {{ToAcoustics(record.model, fit.acoustics), base.DelayOf(experiment)},
               {FlameShape::kLinear, -1e-12, 1.0, 0.0}};
  rig.noise.pressure_sensor_std = std::sqrt(sensors.pressure);
  rig.noise.heat_release_sensor_std = std::sqrt(sensors.heat_release);
  const double rms = record.heat_release.norm() / std::sqrt(static_cast<double>(record.samples));
  rig.past = {{kStartOfCycle * std::numbers::sqrt2 * rms, record.at.cycle_frequency_hz, 0.0, 0.0}};
  const SimulationOptions how = FittedRigOptions(record);
  rig.effects = {std::make_shared<FittedFlame>(
      fit, NoiseDensity(record, fit.flame_noise, sensors.heat_release),
      how.settle_s + how.duration_s)};
  return out;
}

std::vector<DiagnosisExperiment> Replicate(const std::vector<CutRecord>& records,
                                           const EffectFit& base,
                                           const std::vector<DiagnosisExperiment>& experiments,
                                           std::uint64_t seed) {
  std::vector<DiagnosisExperiment> out;
  for (std::size_t e = 0; e < records.size(); ++e) {
    out.push_back({experiments[e].name, experiments[e].phi,
                   ToRecord(Simulate(FittedRig(records[e], base, e, UnitSeed(seed, "point", e)),
                                     FittedRigOptions(records[e])))});
  }
  return out;
}

}  // namespace howl
