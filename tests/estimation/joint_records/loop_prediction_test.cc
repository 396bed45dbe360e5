// Predictions of loops at operating points that were left out, of rigs whose loops are known.
#include "estimation/joint_records/loop_prediction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "estimation/joint_records/small_signal_loop.h"
#include "model/noise/random_stream.h"
#include "tests/estimation/joint_records/known_flame.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::loop_prediction_test {
namespace {

using C = std::complex<double>;

// One mode, whose parameters follow straight lines over x and scatter about them.
ModalLoop RigAt(double x, RandomStream& random) {
  const auto drawn = [&](double mean, double trend, double spread) {
    return mean * (1.0 + trend * x + spread * random.Normal());
  };
  ModalLoop loop;
  loop.modes = {{drawn(200.0, 0.03, 0.003), drawn(0.06, 0.2, 0.03), drawn(300.0, 0.1, 0.02),
                 60.0 + 6.0 * random.Normal()}};
  loop.tau_s = drawn(0.0033, -0.03, 0.004);
  // Sixty-five hundredths to one and a half times what the loop's gain asks for.
  ModalLoop nominal = loop;
  nominal.modes = {{200.0, 0.06, 300.0, 60.0}};
  nominal.tau_s = 0.0033;
  loop.slope = drawn(1.15, 0.3, 0.02) / nominal.Open(CycleFrequency(nominal, 150.0, 300.0)).real();
  return loop;
}

struct TrueRoot {
  double frequency_hz = 0.0;
  double growth_rate_1_s = 0.0;
  double gain = 0.0;
};

// slope Open(s) = 1 near the phase crossing, written out on its own, by the secant method.
TrueRoot RootOf(const ModalLoop& loop) {
  const auto open = [&](C s) {
    C g = 0.0;
    for (const ModalLoop::Mode& mode : loop.modes) {
      const double w = 2.0 * std::numbers::pi * mode.omega_hz;
      g += (mode.a * s + mode.b * w) / (s * s + 2.0 * mode.xi * w * s + w * w);
    }
    return -loop.slope * s * g * std::exp(-s * loop.tau_s) - 1.0;
  };
  C before(0.0, 2.0 * std::numbers::pi * CycleFrequency(loop, 150.0, 300.0));
  C s = before + C(1.0, 1.0);
  for (int i = 0; i < 40 && std::abs(s - before) > 1e-9; ++i) {
    const C next = s - open(s) * (s - before) / (open(s) - open(before));
    before = s;
    s = next;
  }
  return {s.imag() / (2.0 * std::numbers::pi), s.real(), std::abs(open(C(0.0, s.imag())) + 1.0)};
}

// The fit of a record, begun at the loop that made it: predictions are tested, not the search.
PointFit FitFromTruth(const ModalLoop& loop, const RecordSpectra& record,
                      const PointStructure& structure, const PointPrior& prior) {
  const double turn = 2.0 * std::numbers::pi * record.scale.cycle_hz;
  const double residue = turn * record.scale.pressure / record.scale.heat_release;
  LoopPoint start = ToPoint(structure, record.flame.cols(), prior.mean);
  const ModalLoop::Mode& mode = loop.modes[0];
  start.modes[0] = {
      mode.omega_hz / record.scale.cycle_hz, mode.xi, mode.a / residue, mode.b / residue, 0.0, 0.0};
  start.path.tau = loop.tau_s * turn;
  start.flame = KnownFlame(
      record, [&](double v) { return -loop.slope * loop.range * std::tanh(v / loop.range); });
  return FitPoint(record, structure, prior, ToParameters(structure, start));
}

struct FittedRig {
  std::vector<ModalLoop> loops;
  std::vector<OnsetPoint> points;
};

FittedRig MakeFittedRig(std::uint64_t seed, double duration_s) {
  RandomStream random(seed);
  const PointStructure structure = FreeStructure(1);
  FittedRig rig;
  for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    rig.loops.push_back(RigAt(x, random));
    const ModalLoop& loop = rig.loops.back();
    const RecordSpectra record =
        MakeRecordSpectra(SimulateModalLoop(loop, duration_s, 100 * seed + rig.points.size()),
                          CycleFrequency(loop, 150.0, 300.0), FlameInput::kPressureRate);
    const PointPrior prior = PriorOf(structure, record);
    const PointFit fit = FitFromTruth(loop, record, structure, prior);
    rig.points.push_back({x, SmallSignalLoopOf(record, structure, fit)});
  }
  return rig;
}

struct Cover {
  int asked = 0;
  int frequency = 0;
  int growth_rate = 0;
  int gain = 0;
  double width = 0.0;  // mean, of the gain's interval

  void Add(const RestLoopPrediction& predicted, const TrueRoot& truth) {
    const auto inside = [](const PredictedValue& value, double x) {
      return value.lo <= x && x <= value.hi ? 1 : 0;
    };
    ++asked;
    frequency += inside(predicted.frequency_hz, truth.frequency_hz);
    growth_rate += inside(predicted.growth_rate_1_s, truth.growth_rate_1_s);
    gain += inside(predicted.loop_gain, truth.gain);
    width += predicted.loop_gain.hi - predicted.loop_gain.lo;
  }
};

Cover CoverOfLeftOut(int rigs, double duration_s) {
  Cover cover;
  for (int r = 0; r < rigs; ++r) {
    const FittedRig rig = MakeFittedRig(static_cast<std::uint64_t>(r + 1), duration_s);
    for (std::size_t e = 0; e < rig.points.size(); ++e) {
      std::vector<OnsetPoint> others = rig.points;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(e));
      const RestLoopPrediction predicted =
          LoopPredictor(others).At(rig.points[e].operating_parameter);
      EXPECT_FALSE(predicted.measured);
      cover.Add(predicted, RootOf(rig.loops[e]));
    }
  }
  cover.width /= cover.asked;
  std::printf(
      "of %d points left out: frequency %d, growth rate %d, loop gain %d inside, the gain's "
      "interval %.3f wide\n",
      cover.asked, cover.frequency, cover.growth_rate, cover.gain, cover.width);
  return cover;
}

// Of 40 points 38 are expected; fewer than 34 have a probability of 1 %.
TEST(LoopPrediction, PointsLeftOutLieInside) {
  const Cover cover = CoverOfLeftOut(8, 1.0);
  ASSERT_EQ(cover.asked, 40);
  EXPECT_GE(cover.frequency, 34);
  EXPECT_GE(cover.growth_rate, 34);
  EXPECT_GE(cover.gain, 34);
}

// 190 of 200; fewer than 180 have a probability of 0.2 %.
TEST(LongLoopPrediction, PointsLeftOutLieInsideAsOftenAsSaid) {
  const Cover cover = CoverOfLeftOut(40, 2.0);
  ASSERT_EQ(cover.asked, 200);
  EXPECT_GE(cover.frequency, 180);
  EXPECT_GE(cover.growth_rate, 180);
  EXPECT_GE(cover.gain, 180);
}

SmallSignalLoop LoopOf(double frequency_hz, double growth_rate_1_s, double gain) {
  return {{frequency_hz, 1e-4}, {growth_rate_1_s, 1e-3}, {gain, 1e-5}, true};
}

// At a measured point the interval is the record's own; points that lie on lines have their
// prediction on them, narrower between the points than beyond.
TEST(LoopPrediction, FollowsLinesThroughThePoints) {
  std::vector<OnsetPoint> points;
  for (const double x : {0.4, 0.5, 0.6, 0.7}) {
    const double frequency_hz = 200.0 * std::exp(0.1 * x);
    points.push_back(
        {x, LoopOf(frequency_hz, 2.0 * std::numbers::pi * frequency_hz * (0.02 * x - 0.011),
                   std::exp(2.0 * x - 1.1))});
  }
  const LoopPredictor predictor(points);
  const RestLoopPrediction at = predictor.At(0.5);
  ASSERT_EQ(at.measured, 1u);
  EXPECT_EQ(at.frequency_hz.value, points[1].loop.frequency_hz.value);
  EXPECT_NEAR(at.loop_gain.hi - at.loop_gain.lo, 2.0 * 1.959964 * 1e-5, 1e-9);
  EXPECT_LT(at.share_unstable, 1e-6);
  const RestLoopPrediction between = predictor.At(0.55);
  EXPECT_FALSE(between.measured);
  EXPECT_NEAR(between.frequency_hz.value, 200.0 * std::exp(0.055), 1e-3);
  EXPECT_NEAR(between.growth_rate_1_s.value, 0.0, 0.05);
  EXPECT_NEAR(between.share_unstable, 0.5, 0.01);
  EXPECT_NEAR(between.loop_gain.value, 1.0, 1e-3);
  const RestLoopPrediction beyond = predictor.At(0.8);
  EXPECT_GT(beyond.loop_gain.hi / beyond.loop_gain.lo, between.loop_gain.hi / between.loop_gain.lo);
  EXPECT_GT(beyond.share_unstable, 0.8);
}

TEST(LoopPrediction, OnePointTellsOfNoOther) {
  const LoopPredictor predictor(std::vector<OnsetPoint>{{0.5, LoopOf(200.0, 3.0, 1.1)}});
  EXPECT_TRUE(predictor.At(0.5).measured);
  EXPECT_TRUE(std::isnan(predictor.At(0.6).frequency_hz.value));
  EXPECT_TRUE(std::isnan(predictor.At(0.6).share_unstable));
}

}  // namespace
}  // namespace howl::loop_prediction_test
