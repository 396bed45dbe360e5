// The effects of the catalogue in time: at their nulls the record keeps every bit; away from them,
// closed forms. In a linear loop that stands still but for a tone at f, every place of the loop
// can be read from the signals' components P and Q at f:
//
//   P / G(j 2 pi f) - Q = the tone,    Q / P = k j 2 pi f e^(-j 2 pi f tau) times the effect
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstring>
#include <string>
#include <vector>

#include "model/cycles/harmonic_balance.h"
#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"
#include "tests/model/find_effect.h"

namespace howl::effects_simulation_test {
namespace {

constexpr double kTone_hz = 250.0;
constexpr double kTone = 0.03;  // units of q

EffectPointer Find(std::string_view id, std::size_t form = 0) {
  return FindIn(SimulationCatalogue(), id, form);
}

SimulationScale Scale() {
  SimulationScale scale;
  scale.at = {0.31, 207.0, 1.2, 0.08};
  scale.pressure_amplitude = 6.0;
  scale.heat_release_amplitude = 0.5;
  scale.mean_pressure_amplitude = 5.0;
  scale.duration_s = 1.0;
  return scale;
}

// In a limit cycle.
RigParameters CycleRig() {
  RigParameters rig;
  rig.model = {{{206.0, 0.17, 6400.0, 1700.0, 3.0}, 0.00352},
               {FlameShape::kTanh, -0.72e-4, 0.45, 0.0}};
  rig.past = {{0.3, 205.0, 0.0, 0.0}};
  return rig;
}

RigParameters NoisyRig() {
  RigParameters rig = CycleRig();
  rig.noise = {4e-7, 1200.0, 0.02, 0.002};
  return rig;
}

SimulatedRecord Simulated(const RigParameters& rig, double duration_s = 1.0,
                          double settle_s = 1.0) {
  SimulationOptions options;
  options.duration_s = duration_s;
  options.settle_s = settle_s;
  options.keep_true_signals = true;
  options.threads = 1;
  return Simulate({rig, 77}, options);
}

void Put(std::string_view id, const std::vector<double>& x, RigParameters* rig,
         std::size_t form = 0) {
  const EffectPointer effect = Find(id, form);
  ASSERT_NE(effect, nullptr) << id;
  ASSERT_EQ(effect->SimulationFault(*rig, x), "") << id;
  ASSERT_TRUE(effect->AddTo(Scale(), x, rig)) << id;
}

// Amplitude and phase at f over the whole record.
Response At(const std::vector<double>& x, double rate_hz, double f) {
  Response sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += x[i] * std::polar(1.0, -kRadPerSPerHz * f * static_cast<double>(i) / rate_hz);
  }
  return 2.0 * sum / static_cast<double>(x.size());
}

// A linear loop, stable, with the effect and the tone.
struct Driven {
  RigParameters base;
  Response p;
  Response q;
  Response flame;  // Q / P over the base's own
};

Driven Drive(std::string_view id, const std::vector<double>& x, std::size_t form = 0) {
  Driven out;
  out.base = CycleRig();
  out.base.past.clear();
  out.base.model.flame = {FlameShape::kLinear, -0.3e-4, 1.0, 0.0};
  RigParameters rig = out.base;
  if (!id.empty()) Put(id, x, &rig, form);
  Put("external_tone", {kTone / Scale().heat_release_amplitude, kTone_hz}, &rig);
  const SimulatedRecord record = Simulated(rig);
  out.p = At(record.true_pressure, record.internal_hz, kTone_hz);
  out.q = At(record.true_heat_release, record.internal_hz, kTone_hz);
  out.flame = out.q / out.p /
              (out.base.model.flame.slope * LaplaceVariable(kTone_hz) *
               std::polar(1.0, -kRadPerSPerHz * kTone_hz * out.base.model.loop.tau_s));
  return out;
}

TEST(EffectsInTime, NullKeepsEveryBit) {
  const SimulatedRecord base = Simulated(NoisyRig(), 0.3, 0.05);
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && !a.empty() &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
  };
  std::size_t tried = 0;
  for (const EffectPointer& effect : SimulationCatalogue()) {
    RigParameters rig = NoisyRig();
    ASSERT_TRUE(effect->AddTo(Scale(), NullValues(*effect), &rig)) << effect->id();
    const SimulatedRecord record = Simulated(rig, 0.3, 0.05);
    EXPECT_TRUE(same(record.pressure, base.pressure)) << effect->id();
    EXPECT_TRUE(same(record.heat_release, base.heat_release)) << effect->id();
    EXPECT_TRUE(same(record.true_pressure, base.true_pressure)) << effect->id();
    EXPECT_TRUE(same(record.true_heat_release, base.true_heat_release)) << effect->id();
    ++tried;
  }
  EXPECT_GE(tried, 20u);
}

TEST(EffectsInTime, ToneDrivesTheAcousticsAlone) {
  const Driven loop = Drive("", {});
  const Complex<double> g = AcousticResponse(loop.base.model.loop.acoustics, kTone_hz);
  EXPECT_NEAR(std::abs(loop.p / Response(g.re, g.im) - loop.q), kTone, 1e-4 * kTone);
  EXPECT_LT(std::abs(loop.flame - 1.0), 1e-4);
}

TEST(EffectsInTime, FlameLowPass) {
  const Response truth = 1.0 / (1.0 + Response(0.0, kTone_hz / 364.0));
  EXPECT_LT(std::abs(Drive("flame_lowpass", {364.0}).flame - truth), 1e-3);
}

TEST(EffectsInTime, DispersionIsTheNormalSpreadsTransform) {
  const double sigma_s = 3.141e-4;
  const double truth = std::exp(-0.5 * std::pow(kRadPerSPerHz * kTone_hz * sigma_s, 2));
  for (const std::size_t form : {0u, 1u}) {
    const Response flame = Drive("delay_dispersion", {sigma_s}, form).flame;
    EXPECT_NEAR(std::abs(flame), truth, 2e-4) << form;
    EXPECT_NEAR(std::arg(flame), 0.0, 2e-4) << form;
  }
}

TEST(EffectsInTime, SecondPath) {
  const Response truth = 0.7 + 0.3 * std::polar(1.0, -kRadPerSPerHz * kTone_hz * 2.1e-3);
  for (const std::size_t form : {0u, 1u}) {
    EXPECT_LT(std::abs(Drive("second_delay_path", {0.3, 2.1e-3}, form).flame - truth), 2e-4)
        << form;
  }
}

TEST(EffectsInTime, DelayVariesWithPhi) {
  const Driven loop = Drive("delay_varies_with_phi", {-0.09});
  const double later_s = -0.09 * 0.31 * loop.base.model.loop.tau_s;
  EXPECT_LT(std::abs(loop.flame - std::polar(1.0, -kRadPerSPerHz * kTone_hz * later_s)), 2e-4);
}

TEST(EffectsInTime, ModesAnswerAsPlaced) {
  const auto mode = [](double coefficient, double hz, double xi) {
    const Response s = LaplaceVariable(kTone_hz);
    const double w = kRadPerSPerHz * hz;
    return coefficient * s / (s * s + 2.0 * xi * w * s + w * w);
  };
  const Driven extra = Drive("extra_acoustic_mode", {1.4, 0.2, 0.05});
  const Response with_extra =
      mode(6400.0, 206.0, 0.17) + mode(1700.0, 618.0, 0.17) + mode(1280.0, 1.4 * 206.0, 0.05);
  EXPECT_NEAR(std::abs(extra.p / with_extra - extra.q), kTone, 1e-3 * kTone);
  const Driven moved = Drive("mode_detuning", {1.5});
  const Response detuned = mode(6400.0, 206.0, 0.17) + mode(1700.0, 309.0, 0.17);
  EXPECT_NEAR(std::abs(moved.p / detuned - moved.q), kTone, 1e-3 * kTone);
}

// Recorded over true, at the cycle.
struct Instruments {
  Response p;
  Response q;
  Response true_p;
  Response true_q;
};

Instruments RecordCycle(std::string_view id, const std::vector<double>& x, double* f,
                        std::size_t form = 0) {
  RigParameters rig = CycleRig();
  *f = LimitCycles(rig.model, 400.0).at(0).frequency_hz;
  rig.past = PastOnCycle(LimitCycles(rig.model, 400.0).at(0));
  Put(id, x, &rig, form);
  // Whole periods, nearly: what is left is the same in both.
  const double duration_s = std::round(0.8 * *f) / *f;
  const SimulatedRecord record = Simulated(rig, duration_s);
  return {At(record.pressure, record.sampling_hz, *f),
          At(record.heat_release, record.sampling_hz, *f),
          At(record.true_pressure, record.internal_hz, *f),
          At(record.true_heat_release, record.internal_hz, *f)};
}

TEST(EffectsInTime, QLowPassOfBothOrders) {
  double f = 0.0;
  const Instruments first = RecordCycle("q_sensor_lowpass", {245.0}, &f);
  EXPECT_LT(std::abs(first.q / first.true_q - 1.0 / (1.0 + Response(0.0, f / 245.0))), 3e-3);
  EXPECT_LT(std::abs(first.p / first.true_p - 1.0), 3e-3);
  const Instruments second = RecordCycle("q_sensor_lowpass", {245.0}, &f, 1);
  const Response s(0.0, f / 245.0);
  EXPECT_LT(std::abs(second.q / second.true_q - 1.0 / (1.0 + std::sqrt(2.0) * s + s * s)), 3e-3);
}

TEST(EffectsInTime, HighPassesOfEitherSensor) {
  double f = 0.0;
  const Instruments of_p = RecordCycle("p_sensor_highpass", {60.0}, &f);
  const Response expected = Response(0.0, f) / Response(60.0, f);
  EXPECT_LT(std::abs(of_p.p / of_p.true_p - expected), 3e-3);
  EXPECT_LT(std::abs(of_p.q / of_p.true_q - 1.0), 3e-3);
  const Instruments of_q = RecordCycle("q_sensor_highpass", {60.0}, &f);
  EXPECT_LT(std::abs(of_q.q / of_q.true_q - expected), 3e-3);
  EXPECT_LT(std::abs(of_q.p / of_q.true_p - 1.0), 3e-3);
}

TEST(EffectsInTime, PressureResonance) {
  double f = 0.0;
  const Instruments at = RecordCycle("p_sensor_resonance", {500.0, 0.15}, &f);
  const Response s(0.0, f / 500.0);
  EXPECT_LT(std::abs(at.p / at.true_p - 1.0 / (1.0 + 0.3 * s + s * s)), 4e-3);
}

TEST(EffectsInTime, SkewOfEitherSign) {
  for (const double skew_s : {4e-4, -3.556e-4, 7e-5}) {
    double f = 0.0;
    const Instruments at = RecordCycle("channel_skew", {skew_s}, &f);
    const Response relative = (at.q / at.true_q) / (at.p / at.true_p);
    EXPECT_LT(std::abs(relative - std::polar(1.0, -kRadPerSPerHz * f * skew_s)), 3e-3) << skew_s;
  }
}

TEST(EffectsInTime, CrosstalkAddsItsShareOfP) {
  double f = 0.0;
  const Instruments at = RecordCycle("crosstalk_p_to_q", {0.2}, &f);
  EXPECT_LT(std::abs((at.q - at.true_q) / at.true_p - 0.2 * 0.08), 0.003 * 0.08);
}

double Amplitude(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double value : x) sum += value * value;
  return std::sqrt(2.0 * sum / static_cast<double>(x.size()));
}

// The cycle that the rig ends on is the cycle, by harmonic balance, of the loop whose parameters
// are what that amplitude makes them.
TEST(EffectsInTime, DampingThatGrowsWithAmplitude) {
  RigParameters rig = CycleRig();
  const double free = LimitCycles(rig.model, 400.0).at(0).pressure_amplitude();
  ASSERT_NO_FATAL_FAILURE(Put("nonlinear_damping", {0.03, 0.02}, &rig));
  const double amplitude = Amplitude(Simulated(rig, 1.0, 2.0).true_pressure);
  EXPECT_LT(amplitude, 0.97 * free);
  ClosedLoop damped = rig.model;
  damped.loop.acoustics.xi += 0.03 * std::pow(amplitude / Scale().mean_pressure_amplitude, 2);
  EXPECT_NEAR(LimitCycles(damped, 400.0).at(0).pressure_amplitude() / amplitude, 1.0, 0.01);
}

TEST(EffectsInTime, DelayThatFollowsTheAmplitude) {
  for (const double rel : {-0.05, 0.05}) {
    RigParameters rig = CycleRig();
    ASSERT_NO_FATAL_FAILURE(Put("amplitude_dependent_delay", {rel, 0.02}, &rig));
    const SimulatedRecord record = Simulated(rig, 1.0, 2.0);
    const double amplitude = Amplitude(record.true_pressure);
    ClosedLoop moved = rig.model;
    moved.loop.tau_s *= 1.0 + rel * amplitude / Scale().mean_pressure_amplitude;
    const LimitCycle cycle = LimitCycles(moved, 400.0).at(0);
    EXPECT_NEAR(cycle.pressure_amplitude() / amplitude, 1.0, 0.01) << rel;
    const double own = LimitCycles(rig.model, 400.0).at(0).frequency_hz;
    EXPECT_GT(std::abs(cycle.frequency_hz - own), 1.0);
    // The line is there, not where the base has its own.
    EXPECT_GT(std::abs(At(record.true_pressure, record.internal_hz, cycle.frequency_hz)),
              0.9 * amplitude)
        << rel;
  }
}

TEST(EffectsInTime, DriftMovesTheCycleThroughTheRecord) {
  RigParameters rig = CycleRig();
  SimulationScale scale = Scale();
  scale.duration_s = 4.0;
  ASSERT_TRUE(Find("slow_drift")->AddTo(scale, std::vector<double>{0.06}, &rig));
  const SimulatedRecord record = Simulated(rig, 4.0);
  const auto frequency = [&record](double from_s, double to_s) {
    const std::vector<double>& p = record.true_pressure;
    double first = 0.0;
    double last = 0.0;
    int count = -1;
    for (auto i = static_cast<std::size_t>(from_s * record.internal_hz);
         i + 1 < static_cast<std::size_t>(to_s * record.internal_hz); ++i) {
      if (p[i] >= 0.0 || p[i + 1] < 0.0) continue;
      last = static_cast<double>(i) + p[i] / (p[i] - p[i + 1]);
      if (count++ < 0) first = last;
    }
    return count * record.internal_hz / (last - first);
  };
  for (const double centre_s : {0.4, 2.0, 3.6}) {
    ClosedLoop then = rig.model;
    then.loop.acoustics.omega_hz *= 1.0 + 0.06 * (centre_s / 4.0 - 0.5);
    EXPECT_NEAR(frequency(centre_s - 0.3, centre_s + 0.3),
                LimitCycles(then, 400.0).at(0).frequency_hz, 0.15)
        << centre_s;
  }
}

// What the flame's gain is multiplied by, at 20 kHz for 400 s.
std::vector<double> Gains(std::string_view id, const std::vector<double>& x) {
  RigParameters rig = CycleRig();
  EXPECT_TRUE(Find(id)->AddTo(Scale(), x, &rig));
  const auto effect = rig.effects.at(0)->Clone();
  effect->Start(rig, 5e-5, 3);
  std::vector<double> gain(8'000'000, 1.0);
  for (std::size_t i = 0; i < gain.size(); i += kLoopBlock) {
    effect->FlameIn({}, std::span(gain).subspan(i, kLoopBlock));
  }
  return gain;
}

TEST(EffectsInTime, GainWandersWithItsSpreadAndMemory) {
  const std::vector<double> gain = Gains("parametric_noise", {0.23, 0.03});
  const std::size_t lag = 600;  // 0.03 s
  double square = 0.0;
  double product = 0.0;
  for (std::size_t i = 0; i + lag < gain.size(); ++i) {
    square += std::pow(gain[i] - 1.0, 2);
    product += (gain[i] - 1.0) * (gain[i + lag] - 1.0);
  }
  // 400 s hold 13 000 memories: about 1 % of the variance.
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(gain.size() - lag)), 0.23, 0.23 * 0.025);
  EXPECT_NEAR(product / square, std::exp(-1.0), 0.04);
}

TEST(EffectsInTime, GainDropsForItsDwell) {
  const std::vector<double> gain = Gains("intermittency", {0.57, 0.2});
  int switches = 0;
  std::size_t low = 0;
  for (std::size_t i = 1; i < gain.size(); ++i) {
    EXPECT_TRUE(gain[i] == 1.0 || gain[i] == 1.0 - 0.57);
    if (gain[i] != gain[i - 1]) ++switches;
    if (gain[i] != 1.0) ++low;
  }
  // 2000 times are expected: 2.2 % of their mean, three of them allowed.
  EXPECT_NEAR(400.0 / switches, 0.2, 0.2 * 0.07);
  EXPECT_NEAR(static_cast<double>(low) / static_cast<double>(gain.size()), 0.5, 0.05);
}

TEST(EffectsInTime, ClippingEndsAtItsFraction) {
  for (const char* id : {"p_clipping", "q_clipping"}) {
    RigParameters rig = NoisyRig();
    const bool p = id[0] == 'p';
    ASSERT_NO_FATAL_FAILURE(Put(id, {0.6}, &rig));
    const double limit = 0.6 * (p ? Scale().pressure_amplitude : Scale().heat_release_amplitude);
    const SimulatedRecord base = Simulated(NoisyRig());
    const SimulatedRecord record = Simulated(rig);
    const std::vector<double>& clipped = p ? record.pressure : record.heat_release;
    const std::vector<double>& whole = p ? base.pressure : base.heat_release;
    std::size_t plateau = 0;
    for (std::size_t i = 0; i < clipped.size(); ++i) {
      EXPECT_LE(std::abs(clipped[i]), limit);
      if (std::abs(clipped[i]) < limit) {
        EXPECT_EQ(clipped[i], whole[i]);
      } else {
        ++plateau;
      }
    }
    EXPECT_GT(plateau, clipped.size() / 20) << id;
    EXPECT_EQ(p ? record.heat_release : record.pressure, p ? base.heat_release : base.pressure);
  }
}

TEST(EffectsInTime, QuantisationIsALattice) {
  RigParameters rig = NoisyRig();
  ASSERT_NO_FATAL_FAILURE(Put("quantisation", {16.0}, &rig));
  const SimulatedRecord base = Simulated(NoisyRig());
  const SimulatedRecord record = Simulated(rig);
  const double step = 2.0 * 1.2 * Scale().pressure_amplitude / 16.0;
  for (std::size_t i = 0; i < record.pressure.size(); ++i) {
    EXPECT_NEAR(std::remainder(record.pressure[i] / step, 1.0), 0.0, 1e-12);
    EXPECT_LE(std::abs(record.pressure[i] - base.pressure[i]), (0.5 + 1e-9) * step);
  }
  EXPECT_EQ(record.heat_release, base.heat_release);
}

TEST(EffectsInTime, HumIsInOneChannelAtOddMultiples) {
  const SimulatedRecord base = Simulated(NoisyRig());
  for (const std::size_t form : {0u, 1u}) {
    RigParameters rig = NoisyRig();
    ASSERT_NO_FATAL_FAILURE(Put("mains_hum", {0.12, 50.0}, &rig, form));
    const SimulatedRecord record = Simulated(rig);
    const bool p = Find("mains_hum", form)->form().value == "p";
    EXPECT_EQ(p ? record.heat_release : record.pressure, p ? base.heat_release : base.pressure);
    std::vector<double> hum = p ? record.pressure : record.heat_release;
    for (std::size_t i = 0; i < hum.size(); ++i) {
      hum[i] -= p ? base.pressure[i] : base.heat_release[i];
    }
    const double amplitude =
        0.12 * (p ? Scale().pressure_amplitude : Scale().heat_release_amplitude);
    for (const double k : {1.0, 3.0, 5.0}) {
      EXPECT_NEAR(std::abs(At(hum, 5000.0, 50.0 * k)), amplitude / k, 1e-3 * amplitude) << k;
    }
    EXPECT_LT(std::abs(At(hum, 5000.0, 100.0)), 1e-3 * amplitude);
  }
}

TEST(EffectsInTime, NothingBurnsBeforeItIsFed) {
  const RigParameters rig = CycleRig();
  const EffectPointer spread = Find("delay_dispersion");
  EXPECT_NE(spread->SimulationFault(rig, std::vector<double>{0.001}), "");
  EXPECT_EQ(spread->SimulationFault(rig, std::vector<double>{0.0003}), "");
}

}  // namespace
}  // namespace howl::effects_simulation_test
