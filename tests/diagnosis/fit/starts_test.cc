// Fits that find their way to weak modes far from any start.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "diagnosis/cuts/acoustic_cut.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/records/band_signal.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "model/cycles/harmonic_balance.h"
#include "model/effects/catalogue.h"
#include "model/loop/crossings.h"
#include "model/numerics/units.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::starts_test {
namespace {

std::vector<DiagnosisExperiment> WithMode(double ratio, double share, double xi) {
  return SimulatePoints(
      3, [&](RigParameters* rig) { AddMode(ratio, xi, share, rig); }, 31);
}

TEST(Starts, AWeakNarrowModeIsFoundWhereverItLies) {
  for (const double ratio : {1.43, 2.21, 4.13}) {
    const std::vector<CutRecord> records = MakeCutRecords(WithMode(ratio, 0.05, 0.04));
    const EffectFit base = FitBase(records);
    const EffectFit fit = FitEffect(records, ExtraAcousticMode()[0], base);
    EXPECT_NEAR(fit.values[0], ratio, 0.03 * ratio);
    EXPECT_NEAR(fit.values[1], 0.05, 0.02) << ratio;
  }
}

// A mode so strong that the fit without it moves far away: its search begins from there.
TEST(Starts, AStrongModeIsFoundWhateverTheNoise) {
  for (const std::uint64_t seed : {31, 32, 33}) {
    const std::vector<CutRecord> records = MakeCutRecords(SimulatePoints(
        3, [](RigParameters* rig) { AddMode(2.2, 0.05, 0.3, rig); }, seed));
    const EffectFit fit = FitEffect(records, ExtraAcousticMode()[0], FitBase(records));
    EXPECT_NEAR(fit.values[0], 2.2, 0.02) << seed;
    EXPECT_NEAR(fit.values[1], 0.3, 0.03) << seed;
    EXPECT_NEAR(fit.values[2], 0.05, 0.005) << seed;
  }
}

// A weakly damped mode and sensors at a thousandth of the cycle.
std::vector<DiagnosisExperiment> QuietRig() {
  constexpr double kOmegaHz[] = {128.82, 128.70, 127.20};
  constexpr double kXi[] = {0.0315, 0.0331, 0.0358};
  constexpr double kN[] = {371.0, 486.0, 437.0};
  constexpr double kLoopGain[] = {1.38, 1.31, 1.37};
  std::vector<SimulationCase> cases;
  for (std::size_t e = 0; e < 3; ++e) {
    const LoopParameters<double> loop{{kOmegaHz[e], kXi[e], kN[e], 0.0, 3.0}, 0.005677};
    RigParameters rig;
    rig.model = {loop, {FlameShape::kTanh, -1.0, 1.0, 0.0}};
    const std::vector<PhaseCrossing> crossings = PhaseCrossings(loop, -1.0, 200.0);
    const auto cycle_at = std::ranges::max_element(crossings, {}, &PhaseCrossing::gain);
    rig.model.flame.slope = -kLoopGain[e] / cycle_at->gain;
    const LimitCycle cycle = LimitCycles(rig.model, 200.0).front();
    rig.noise.combustion_corner_hz = 500.0;
    rig.noise.combustion_density = 2.0 * 1e-4 / (std::numbers::pi * 500.0);
    rig.noise.pressure_sensor_std = 1e-3 * cycle.pressure_amplitude();
    rig.noise.heat_release_sensor_std = 1e-3 * cycle.heat_release_amplitude();
    rig.past = PastOnCycle(cycle);
    cases.push_back({rig, 37 + e});
  }
  return RecordedPoints<DiagnosisExperiment>(
      cases, {.duration_s = 3.2, .sampling_hz = 5000.0, .settle_s = 0.5},
      [](std::size_t i) { return 0.5 + 0.02 * static_cast<double>(i); });
}

// The noise that is fitted beside the base has far to fall: a base that stops on the way gives
// every effect thousands of nats for nothing.
TEST(Starts, TheBaseIsFollowedToTheEndWhereSensorsAreQuiet) {
  const std::vector<CutRecord> records =
      MakeCutRecords(QuietRig(), {.modes = 1, .harmonic_ratio = 3.0, .own_delays = false});
  const EffectFit base = FitBase(records);
  EXPECT_LT(base.cost() - ConvergedFit(records, base, base).cost(), 1.0);
  EXPECT_NEAR(std::exp(base.experiments[0].acoustics[1]), 0.0315, 0.02 * 0.0315);
  EXPECT_NEAR(base.experiments[0].acoustics[2], 371.0, 0.02 * 371.0);
}

// One point's cycle is the extra mode's own: its omega lies far below the cycle, at the ratio.
TEST(Starts, OmegaIsFoundWhereAnotherModeCarriesTheCycle) {
  const double ratio = 1.6;
  const AcousticLocals truth(std::log(150.0), std::log(0.15), 6000.0, 1500.0);
  const std::vector<double> x = {ratio, 0.34, 0.045};
  const EffectPointer effect = ExtraAcousticMode()[0];
  const Effect& mode = *effect;
  // Noise and a line at the extra mode as q; p by the mode's own transfer function.
  DiagnosisExperiment experiment{"exp1", 0.5, {5000.0, {}, {}}};
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  for (int i = 0; i < 16000; ++i) {
    const double t = static_cast<double>(i) / 5000.0;
    experiment.record.heat_release.push_back(
        0.4 * std::sin(2.0 * std::numbers::pi * 150.0 * ratio * t) + noise(random));
  }
  experiment.record.pressure = experiment.record.heat_release;
  const CutRecord driven = MakeCutRecords({experiment})[0];
  const Eigen::VectorXd p = InTime(driven, RecordedTransfer(driven, mode, x, truth)
                                               .cwiseProduct(driven.heat_release_spectrum.segment(
                                                   driven.first - kTapReach, driven.extended())));
  experiment.record.pressure.assign(p.data(), p.data() + p.size());
  const CutRecord record = MakeCutRecords({experiment})[0];
  ASSERT_NEAR(record.at.cycle_frequency_hz, 150.0 * ratio, 2.0);
  const std::vector<AcousticLocals> starts = AcousticStarts(record, mode, x, 3);
  EXPECT_TRUE(std::any_of(starts.begin(), starts.end(), [&](const AcousticLocals& start) {
    return std::abs(start[0] - truth[0]) < 0.03 && std::abs(start[2] / truth[2] - 1.0) < 0.25;
  }));
}

}  // namespace
}  // namespace howl::starts_test
