#include "model/simulation/simulate_modal.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "model/noise/random_stream.h"
#include "model/numerics/lagrange.h"
#include "model/numerics/units.h"
#include "model/simulation/decimate.h"

namespace howl {
namespace {

constexpr std::ptrdiff_t kAhead = ModalStep::kAhead;
constexpr std::ptrdiff_t kBehind = ModalStep::kBehind;

// Numbers of the streams that a seed splits into: a source changes no draw of another.
enum class ModalStream : std::uint64_t {
  kCombustion = 1,
  kPressureSensor = 2,
  kHeatReleaseSensor = 3,
  kDuct = 4,
  kBackground = 5
};

double At(const std::vector<double>& drive, std::size_t step) {
  return drive.empty() ? 0.0 : drive[step % drive.size()];
}

std::vector<double> NoiseOf(const PowerDensity& density, double rate_hz, std::size_t period,
                            std::uint64_t seed, ModalStream stream) {
  if (!density) return {};
  return PeriodicNoise(density, rate_hz, period,
                       DeriveSeed(seed, static_cast<std::uint64_t>(stream)));
}

void AddTo(std::vector<double>* signal, const std::vector<double>& noise, double times = 1.0) {
  if (noise.empty()) return;
  for (std::size_t i = 0; i < signal->size(); ++i) (*signal)[i] += times * noise[i];
}

}  // namespace

ModalPath RunModal(const ModalRig& rig, double step_s, std::size_t steps,
                   const ModalDrives& drives) {
  const ModalStep step(rig.modes, rig.drive, rig.leak_hz, step_s);
  const double delay = rig.tau_s / step_s;
  const auto whole = static_cast<std::ptrdiff_t>(std::ceil(delay));
  CHECK_GE(whole, kAhead + kAhead) << "a delay of " << rig.tau_s << " s in steps of " << step_s;
  const auto weights = LagrangeWeights<ModalStep::kOrder>(static_cast<double>(whole) - delay);
  // Rows of v, and of u = q + d; row `zero` is the first sample.
  const std::ptrdiff_t zero = whole + kBehind;
  std::vector<double> v(static_cast<std::size_t>(zero) + steps + kAhead + 1, 0.0);
  std::vector<double> u(v.size(), 0.0);
  std::vector<double> q(v.size(), 0.0);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(step.size());
  if (rig.past) {
    const std::complex<double> lambda(rig.past->growth_rate,
                                      kRadPerSPerHz * rig.past->frequency_hz);
    const std::complex<double> wave = std::polar(rig.past->amplitude, rig.past->phase_rad);
    const Eigen::VectorXcd answer = step.AnswerTo(lambda) * wave;
    for (std::ptrdiff_t i = 0; i <= zero; ++i) {
      const std::complex<double> turn = std::exp(lambda * (step_s * static_cast<double>(i - zero)));
      const auto row = static_cast<std::size_t>(i);
      q[row] = u[row] = (wave * turn).real();
      x = (answer * turn).real();
      v[row] = step.Drive(x, u[row]);
    }
  }
  const auto fill = [&](std::ptrdiff_t i) {
    const double* const from = v.data() + zero + i - whole - kBehind;
    double delayed = 0.0;
    for (std::size_t j = 0; j < weights.size(); ++j) delayed += weights[j] * from[j];
    const auto row = static_cast<std::size_t>(zero + i);
    q[row] = rig.flame(delayed) + At(drives.combustion, static_cast<std::size_t>(i));
    u[row] = q[row] + At(drives.duct, static_cast<std::size_t>(i));
  };
  for (std::ptrdiff_t i = 1; i < kAhead; ++i) fill(i);
  ModalPath path;
  path.pressure.reserve(steps);
  path.heat_release.reserve(steps);
  for (std::size_t m = 0; m < steps; ++m) {
    const std::size_t row = static_cast<std::size_t>(zero) + m;
    path.pressure.push_back(step.Pressure(x));
    path.heat_release.push_back(q[row]);
    v[row] = step.Drive(x, u[row]);
    fill(static_cast<std::ptrdiff_t>(m) + kAhead);
    step.Advance(u.data() + row - kBehind, &x);
  }
  return path;
}

double ModalInternalRate(const ModalRig& rig, double sampling_hz) {
  const auto [lowest, highest] =
      std::ranges::minmax(rig.modes, {}, [](const ResidueMode& mode) { return mode.omega_hz; });
  const double least = std::max(
      {80.0 * lowest.omega_hz, 20.0 * highest.omega_hz, 12.0 / rig.tau_s, 4.0 * sampling_hz});
  return sampling_hz * std::ceil(least / sampling_hz - 1e-9);
}

SimulatedRecord SimulateModal(const ModalRig& rig, const SimulationOptions& options,
                              std::uint64_t seed) {
  SimulatedRecord record;
  record.sampling_hz = options.sampling_hz;
  record.internal_hz =
      options.internal_hz > 0.0 ? options.internal_hz : ModalInternalRate(rig, options.sampling_hz);
  const auto ratio = static_cast<int>(std::lround(record.internal_hz / record.sampling_hz));
  Decimator pressure(ratio);
  Decimator heat_release(ratio);
  const auto samples =
      static_cast<std::size_t>(std::llround(options.duration_s * options.sampling_hz));
  const auto settle = static_cast<std::size_t>(std::llround(options.settle_s * record.internal_hz));
  const std::size_t steps = settle + samples * static_cast<std::size_t>(ratio) +
                            2 * static_cast<std::size_t>(pressure.half_length()) + 1;
  const std::size_t period = FastPeriod(steps + static_cast<std::size_t>(kAhead));
  const ModalPath path =
      RunModal(rig, 1.0 / record.internal_hz, steps,
               {NoiseOf(rig.combustion, record.internal_hz, period, seed, ModalStream::kCombustion),
                NoiseOf(rig.duct, record.internal_hz, period, seed, ModalStream::kDuct)});
  pressure.Push(std::span(path.pressure).subspan(settle), &record.pressure);
  heat_release.Push(std::span(path.heat_release).subspan(settle), &record.heat_release);
  record.pressure.resize(samples);
  record.heat_release.resize(samples);
  // A quarter longer than the record, so that no record is a period.
  const std::size_t of_record = FastPeriod(samples + samples / 4 + 2);
  AddTo(&record.pressure, NoiseOf(rig.pressure_sensor, record.sampling_hz, of_record, seed,
                                  ModalStream::kPressureSensor));
  AddTo(&record.heat_release, NoiseOf(rig.heat_release_sensor, record.sampling_hz, of_record, seed,
                                      ModalStream::kHeatReleaseSensor));
  const std::vector<double> background =
      NoiseOf(rig.background, record.sampling_hz, of_record, seed, ModalStream::kBackground);
  AddTo(&record.pressure, background, rig.background_ratio);
  AddTo(&record.heat_release, background);
  return record;
}

}  // namespace howl
