#include "estimation/joint_records/fitted_rig.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "estimation/record_fit/spectra/flame_basis.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

using C = std::complex<double>;

constexpr double kFallAboveBand = 4.0;
constexpr double kLeastLeak = 1e-3;  // of the cycle's frequency
constexpr double kLeakOverRise = 2.0;
constexpr int kCyclePoints = 256;  // of an integral over the cycle

ModalDrive DriveOf(FlameInput input) {
  switch (input) {
    case FlameInput::kPressureRate:
      return ModalDrive::kPressureRate;
    case FlameInput::kPressure:
      return ModalDrive::kPressure;
    case FlameInput::kVelocity:
      return ModalDrive::kVelocity;
  }
  return ModalDrive::kPressureRate;
}

// v of the fit over v of the rig.
double InputUnit(FlameInput input, const RecordScale& scale) {
  const double turn = kRadPerSPerHz * scale.cycle_hz;
  switch (input) {
    case FlameInput::kPressureRate:
      return 1.0 / (turn * scale.pressure);
    case FlameInput::kPressure:
      return 1.0 / scale.pressure;
    case FlameInput::kVelocity:
      return turn / scale.pressure;
  }
  return 1.0;
}

// The flame without units, and what it makes of v = amplitude cos(theta).
class FittedFlame {
 public:
  FittedFlame(const RecordSpectra& record, const LoopPoint& point)
      : basis_(record.scale.input_range), coefficients_(record.scale.functions * point.flame) {}

  double At(double v) const { return basis_.At(v, coefficients_); }
  // Of e^(j k theta): k = 0 the mean, k = 1 the amplitude.
  double Harmonic(double amplitude, int k) const {
    double sum = 0.0;
    for (int i = 0; i < kCyclePoints; ++i) {
      const double theta = 2.0 * std::numbers::pi * i / kCyclePoints;
      sum += At(amplitude * std::cos(theta)) * std::cos(k * theta);
    }
    return sum * (k == 0 ? 1.0 : 2.0) / kCyclePoints;
  }

 private:
  FlameBasis basis_;
  Eigen::VectorXd coefficients_;
};

// One-sided, in the unit's square a Hz (fitted_loop.h).
PowerDensity DensityOf(const RecordSpectra& record, const Eigen::VectorXd& coefficients,
                       double unit, bool falls) {
  const double lowest_hz = record.scale.cycle_hz * std::abs(record.s[0]);
  const double highest_hz = record.scale.cycle_hz * std::abs(record.s[record.bins() - 1]);
  const double scale = unit * unit / record.sampling_hz;
  return [=](double f_hz) {
    const double inside = std::clamp(f_hz, lowest_hz, highest_hz);
    const double x = 2.0 * std::log(inside / lowest_hz) / std::log(highest_hz / lowest_hz) - 1.0;
    const double level =
        scale * LoopNoiseSpectrum(Eigen::VectorXd::Constant(1, x), coefficients)[0];
    return falls && f_hz > highest_hz ? level * std::pow(highest_hz / f_hz, kFallAboveBand) : level;
  };
}

void AddNoiseTo(ModalRig* rig, const RecordSpectra& record, const PointStructure& structure,
                const LoopPoint& point) {
  for (std::size_t j = 0; j < structure.noise.size(); ++j) {
    const auto density = [&](double unit, bool falls) {
      return DensityOf(record, point.noise[j], unit, falls);
    };
    const RecordScale& scale = record.scale;
    switch (structure.noise[j].source) {
      case LoopNoise::kCombustion:
        rig->combustion = density(scale.heat_release, true);
        break;
      case LoopNoise::kDuct:
        rig->duct = density(scale.heat_release, true);
        break;
      case LoopNoise::kPressureSensor:
        rig->pressure_sensor = density(scale.pressure, false);
        break;
      case LoopNoise::kHeatReleaseSensor:
        rig->heat_release_sensor = density(scale.heat_release, false);
        break;
      case LoopNoise::kBackground:
        rig->background = density(scale.heat_release, false);
        rig->background_ratio = point.background_ratio * scale.pressure / scale.heat_release;
        break;
      case LoopNoise::kPressureHum:
      case LoopNoise::kHeatReleaseHum:
      case LoopNoise::kTone:
      case LoopNoise::kFlameGain:
        LOG(FATAL) << "no loop that a config states has hum, tones or a gain that fluctuates";
    }
  }
}

// A mean m of v grows as m' = slope R(0) m where p's integral drives the flame.
double LeakOf(const RecordSpectra& record, const LoopPoint& point) {
  const double at_zero = AcousticTransfer(point, C(0.0)).real();
  const double rise = std::max(record.rest_slopes.dot(point.flame) * at_zero,
                               record.slopes.dot(point.flame) * at_zero);
  return record.scale.cycle_hz * std::max(kLeastLeak, kLeakOverRise * rise);
}

}  // namespace

ModalRig FittedRigOf(const RecordSpectra& record, const PointStructure& structure,
                     const LoopPoint& point, double cycle_amplitude) {
  const RecordScale& scale = record.scale;
  const double turn = kRadPerSPerHz * scale.cycle_hz;
  const double residue = turn * scale.pressure / scale.heat_release;
  ModalRig rig;
  for (const LoopMode& mode : point.modes) {
    rig.modes.push_back({mode.omega * scale.cycle_hz, mode.xi, residue * mode.a, residue * mode.b});
  }
  rig.drive = DriveOf(record.flame_input);
  if (rig.drive == ModalDrive::kVelocity) rig.leak_hz = LeakOf(record, point);
  rig.tau_s = point.path.tau / turn;
  const FittedFlame flame(record, point);
  const double amplitude = cycle_amplitude / scale.pressure *
                           std::abs(FlameInputResponse(record.flame_input, C(0.0, 1.0)));
  const double mean = flame.Harmonic(amplitude, 0);
  rig.flame = [flame, mean, unit = InputUnit(record.flame_input, scale),
               of_q = scale.heat_release](double v) { return of_q * (flame.At(unit * v) - mean); };
  if (cycle_amplitude > 0.0) {
    rig.past = {scale.heat_release * std::abs(flame.Harmonic(amplitude, 1)), scale.cycle_hz, 0.0,
                0.0};
  }
  AddNoiseTo(&rig, record, structure, point);
  return rig;
}

}  // namespace howl
