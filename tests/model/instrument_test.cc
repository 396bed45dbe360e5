// Instruments, the anti-alias filter, noise and ramps against their stated responses.
#include "model/loop/instrument.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <vector>

#include "model/cycles/harmonic_balance.h"
#include "model/cycles/prediction.h"
#include "model/loop/crossings.h"
#include "model/numerics/constants.h"
#include "model/simulation/decimate.h"
#include "model/simulation/ramp.h"
#include "model/simulation/simulate.h"
#include "tests/model/density.h"
#include "tests/model/paper_loop.h"

namespace howl::instrument_test {
namespace {

using Complex64 = std::complex<double>;

// Response at f from the last whole periods of the answer to a cosine.
Complex64 MeasuredResponse(Instrument& instrument, double f, double rate_hz) {
  const auto n = static_cast<std::size_t>(rate_hz);  // 1 s; f in whole Hz
  std::vector<double> x(2 * n);
  std::vector<double> untouched(2 * n, 1.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = std::cos(kTwoPi * f * static_cast<double>(i) / rate_hz);
  }
  instrument.Start(rate_hz, 0);
  // In uneven blocks: the state carries over.
  for (std::size_t i = 0; i < x.size();) {
    const std::size_t count = std::min<std::size_t>(37 + i % 11, x.size() - i);
    instrument.Apply(0.0, std::span(x).subspan(i, count), std::span(untouched).subspan(i, count));
    i += count;
  }
  for (const double value : untouched) EXPECT_EQ(value, 1.0);
  Complex64 sum = 0.0;
  for (std::size_t i = n; i < 2 * n; ++i) {
    sum += x[i] * std::polar(2.0 / rate_hz, -kTwoPi * f * static_cast<double>(i) / rate_hz);
  }
  return sum;
}

TEST(Instrument, FiltersHaveTheirStatedResponses) {
  for (const double f : {50.0, 216.0, 746.0}) {
    const Complex64 s(0.0, f);
    FirstOrderLowPass first(Channel::kPressure, 220.0);
    EXPECT_LT(std::abs(MeasuredResponse(first, f, 40000.0) - 1.0 / (1.0 + s / 220.0)), 2e-3);
    FirstOrderHighPass high(Channel::kPressure, 40.0);
    EXPECT_LT(std::abs(MeasuredResponse(high, f, 40000.0) - s / (s + 40.0)), 2e-3);
    SecondOrderResponse second(Channel::kPressure, 800.0, 0.1);
    const Complex64 truth = 640000.0 / (s * s + 2.0 * 0.1 * 800.0 * s + 640000.0);
    EXPECT_LT(std::abs(MeasuredResponse(second, f, 40000.0) / truth - 1.0), 2e-3);
  }
}

TEST(Instrument, ClippingAndGain) {
  std::vector<double> p = {-3.0, -1.0, 0.5, 2.0};
  std::vector<double> q = {1.0, 2.0, 3.0, 4.0};
  ClippingInstrument(Channel::kPressure, 1.5).Apply(0.0, p, q);
  GainInstrument(Channel::kHeatRelease, 2.0).Apply(0.0, p, q);
  EXPECT_EQ(p, (std::vector<double>{-1.5, -1.0, 0.5, 1.5}));
  EXPECT_EQ(q, (std::vector<double>{2.0, 4.0, 6.0, 8.0}));
}

TEST(Decimator, PassAndStopBands) {
  for (const int ratio : {2, 4, 5, 16}) {
    const Decimator filter(ratio);
    const auto response = [&](double f) {  // f in units of the record's rate
      double sum = 0.0;
      for (int i = -filter.half_length(); i <= filter.half_length(); ++i) {
        sum += filter.taps()[i + filter.half_length()] * std::cos(kTwoPi * f * i / ratio);
      }
      return std::abs(sum);
    };
    for (double f = 0.0; f <= 0.4; f += 0.002) {
      EXPECT_NEAR(20.0 * std::log10(response(f)), 0.0, 1e-3) << ratio << " " << f;
    }
    for (double f = 0.6; f <= 0.5 * ratio; f += 0.002) {
      EXPECT_LT(20.0 * std::log10(response(f)), -80.0) << ratio << " " << f;
    }
  }
}

TEST(Decimator, TakesItsDelayOut) {
  Decimator filter(4);
  std::vector<double> input(4000);
  const auto signal = [](double i) { return std::cos(0.05 * i + 0.7); };
  for (std::size_t i = 0; i < input.size(); ++i) input[i] = signal(static_cast<double>(i));
  std::vector<double> output;
  for (std::size_t i = 0; i < input.size(); i += 250) {
    filter.Push(std::span(input).subspan(i, 250), &output);
  }
  EXPECT_EQ(output.size(),
            (4000u - 2u * static_cast<std::size_t>(filter.half_length()) - 1u) / 4u + 1u);
  for (std::size_t k = 0; k < output.size(); ++k) {
    EXPECT_NEAR(output[k], signal(static_cast<double>(k) * 4.0 + filter.half_length()), 2e-4);
  }
}

// With a flame that does nothing q is the noise alone, and p is G's answer to it.
TEST(Noise, HasItsStatedSpectrum) {
  SimulationCase one;
  one.rig.model = PaperLoop(0.415);
  one.rig.model.flame.slope = -1e-30;
  one.seed = 4;
  SimulationOptions options;
  options.duration_s = 60.0;
  options.settle_s = 0.1;
  options.sampling_hz = options.internal_hz = 20000.0;
  for (const double corner_hz : {400.0, HUGE_VAL}) {
    one.rig.noise.combustion_density = 1e-6;
    one.rig.noise.combustion_corner_hz = corner_hz;
    const SimulatedRecord record = Simulate(one, options);
    for (const double f : {100.0, 215.0, 400.0, 700.0, 1400.0}) {
      const double expected = 1e-6 / (1.0 + f * f / (corner_hz * corner_hz));
      // 1200 segments: 3 % standard error; aliases add up to 1 % at 1400 Hz.
      EXPECT_NEAR(Density(record.heat_release, 20000.0, f) / expected, 1.0, 0.13) << f;
      const Complex<double> g = AcousticResponse(one.rig.model.loop.acoustics, f);
      EXPECT_NEAR(Density(record.pressure, 20000.0, f) / (expected * SquaredMagnitude(g)), 1.0,
                  0.13)
          << f;
    }
  }
}

TEST(Noise, StableLoopColoursItAsPredicted) {
  SimulationCase one;
  one.rig.model = PaperLoop(0.415);
  one.rig.model.flame.slope *= 0.75;         // gain 0.88 at 216 Hz, 0.66 at 746 Hz
  one.rig.noise.combustion_density = 1e-12;  // far from saturation
  one.rig.noise.combustion_corner_hz = 2000.0;
  one.seed = 5;
  SimulationOptions options;
  options.duration_s = 200.0;
  options.settle_s = 0.5;
  options.sampling_hz = options.internal_hz = 20000.0;
  const SimulatedRecord record = Simulate(one, options);
  // Segments of 0.2 s: their 7 Hz resolve the resonance at 746 Hz, 40 Hz wide; 1000 of them: 3.2 %.
  for (const double f : {150.0, 320.0, 746.0, 900.0}) {
    // The process as it is sampled, with its aliases: 3 to 4 % more than S(f).
    const double decay = std::exp(-kTwoPi * 2000.0 / 20000.0);
    const double variance = 1e-12 * 2000.0 * std::numbers::pi / 2.0;
    const double source = variance * 2.0 / 20000.0 * (1.0 - decay * decay) /
                          (1.0 - 2.0 * decay * std::cos(kTwoPi * f / 20000.0) + decay * decay);
    const NoiseTransfer transfer = NoiseTransferAt(one.rig.model, f);
    EXPECT_NEAR(Density(record.heat_release, 20000.0, f, 4000) /
                    (source * std::norm(transfer.heat_release)),
                1.0, 0.13)
        << f;
    EXPECT_NEAR(
        Density(record.pressure, 20000.0, f, 4000) / (source * std::norm(transfer.pressure)), 1.0,
        0.13)
        << f;
  }
}

TEST(Noise, SensorsAreWhiteWithTheirStandardDeviation) {
  SimulationCase one;
  one.rig.model = PaperLoop(0.415);
  one.rig.noise.pressure_sensor_std = 0.3;
  one.rig.noise.heat_release_sensor_std = 0.02;
  one.seed = 8;
  SimulationOptions options;
  options.duration_s = 20.0;
  const SimulatedRecord record = Simulate(one, options);
  const auto n = static_cast<double>(record.pressure.size());
  double p2 = 0.0;
  double q2 = 0.0;
  double lag = 0.0;
  double cross = 0.0;
  for (std::size_t i = 1; i < record.pressure.size(); ++i) {
    p2 += record.pressure[i] * record.pressure[i];
    q2 += record.heat_release[i] * record.heat_release[i];
    lag += record.pressure[i] * record.pressure[i - 1];
    cross += record.pressure[i] * record.heat_release[i];
  }
  EXPECT_NEAR(std::sqrt(p2 / n), 0.3, 0.3 * 4.0 / std::sqrt(2.0 * n));
  EXPECT_NEAR(std::sqrt(q2 / n), 0.02, 0.02 * 4.0 / std::sqrt(2.0 * n));
  EXPECT_NEAR(lag / p2, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(cross / std::sqrt(p2 * q2), 0.0, 4.0 / std::sqrt(n));
}

TEST(Simulate, RecordAgreesWithTrueSignals) {
  SimulationCase one;
  one.rig.model = PaperLoop(0.415);
  one.rig.past = PastOnCycle(LimitCycles(one.rig.model, 300.0).at(0));
  SimulationOptions options;
  options.duration_s = 0.2;
  options.settle_s = 0.0137;
  options.keep_true_signals = true;
  const SimulatedRecord record = Simulate(one, options);
  ASSERT_EQ(record.pressure.size(), 1000u);
  ASSERT_EQ(record.true_pressure.size(), 4000u);
  for (std::size_t i = 0; i < record.pressure.size(); ++i) {
    // The cycle's harmonics beyond the pass band are below a thousandth.
    EXPECT_NEAR(record.pressure[i], record.true_pressure[4 * i], 5e-3);
  }
}

TEST(Ramp, EndsOnTheCycleOfItsLastParameters) {
  // The delay and the natural frequency move by a few per cent in a second; then the cycle must be
  // harmonic balance's of the new parameters.
  SimulationCase one;
  one.rig.model = PaperLoop(0.3);
  one.rig.past = PastOnCycle(LimitCycles(one.rig.model, 300.0).at(0));
  one.rig.effects = {
      std::make_shared<ParameterRamp>(RampedParameter::kTau, 1.0, 1.03, 0.1, 1.1),
      std::make_shared<ParameterRamp>(RampedParameter::kOmega, 1.0, 0.96, 0.1, 1.1),
      std::make_shared<ParameterRamp>(RampedParameter::kFlameSlope, 1.0, 1.1, 0.1, 1.1)};
  SimulationOptions options;
  options.duration_s = 2.0;
  options.sampling_hz = 20000.0;
  const SimulatedRecord record = Simulate(one, options);

  ClosedLoop last = one.rig.model;
  last.loop.tau_s *= 1.03;
  last.loop.acoustics.omega_hz *= 0.96;
  last.flame.slope *= 1.1;
  const LimitCycle before = LimitCycles(one.rig.model, 300.0).at(0);
  const LimitCycle after = LimitCycles(last, 300.0).at(0);
  // Frequency by upward zero crossings, amplitude by the largest sample.
  const auto measure = [&](std::size_t begin, std::size_t end, double* amplitude) {
    double first = 0.0;
    double latest = 0.0;
    int count = 0;
    *amplitude = 0.0;
    for (std::size_t i = begin; i + 1 < end; ++i) {
      *amplitude = std::max(*amplitude, record.pressure[i]);
      if (record.pressure[i] < 0.0 && record.pressure[i + 1] >= 0.0) {
        const double t = static_cast<double>(i) +
                         record.pressure[i] / (record.pressure[i] - record.pressure[i + 1]);
        if (count++ == 0) first = t;
        latest = t;
      }
    }
    return (count - 1) / (latest - first) * 20000.0;
  };
  const auto peak = [](const LimitCycle& cycle) {
    double largest = 0.0;
    for (int i = 0; i < 2000; ++i) {
      largest = std::max(largest, EvaluateHarmonics(cycle.pressure, kTwoPi * i / 2000.0));
    }
    return largest;
  };
  double amplitude = 0.0;
  EXPECT_NEAR(measure(0, 2000, &amplitude), before.frequency_hz, 1e-3 * before.frequency_hz);
  EXPECT_NEAR(amplitude, peak(before), 2e-3 * peak(before));
  EXPECT_NEAR(measure(30000, 40000, &amplitude), after.frequency_hz, 1e-4 * after.frequency_hz);
  EXPECT_NEAR(amplitude, peak(after), 2e-3 * peak(after));
  EXPECT_GT(std::abs(after.frequency_hz - before.frequency_hz), 5.0);
}

}  // namespace
}  // namespace howl::instrument_test
