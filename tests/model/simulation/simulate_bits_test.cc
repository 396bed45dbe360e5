// The same seed gives the same bits whatever the threads, the lanes and the neighbours, and with
// effects at their null values.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "model/cycles/harmonic_balance.h"
#include "model/simulation/ramp.h"
#include "model/simulation/simulate.h"
#include "tests/model/paper_loop.h"

namespace howl::simulate_bits_test {
namespace {

SimulationCase MakeCase(int index, FlameShape shape) {
  SimulationCase one;
  one.rig.model = PaperLoop(0.3 + 0.05 * index);
  one.rig.model.loop.tau_s += 1.7e-5 * index;
  one.rig.model.loop.acoustics.omega_hz -= 1.3 * index;
  one.rig.model.flame.shape = shape;
  one.rig.model.flame.offset = 100.0 * index;
  one.rig.noise = {1e-8, 1200.0, 0.01, 0.001};
  one.rig.past = {{0.05, 216.0, 0.0, 0.3 * index}};
  one.rig.instruments = {std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 800.0)};
  one.rig.digitisers = {std::make_shared<ClippingInstrument>(Channel::kPressure, 4.0)};
  one.seed = DeriveSeed(99, static_cast<std::uint64_t>(index));
  return one;
}

SimulationOptions Options(int threads) {
  SimulationOptions options;
  options.duration_s = 0.3;
  options.settle_s = 0.05;
  options.keep_true_signals = true;
  options.threads = threads;
  return options;
}

bool SameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && !a.empty() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void ExpectSame(const SimulatedRecord& a, const SimulatedRecord& b) {
  EXPECT_TRUE(SameBits(a.pressure, b.pressure));
  EXPECT_TRUE(SameBits(a.heat_release, b.heat_release));
  EXPECT_TRUE(SameBits(a.true_pressure, b.true_pressure));
  EXPECT_TRUE(SameBits(a.true_heat_release, b.true_heat_release));
}

TEST(SimulateBits, BatchesOfOneAndEightThreadsOneAndTwo) {
  for (const FlameShape shape : {FlameShape::kTanh, FlameShape::kArctan, FlameShape::kCubic,
                                 FlameShape::kPiecewiseLinear, FlameShape::kAlgebraic}) {
    std::vector<SimulationCase> cases;
    for (int i = 0; i < 13; ++i) cases.push_back(MakeCase(i, shape));  // 8 lanes, then 5 of 8
    const auto together = SimulateBatch(cases, Options(1));
    const auto threaded = SimulateBatch(cases, Options(2));
    for (std::size_t i = 0; i < cases.size(); ++i) {
      SCOPED_TRACE(i);
      ExpectSame(together[i], threaded[i]);
      ExpectSame(together[i], Simulate(cases[i], Options(1)));
    }
  }
}

TEST(SimulateBits, OtherSeedsGiveOtherNoise) {
  SimulationCase one = MakeCase(0, FlameShape::kTanh);
  const auto a = Simulate(one, Options(1));
  one.seed += 1;
  const auto b = Simulate(one, Options(1));
  EXPECT_FALSE(SameBits(a.pressure, b.pressure));
}

// Does nothing, at every place.
class NullEffect final : public LoopEffect {
 public:
  std::unique_ptr<LoopEffect> Clone() const override { return std::make_unique<NullEffect>(*this); }
  bool MovesDelay() const override { return true; }
  void Delay(const LoopContext& /*at*/, std::span<double> tau_s) override {
    for (double& tau : tau_s) tau *= 1.0 + 0.0;
  }
  void FlameOut(const LoopContext& at, std::span<double> q) override {
    std::vector<double> delay(q.size(), at.loop.tau_s + 1e-3);
    std::vector<double> v(q.size());
    at.delay_line->Read(delay, v);
    for (std::size_t i = 0; i < q.size(); ++i) {
      q[i] = (1.0 - 0.0) * q[i] + 0.0 * FlameResponse(at.flame, v[i]);
    }
  }
};

TEST(SimulateBits, NullEffectsAreTheBase) {
  const SimulationCase base = MakeCase(2, FlameShape::kTanh);
  const auto plain = Simulate(base, Options(1));

  SimulationCase extended = base;
  extended.rig.effects = {
      std::make_shared<NullEffect>(),
      std::make_shared<ParameterRamp>(RampedParameter::kTau, 1.0, 1.0, 0.0, 0.3),
      std::make_shared<ParameterRamp>(RampedParameter::kOmega, 1.0, 1.0, 0.0, 0.3)};
  extended.rig.instruments.push_back(
      std::make_shared<FirstOrderLowPass>(Channel::kPressure, HUGE_VAL));
  extended.rig.instruments.push_back(
      std::make_shared<SecondOrderResponse>(Channel::kPressure, HUGE_VAL, 0.1));
  extended.rig.instruments.push_back(std::make_shared<GainInstrument>(Channel::kPressure, 1.0));
  extended.rig.digitisers.push_back(
      std::make_shared<ClippingInstrument>(Channel::kHeatRelease, HUGE_VAL));
  ExpectSame(plain, Simulate(extended, Options(1)));

  SimulationCase scheduled = base;
  const ClosedLoop& own = base.rig.model;
  scheduled.rig.effects = {std::make_shared<LoopSchedule>(
      std::vector<LoopSchedule::Point>{{0.0, own.loop, own.flame}, {0.2, own.loop, own.flame}})};
  ExpectSame(plain, Simulate(scheduled, Options(1)));

  SimulationCase more_modes = base;
  more_modes.rig.extra_modes = {{1100.0, 0.05, 0.0}, {400.0, 0.1, 0.0}};
  ExpectSame(plain, Simulate(more_modes, Options(1)));
}

}  // namespace
}  // namespace howl::simulate_bits_test
