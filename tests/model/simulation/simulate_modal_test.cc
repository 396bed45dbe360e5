// Loops of several modes with complex residues in time, against solutions in closed form.
#include "model/simulation/simulate_modal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "model/cycles/harmonic_balance.h"
#include "model/numerics/constants.h"
#include "tests/model/density.h"

namespace howl::simulate_modal_test {
namespace {

using C = std::complex<double>;
constexpr double kLeakHz = 0.2;

constexpr std::array kDrives = {ModalDrive::kPressureRate, ModalDrive::kPressure,
                                ModalDrive::kVelocity};

// What drives the flame, from p: written out here on its own, as R is below.
C Drive(ModalDrive drive, C s) {
  if (drive == ModalDrive::kPressureRate) return s;
  return drive == ModalDrive::kPressure ? C(1.0) : 1.0 / (s + kTwoPi * kLeakHz);
}

C Response(const std::vector<ResidueMode>& modes, C s) {
  C sum = 0.0;
  for (const ResidueMode& m : modes) {
    const double w = kTwoPi * m.omega_hz;
    sum += (m.N * s + m.B * w) / (s * s + 2.0 * m.xi * w * s + w * w);
  }
  return sum;
}

// A linear loop of slope k of which e^(lambda t) is a solution: 1 = k V(lambda) R(lambda)
// e^(-lambda tau) is two real equations, linear in N and B of the first mode.
struct ExactLoop {
  ModalRig rig;
  C pressure;  // p(t) = Re(pressure e^(lambda t))
  C lambda;
};

ExactLoop MakeExactLoop(ModalDrive drive, C lambda) {
  const double slope = -0.1 / std::abs(Drive(drive, lambda));
  ExactLoop out;
  out.lambda = lambda;
  ModalRig& rig = out.rig;
  rig.drive = drive;
  rig.leak_hz = kLeakHz;
  rig.tau_s = 0.00346123456789;
  rig.flame = [slope](double v) { return slope * v; };
  rig.modes = {{200.0, 0.06, 0.0, 0.0}, {455.0, 0.04, 800.0, -400.0}, {930.0, 0.05, -300.0, 200.0}};
  const double w = kTwoPi * rig.modes[0].omega_hz;
  const C rest = Response(rig.modes, lambda);
  const C wanted = 1.0 / (slope * Drive(drive, lambda) * std::exp(-lambda * rig.tau_s)) - rest;
  const C numerator = wanted * (lambda * lambda + 2.0 * rig.modes[0].xi * w * lambda + w * w);
  rig.modes[0].N = numerator.imag() / lambda.imag();
  rig.modes[0].B = (numerator.real() - rig.modes[0].N * lambda.real()) / w;
  out.pressure = Response(rig.modes, lambda);
  rig.past = {1.0, lambda.imag() / kTwoPi, lambda.real(), 0.0};
  return out;
}

double LargestError(const ExactLoop& loop, double rate_hz) {
  const auto steps = static_cast<std::size_t>(0.1 * rate_hz);
  const ModalPath path = RunModal(loop.rig, 1.0 / rate_hz, steps, {});
  double error = 0.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < steps; ++i) {
    const C turn = std::exp(loop.lambda * (static_cast<double>(i) / rate_hz));
    error = std::max(error, std::abs(path.pressure[i] - (loop.pressure * turn).real()));
    scale = std::max(scale, std::abs((loop.pressure * turn).real()));
    EXPECT_NEAR(path.heat_release[i], turn.real(), 1e-2 * std::abs(turn));
  }
  return error / scale;
}

TEST(SimulateModal, IsOfOrderSixAgainstTheExactSolution) {
  for (const ModalDrive drive : kDrives) {
    for (const C lambda : {C(22.0, kTwoPi * 208.0), C(-20.0, kTwoPi * 203.5)}) {
      const ExactLoop loop = MakeExactLoop(drive, lambda);
      const double coarse = LargestError(loop, 10000.0);
      const double fine = LargestError(loop, 40000.0);
      const double order = std::log2(coarse / fine) / 2.0;
      RecordProperty("order_" + std::to_string(static_cast<int>(drive)), std::to_string(order));
      std::printf("drive %d: largest errors %.1e and %.1e, order %.2f\n", static_cast<int>(drive),
                  coarse, fine, order);
      EXPECT_GT(order, 5.5);
      EXPECT_LT(fine, 1e-7);
    }
  }
}

C Bin(const std::vector<double>& x, std::size_t from, std::size_t period, std::size_t k) {
  C sum = 0.0;
  for (std::size_t i = 0; i < period; ++i) {
    const double angle =
        -kTwoPi * static_cast<double>(k * i % period) / static_cast<double>(period);
    sum += x[from + i] * std::polar(1.0, angle);
  }
  return sum / static_cast<double>(period);
}

// Below onset the loop is linear, and noise n in q and d in the duct give
//   p = R (n + d) / (1 - R F),   q = (n + F R d) / (1 - R F),   F = k V e^(-s tau)
// at each frequency of the noise exactly, once the start has decayed.
TEST(SimulateModal, NoiseGivesTheClosedLoopsSpectra) {
  constexpr double kRate = 40000.0;
  constexpr std::size_t kPeriod = 4000;
  for (const ModalDrive drive : kDrives) {
    const double slope = -0.1 / std::abs(Drive(drive, C(0.0, kTwoPi * 200.0)));
    ModalRig rig;
    rig.drive = drive;
    rig.leak_hz = kLeakHz;
    rig.tau_s = 0.0033;
    rig.flame = [slope](double v) { return slope * v; };
    rig.modes = {{200.0, 0.06, 300.0, 60.0}, {455.0, 0.04, 40.0, -20.0}};
    ModalDrives drives;
    const auto density = [](double f_hz) { return f_hz < 1500.0 ? 1.0 / (1.0 + f_hz) : 0.0; };
    drives.combustion = PeriodicNoise(density, kRate, kPeriod, 5);
    drives.duct = PeriodicNoise(density, kRate, kPeriod, 6);
    constexpr std::size_t kDecayed = 40 * kPeriod;
    const ModalPath path = RunModal(rig, 1.0 / kRate, kDecayed + kPeriod, drives);
    for (const std::size_t k : {3, 8, 15, 20, 21, 33, 45, 46, 80, 120}) {
      const C s(0.0, kTwoPi * static_cast<double>(k) * kRate / kPeriod);
      const C r = Response(rig.modes, s);
      const C f = slope * Drive(drive, s) * std::exp(-s * rig.tau_s);
      const C n = Bin(drives.combustion, 0, kPeriod, k);
      const C d = Bin(drives.duct, 0, kPeriod, k);
      const C p = r * (n + d) / (1.0 - r * f);
      const C q = (n + f * r * d) / (1.0 - r * f);
      EXPECT_LT(std::abs(Bin(path.pressure, kDecayed, kPeriod, k) - p), 1e-5 * std::abs(p)) << k;
      EXPECT_LT(std::abs(Bin(path.heat_release, kDecayed, kPeriod, k) - q), 1e-5 * std::abs(q))
          << k;
    }
  }
}

// Of the paper's loop harmonic balance has the cycle.
TEST(SimulateModal, CyclesAreThoseOfHarmonicBalance) {
  const double slope = -0.7e-4;
  const ClosedLoop model{{{215.0, 0.12, 4000.0, 0.0, 3.0}, 0.0034},
                         {FlameShape::kTanh, slope, 1.0, 0.0}};
  const std::vector<LimitCycle> cycles = LimitCycles(model, 430.0);
  ASSERT_FALSE(cycles.empty());
  const LimitCycle& cycle = cycles.front();
  ModalRig rig;
  rig.tau_s = 0.0034;
  rig.modes = {{215.0, 0.12, 4000.0, 0.0}};
  rig.flame = [slope](double v) { return std::tanh(slope * v); };
  rig.past = {0.5, 200.0, 0.0, 0.0};
  constexpr double kRate = 40000.0;
  const ModalPath path = RunModal(rig, 1.0 / kRate, 80000, {});
  // Over whole periods at the end, the time of each passage upwards through zero by a straight
  // line.
  std::vector<double> passages;
  double largest = 0.0;
  for (std::size_t i = 60000; i + 1 < path.pressure.size(); ++i) {
    largest = std::max(largest, std::abs(path.pressure[i]));
    if (path.pressure[i] > 0.0 || path.pressure[i + 1] <= 0.0) continue;
    const double part = path.pressure[i] / (path.pressure[i] - path.pressure[i + 1]);
    passages.push_back((static_cast<double>(i) + part) / kRate);
  }
  const double frequency_hz =
      static_cast<double>(passages.size() - 1) / (passages.back() - passages.front());
  EXPECT_NEAR(frequency_hz, cycle.frequency_hz, 1e-4 * cycle.frequency_hz);
  // Harmonics move the peak a little.
  EXPECT_NEAR(largest, cycle.pressure_amplitude(), 0.02 * cycle.pressure_amplitude());
}

TEST(PeriodicNoise, HasItsDensityAtEachFrequency) {
  constexpr std::size_t kSamples = 240;
  constexpr double kRate = 1200.0;
  constexpr int kDraws = 2000;
  const auto density = [](double f_hz) { return 1.0 + f_hz / 100.0; };
  for (const std::size_t k : {1, 17, 100}) {
    double power = 0.0;
    for (int draw = 0; draw < kDraws; ++draw) {
      const std::vector<double> x =
          PeriodicNoise(density, kRate, kSamples, static_cast<std::uint64_t>(draw));
      power += std::norm(Bin(x, 0, kSamples, k)) / kDraws;
    }
    // Twice the power of a complex line, a bin being f_s / M wide. Exponential: 5 deviations.
    const double bin_hz = kRate / kSamples;
    const double expected = density(static_cast<double>(k) * bin_hz);
    EXPECT_NEAR(2.0 * power / bin_hz, expected, 5.0 / std::sqrt(kDraws) * expected) << k;
  }
}

TEST(PeriodicNoise, IsTheSameNoiseAtAHigherRate) {
  const auto density = [](double f_hz) { return f_hz < 200.0 ? 1.0 : 0.0; };
  const std::vector<double> coarse = PeriodicNoise(density, 1000.0, 500, 9);
  const std::vector<double> fine = PeriodicNoise(density, 3000.0, 1500, 9);
  for (std::size_t i = 0; i < coarse.size(); ++i) EXPECT_NEAR(coarse[i], fine[3 * i], 1e-9);
  EXPECT_EQ(FastPeriod(7), 8u);
  EXPECT_EQ(FastPeriod(1001), 1024u);
}

TEST(SimulateModal, RecordedChannelsHaveTheirNoise) {
  ModalRig rig;
  rig.modes = {{200.0, 0.1, 300.0, 0.0}};
  rig.tau_s = 0.003;
  rig.flame = [](double) { return 0.0; };
  rig.pressure_sensor = [](double f_hz) { return 4.0 + 0.01 * f_hz; };
  rig.heat_release_sensor = [](double) { return 2.0; };
  rig.background = [](double f_hz) { return 3.0 / (1.0 + f_hz / 50.0); };
  rig.background_ratio = 1.5;
  const SimulationOptions options{.duration_s = 200.0, .sampling_hz = 2000.0};
  const SimulatedRecord record = SimulateModal(rig, options, 3);
  ASSERT_EQ(record.pressure.size(), 400000u);
  for (const double f_hz : {40.0, 200.0, 700.0}) {
    const double background = 3.0 / (1.0 + f_hz / 50.0);
    const double of_p = 4.0 + 0.01 * f_hz + 2.25 * background;
    const double of_q = 2.0 + background;
    // 400 segments: 5 deviations are 25 %.
    EXPECT_NEAR(Density(record.pressure, 2000.0, f_hz), of_p, 0.25 * of_p) << f_hz;
    EXPECT_NEAR(Density(record.heat_release, 2000.0, f_hz), of_q, 0.25 * of_q) << f_hz;
  }
  // Another source changes no draw.
  ModalRig without = rig;
  without.heat_release_sensor = nullptr;
  EXPECT_EQ(SimulateModal(without, options, 3).pressure, record.pressure);
}

}  // namespace
}  // namespace howl::simulate_modal_test
