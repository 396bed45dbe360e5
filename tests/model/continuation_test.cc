// Branches of cycles: where they are born, lost, and coexist.
#include "model/cycles/continuation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "model/loop/crossings.h"
#include "model/simulation/simulate.h"
#include "tests/model/paper_loop.h"

namespace howl::continuation_test {
namespace {

int Count(const Branch& branch, BifurcationKind kind) {
  return static_cast<int>(std::count_if(branch.bifurcations.begin(), branch.bifurcations.end(),
                                        [kind](const Bifurcation& b) { return b.kind == kind; }));
}

Branch PaperBranch(double m_over_n, std::size_t which) {
  ContinuationOptions options;
  options.parameter_min = 0.2;
  options.parameter_max = 1.05;
  const auto cycles = LimitCycles(PaperLoop(m_over_n), 900.0);
  return ContinueCycle([](double r) { return PaperLoop(r); }, m_over_n, cycles.at(which), options);
}

TEST(Continuation, CyclesNear215And750HzCoexist) {
  const Branch low = PaperBranch(0.415, 0);
  const Branch high = PaperBranch(0.8, 1);
  EXPECT_NEAR(low.points.front().cycle.frequency_hz, 216.0, 1.0);
  EXPECT_NEAR(high.points.back().cycle.frequency_hz, 750.0, 5.0);

  // The upper cycle is born where its crossing's gain passes one, and there it is unstable: the
  // lower mode grows on top of it until M / N = 0.62. The lower cycle loses its stability to the
  // upper mode at 0.92.
  ASSERT_EQ(Count(high, BifurcationKind::kHopf), 1);
  const auto hopf = std::find_if(high.bifurcations.begin(), high.bifurcations.end(),
                                 [](auto& b) { return b.kind == BifurcationKind::kHopf; });
  const ClosedLoop at_hopf = PaperLoop(hopf->parameter);
  const auto crossings = PhaseCrossings(at_hopf.loop, at_hopf.flame.slope, 900.0);
  EXPECT_NEAR(crossings.back().gain, 1.0, 1e-9);
  EXPECT_NEAR(hopf->parameter, 0.5405, 0.0005);
  EXPECT_EQ(Count(high, BifurcationKind::kTorus), 1);
  EXPECT_EQ(Count(low, BifurcationKind::kTorus), 1);

  const auto both = Intersect(StableIntervals(low), StableIntervals(high));
  ASSERT_EQ(both.size(), 1u);
  std::printf("cycles near 215 and 750 Hz coexist for M/N from %.4f to %.4f\n", both[0].lo,
              both[0].hi);
  RecordProperty("coexist_from", std::to_string(both[0].lo));
  RecordProperty("coexist_to", std::to_string(both[0].hi));

  // The ends are where simulation says: a cycle with a small push keeps or leaves its frequency.
  const auto keeps = [](double m_over_n, std::size_t which) {
    const ClosedLoop model = PaperLoop(m_over_n);
    const auto cycles = LimitCycles(model, 900.0);
    SimulationCase one;
    one.rig.model = model;
    one.rig.past = PastOnCycle(cycles.at(which));
    for (const LimitCycle& other : cycles) {
      one.rig.past.push_back({1e-3 * other.heat_release_amplitude(), other.frequency_hz, 0.0, 1.0});
    }
    SimulationOptions options;
    options.settle_s = 12.0;
    options.duration_s = 0.5;
    const SimulatedRecord record = Simulate(one, options);
    // The cycle's share of the power of p.
    double re = 0.0;
    double im = 0.0;
    double power = 0.0;
    for (std::size_t i = 0; i < record.pressure.size(); ++i) {
      const double angle =
          kRadPerSPerHz * cycles[which].frequency_hz * static_cast<double>(i) / record.sampling_hz;
      re += record.pressure[i] * std::cos(angle);
      im += record.pressure[i] * std::sin(angle);
      power += record.pressure[i] * record.pressure[i];
    }
    const auto n = static_cast<double>(record.pressure.size());
    return 2.0 * (re * re + im * im) / (n * power) > 0.5;
  };
  EXPECT_FALSE(keeps(both[0].lo - 0.015, 1));
  EXPECT_TRUE(keeps(both[0].lo + 0.015, 1));
  EXPECT_TRUE(keeps(both[0].hi - 0.015, 0));
  EXPECT_FALSE(keeps(both[0].hi + 0.015, 0));
}

// A flame off its centre is steeper at some amplitude than at rest: the cycle is born unstable,
// towards lower gain, and turns stable in a fold.
ClosedLoop OffsetLoop(double gain_factor) {
  ClosedLoop model = PaperLoop(0.1);
  model.flame.slope *= gain_factor;
  model.flame.offset = 1.1 * model.flame.saturation / std::abs(model.flame.slope);
  return model;
}

TEST(Continuation, FoldAndHysteresis) {
  ContinuationOptions options;
  options.parameter_min = 0.5;
  options.parameter_max = 3.0;
  const auto start = LimitCycles(OffsetLoop(2.9), 300.0);
  ASSERT_EQ(start.size(), 1u);
  const Branch branch = ContinueCycle(OffsetLoop, 2.9, start[0], options);
  ASSERT_EQ(Count(branch, BifurcationKind::kFold), 1);
  ASSERT_EQ(Count(branch, BifurcationKind::kHopf), 1);
  double fold = 0.0;
  double hopf = 0.0;
  for (const Bifurcation& b : branch.bifurcations) {
    if (b.kind == BifurcationKind::kFold) fold = b.parameter;
    if (b.kind == BifurcationKind::kHopf) hopf = b.parameter;
  }
  EXPECT_LT(fold, hopf - 0.02);
  // One side of the fold is stable, the other is not.
  for (const BranchPoint& point : branch.points) {
    const double amplitude_at_fold =
        std::find_if(branch.bifurcations.begin(), branch.bifurcations.end(), [](auto& b) {
          return b.kind == BifurcationKind::kFold;
        })->rate_amplitude;
    if (std::abs(point.cycle.rate_amplitude() / amplitude_at_fold - 1.0) < 0.05) continue;
    EXPECT_EQ(point.stable, point.cycle.rate_amplitude() > amplitude_at_fold) << point.parameter;
  }
  // Between fold and Hopf both rest and the cycle attract; below the fold only rest.
  const auto final_amplitude = [](double gain_factor, double amplitude) {
    SimulationCase one;
    one.rig.model = OffsetLoop(gain_factor);
    one.rig.past = {{amplitude, 216.0, 0.0, 0.0}};
    SimulationOptions simulation;
    simulation.settle_s = 10.0;
    simulation.duration_s = 0.1;
    const SimulatedRecord record = Simulate(one, simulation);
    return *std::max_element(record.pressure.begin(), record.pressure.end());
  };
  const double inside = 0.5 * (fold + hopf);
  EXPECT_EQ(LimitCycles(OffsetLoop(inside), 300.0).size(), 2u);
  EXPECT_EQ(LimitCycles(OffsetLoop(fold - 0.02), 300.0).size(), 0u);
  EXPECT_GT(final_amplitude(inside, 0.5), 0.5);
  EXPECT_LT(final_amplitude(inside, 0.001), 1e-6);
  EXPECT_LT(final_amplitude(fold - 0.02, 0.5), 1e-6);
  EXPECT_GT(final_amplitude(hopf + 0.02, 0.001), 0.5);
}

TEST(Continuation, ThroughTheDelay) {
  // Any parameter will do: the frequency follows tau, and the branch ends at the limits asked for.
  ContinuationOptions options;
  options.parameter_min = 0.0034;
  options.parameter_max = 0.0035;
  const auto path = [](double tau_s) {
    ClosedLoop model = PaperLoop(0.415);
    model.loop.tau_s = tau_s;
    return model;
  };
  const auto cycles = LimitCycles(path(0.00346), 300.0);
  const Branch branch = ContinueCycle(path, 0.00346, cycles.at(0), options);
  EXPECT_NEAR(branch.points.front().parameter, 0.0034, 1e-10);
  EXPECT_NEAR(branch.points.back().parameter, 0.0035, 1e-10);
  for (const double tau_s : {0.0034, 0.0035}) {
    const auto direct = LimitCycles(path(tau_s), 300.0);
    const LimitCycle& end = (tau_s < 0.00345 ? branch.points.front() : branch.points.back()).cycle;
    EXPECT_NEAR(end.frequency_hz, direct.at(0).frequency_hz, 1e-6);
    EXPECT_NEAR(end.pressure_amplitude(), direct.at(0).pressure_amplitude(), 1e-6);
  }
}

}  // namespace
}  // namespace howl::continuation_test
