// Several operating points' loops from their records together.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "estimation/joint_records/choose_loop.h"
#include "estimation/joint_records/fitted_loop.h"
#include "estimation/joint_records/onset.h"
#include "estimation/record_fit/delay_maxima.h"
#include "estimation/record_fit/starts/path_starts.h"
#include "estimation/record_fit/starts/richer_structure.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::joint_records_test {
namespace {

constexpr std::array<double, 4> kGains = {0.8, 1.2, 1.5, 1.8};

// Delay and first mode drift with the operating parameter, which is the loop's gain here.
ModalLoop DuctAt(double gain) {
  ModalLoop loop = DuctOfModes(2);
  loop.tau_s *= 1.0 + 0.03 * (gain - 1.3);
  loop.modes[0].omega_hz *= 1.0 + 0.02 * (gain - 1.3);
  loop.slope = gain / loop.Open(CycleFrequency(loop, 150.0, 300.0)).real();
  return loop;
}

LoopRecord RecordAt(double gain, double duration_s, std::uint64_t seed) {
  const ModalLoop loop = DuctAt(gain);
  return {"gain " + std::to_string(gain), gain, CycleFrequency(loop, 150.0, 300.0),
          SimulateModalLoop(loop, duration_s, seed)};
}

std::vector<LoopRecord> Records(double duration_s) {
  std::vector<LoopRecord> out;
  for (std::size_t e = 0; e < kGains.size(); ++e) {
    out.push_back(RecordAt(kGains[e], duration_s, 20 + e));
  }
  return out;
}

std::vector<OperatingPoint> Points(double duration_s) {
  std::vector<OperatingPoint> out;
  for (const LoopRecord& each : Records(duration_s)) {
    out.push_back({each.operating_parameter,
                   MakeRecordSpectra(each.record, each.cycle_hz, FlameInput::kPressureRate)});
  }
  return out;
}

class JointRecords : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    points_ = new std::vector<OperatingPoint>(Points(1.5));
    structure_ = new PointStructure(FreeStructure(2));
    fit_ = new RecordsFit(FitRecords(*points_, *structure_, {.starts = 6}));
  }
  static void TearDownTestSuite() {
    delete points_;
    delete structure_;
    delete fit_;
  }
  static std::vector<OperatingPoint>* points_;
  static PointStructure* structure_;
  static RecordsFit* fit_;
};
std::vector<OperatingPoint>* JointRecords::points_ = nullptr;
PointStructure* JointRecords::structure_ = nullptr;
RecordsFit* JointRecords::fit_ = nullptr;

// Begun with one point at another delay and with a wrong mode, the points tell that one where it
// should be.
TEST_F(JointRecords, APointThatBeganElsewhereComesToItsPlace) {
  std::vector<Eigen::VectorXd> row;
  for (const PointFit& fit : fit_->points) row.push_back(fit.parameters);
  const Eigen::VectorXd right = row[2];
  const std::vector<double> delays = PathStarts((*points_)[2].record).Delays(4);
  for (const double tau : delays) {
    if (std::abs(tau - std::exp(right[structure_->Delay()])) < 1.0) continue;
    row[2][structure_->Delay()] = std::log(tau);
  }
  ASSERT_NE(row[2][structure_->Delay()], right[structure_->Delay()]);
  row[2][1] = std::log(5.0);  // the second mode's frequency: that of the first is at 2.3
  const RecordsFit again = FitRecordsFrom(*points_, *structure_, {row});
  EXPECT_NEAR(again.points[2].log_posterior, fit_->points[2].log_posterior, 1.0);
  EXPECT_LT((again.points[2].parameters - right).head(structure_->Transfer()).norm(), 0.02);
}

TEST_F(JointRecords, FindsEachPointsLoop) {
  for (std::size_t e = 0; e < kGains.size(); ++e) {
    const ModalLoop truth = DuctAt(kGains[e]);
    const FittedLoop loop = FittedLoopOf((*points_)[e].record, *structure_, fit_->points[e]);
    ASSERT_TRUE(loop.converged);
    ASSERT_EQ(loop.modes.size(), 2u);
    const auto near = [&](const Estimate& estimate, double value, const char* what) {
      EXPECT_LT(std::abs(estimate.value - value), 4.0 * estimate.std)
          << what << " at " << kGains[e] << ": " << estimate.value << " for " << value;
    };
    near(loop.tau_s, truth.tau_s, "tau");
    for (std::size_t k = 0; k < 2; ++k) {
      near(loop.modes[k].omega_hz, truth.modes[k].omega_hz, "omega");
      near(loop.modes[k].xi, truth.modes[k].xi, "xi");
      near(loop.modes[k].N, truth.modes[k].a, "N");
      near(loop.modes[k].B, truth.modes[k].b, "B");
    }
    ASSERT_TRUE(loop.small_signal.found);
    near(loop.small_signal.loop_gain, kGains[e], "loop gain");
    EXPECT_EQ(loop.small_signal.growth_rate_1_s.value > 0.0, kGains[e] > 1.0);
    const std::vector<OtherDelay> others =
        OtherDelaysOf((*points_)[e].record, *structure_, fit_->points[e], fit_->prior[e]);
    EXPECT_FALSE(others.empty());
    for (const OtherDelay& other : others) EXPECT_GT(other.nats_below, 10.0);
  }
}

// The operating parameter is the loop's gain: oscillations begin to grow at one.
TEST_F(JointRecords, SayWhereOscillationsBeginToGrow) {
  std::vector<OnsetPoint> points;
  for (std::size_t e = 0; e < kGains.size(); ++e) {
    points.push_back(
        {kGains[e], SmallSignalLoopOf((*points_)[e].record, *structure_, fit_->points[e])});
  }
  const Onset onset = OnsetOf(points);
  ASSERT_TRUE(onset.at.available);
  EXPECT_LT(onset.at.lo, 1.0);
  EXPECT_GT(onset.at.hi, 1.0);
  EXPECT_LT(onset.at.hi - onset.at.lo, kGains.back() - kGains.front());
  const double frequency_hz = CycleFrequency(DuctAt(1.0), 150.0, 300.0);
  EXPECT_LT(std::abs(onset.frequency_hz.value - frequency_hz), 3.0 * onset.frequency_hz.std);
  EXPECT_LT(onset.frequency_hz.std, 0.01 * frequency_hz);
}

// From a maximum with a wrong delay, the right one is seen and is more likely.
TEST_F(JointRecords, AWrongDelayShowsTheRightOne) {
  const RecordSpectra& record = (*points_)[2].record;
  const PointPrior prior = PriorOf(*structure_, record);
  const Eigen::VectorXd& right = fit_->points[2].parameters;
  const Eigen::Index delay = structure_->Delay();
  const double tau = std::exp(right[delay]);
  const std::vector<DelayMaximum> others = OtherDelayMaxima(record, *structure_, prior, right);
  ASSERT_FALSE(others.empty());
  Eigen::VectorXd wrong = right;
  wrong[delay] = std::log(others[0].tau);
  wrong.segment(delay + 1, record.flame.cols()) =
      PathStarts(record).Flame({DelaySpread::kNone, others[0].tau});
  wrong = FitPoint(record, *structure_, prior, wrong).parameters;
  ASSERT_GT(std::abs(std::exp(wrong[delay]) - tau), 0.1 * tau);
  const std::vector<DelayMaximum> seen = OtherDelayMaxima(record, *structure_, prior, wrong);
  ASSERT_FALSE(seen.empty());
  EXPECT_NEAR(seen[0].tau, tau, 0.02 * tau);
  EXPECT_LT(seen[0].nats_below, 0.0);
}

// White noise of q's sensor has the spectrum 2 sigma^2 / f_s.
TEST_F(JointRecords, NoiseHasTheUnitsOfTheRig) {
  const Record record = SimulateModalLoop(DuctAt(kGains[2]), 1.5, 22);
  const double sigma = DuctAt(kGains[2]).sensor_noise * RootMeanSquare(record.heat_release);
  const FittedLoop loop = FittedLoopOf((*points_)[2].record, *structure_, fit_->points[2]);
  for (const FittedNoise& noise : loop.noise) {
    if (noise.source != LoopNoise::kHeatReleaseSensor) continue;
    const double expected = 2.0 * sigma * sigma / record.sampling_hz;
    EXPECT_LT(std::abs(std::log(noise.psd[0] / expected)), 4.0 * noise.log_std[0] + 0.02);
  }
}

// The law shows the drift of the delay: 3 % over a change of the operating parameter by one.
TEST_F(JointRecords, LawShowsTheDrift) {
  const Eigen::Index delay = structure_->Transfer();  // in the order of shared_units.h
  double mean = 0.0;
  double square = 0.0;
  for (const double gain : kGains) mean += gain / kGains.size();
  for (const double gain : kGains) square += std::pow(gain - mean, 2) / kGains.size();
  const double trend = fit_->law.trend[delay];
  const double std = std::sqrt(fit_->law.covariance[static_cast<std::size_t>(delay)](1, 1));
  EXPECT_LT(std::abs(trend - 0.03 * std::sqrt(square)), 3.0 * std);
  EXPECT_GT(trend, 0.0);
  EXPECT_LT(fit_->law.spread[delay], 0.1);
}

// What the other points show makes a record far more probable than what is known before any.
TEST_F(JointRecords, OtherPointsForetellARecord) {
  const std::vector<double> left_out = LeftOutDensities(*points_, *fit_);
  for (std::size_t e = 0; e < kGains.size(); ++e) {
    const PointPrior base = PriorOf(*structure_, (*points_)[e].record);
    const PointFit alone =
        FitPoint((*points_)[e].record, *structure_, base, fit_->points[e].parameters);
    EXPECT_GT(left_out[e], alone.log_evidence) << kGains[e];
  }
}

// A loop in a richer structure is the same loop.
TEST_F(JointRecords, RicherStructureContainsTheLoop) {
  const OperatingPoint& point = (*points_)[1];
  PointStructure rich = *structure_;
  rich.modes = 3;
  rich.noise[1].coefficients = 4;
  rich.noise.push_back({LoopNoise::kDuct, 3});
  EXPECT_TRUE(Contains(rich, *structure_));
  EXPECT_FALSE(Contains(*structure_, rich));
  const Eigen::VectorXd from = fit_->points[1].parameters;
  std::vector<LoopMode> silent = {{3.0, 0.1, 0.0, 0.0}};
  const Eigen::VectorXd same = InRicherStructure(point.record, *structure_, from, rich, silent);
  // The duct's noise stands below all, but not at nothing.
  EXPECT_NEAR(LogLikelihood(point.record, rich, same),
              LogLikelihood(point.record, *structure_, from), 40.0);
  const std::vector<LoopMode> further = FurtherModes(point.record, *structure_, from, rich);
  ASSERT_EQ(further.size(), 1u);
  EXPECT_TRUE(std::isfinite(further[0].omega));
}

// The same rig with p in other units and sampled at another rate: the same common parameters.
TEST(SharedUnits, AreTheSameInAllUnits) {
  const ModalLoop loop = DuctAt(1.5);
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  Record record = SimulateModalLoop(loop, 1.0, 7);
  const RecordSpectra one = MakeRecordSpectra(record, cycle_hz, FlameInput::kPressureRate);
  for (double& p : record.pressure) p *= 40.0;
  const RecordSpectra other = MakeRecordSpectra(record, 1.1 * cycle_hz, FlameInput::kPressureRate);
  const PointStructure structure = FreeStructure(2);
  const ReferenceUnits reference{150.0, 2.0, 3.0, 4000.0};
  const SharedUnits units(structure, one, reference);
  const SharedUnits other_units(structure, other, reference);
  const Eigen::VectorXd u = PriorOf(structure, one).mean.array() + 0.3;
  const Eigen::VectorXd common = units.ToCommon(u);
  EXPECT_LT((units.ToCommon(units.FromCommon(common, u)) - common).norm(), 1e-12);
  // R in units of the rig, at the same frequency.
  LoopPoint here = ToPoint(structure, one.flame.cols(), u);
  Eigen::VectorXd moved = other_units.FromCommon(common, PriorOf(structure, other).mean);
  LoopPoint there = ToPoint(structure, other.flame.cols(), moved);
  const double hz = 233.0;
  const auto r = [&](const LoopPoint& point, const RecordSpectra& at) {
    return AcousticTransfer(point, {0.0, hz / at.scale.cycle_hz}) * at.scale.pressure /
           at.scale.heat_release;
  };
  // Residues scale with p's unit in the record, which is the other's by 40.
  EXPECT_LT(std::abs(r(here, one) - r(there, other)), 1e-9 * std::abs(r(here, one)));
  EXPECT_NEAR(here.path.tau / one.scale.cycle_hz, there.path.tau / other.scale.cycle_hz, 1e-12);
}

// A flame that dp/dt drives is not taken for one that p or its integral does.
TEST(LongChooseLoop, FindsWhatDrivesTheFlame) {
  std::vector<LoopRecord> records;
  for (const double gain : {1.2, 1.5}) records.push_back(RecordAt(gain, 0.8, 30));
  RecordLoopSpec spec{.ratio = std::nullopt, .choose_flame_input = true};
  const ChosenLoop loop = FitLoop(records, spec, {.starts = 6});
  ASSERT_EQ(loop.tried.size(), 3u);
  const LoopTried& chosen = loop.tried[loop.chosen];
  EXPECT_EQ(chosen.flame_input, FlameInput::kPressureRate);
  EXPECT_EQ(loop.points[0].record.flame_input, FlameInput::kPressureRate);
  for (const LoopTried& other : loop.tried) {
    if (other.flame_input == chosen.flame_input) continue;
    EXPECT_LT(other.Sum(), chosen.Sum() - std::log(20.0));
  }
}

// Records of two modes ask for two.
TEST(LongChooseModes, TakesAsManyAsThereAre) {
  const std::vector<LoopRecord> records = Records(3.0);
  RecordLoopSpec spec{.choose_modes = true, .ratio = std::nullopt};
  const ChosenLoop loop = FitLoop(records, spec, {.starts = 6});
  EXPECT_EQ(loop.tried[loop.chosen].modes, 2);
  EXPECT_GT(loop.tried[1].Sum(), loop.tried[0].Sum() + 100.0);
}

}  // namespace
}  // namespace howl::joint_records_test
