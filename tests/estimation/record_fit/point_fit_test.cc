// Loops of several modes with complex residues, found again in records of their limit cycles.
#include "estimation/record_fit/point_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "estimation/record_fit/loop/return_difference.h"
#include "estimation/record_fit/spectra/flame_basis.h"
#include "model/noise/random_stream.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::point_fit_test {
namespace {

// Of a second of a duct's limit cycle.
RecordSpectra SpectraOfTwoModes() {
  const ModalLoop loop = DuctOfModes(2);
  return MakeRecordSpectra(SimulateModalLoop(loop, 1.0, 3), CycleFrequency(loop, 150.0, 300.0),
                           FlameInput::kPressureRate);
}

TEST(PointFit, FindsTwoModesOfALimitCycle) {
  const ModalLoop loop = DuctOfModes(2);
  const IdentifiedLoop found = Identify(loop, SimulateModalLoop(loop, 2.0, 3), 8);
  EXPECT_TRUE(found.fit.converged);
  EXPECT_GT(found.fit.log_posterior, found.from_truth.log_posterior - 0.1);
  for (const IdentifiedParameter& p : found.parameters) {
    EXPECT_LT(std::abs(p.Z()), 4.0) << p.name << " " << p.value << " for " << p.truth;
  }
  // All that the record tells: the delay to 0.1 %, the first mode's damping to 5 %.
  EXPECT_LT(found.parameters.back().std, 1e-3);
  EXPECT_LT(found.parameters[2].std, 0.05);
}

// A fit that is only compared comes to within half a nat of the maximum that a fit goes on to. Far
// below the best, where a loop is wrong and its information is no curvature, it may stop on a
// ridge, but no further down than a hundredth of what it lies below: their order stays.
TEST(PointFit, IsComparedAtTheSameMaximum) {
  const RecordSpectra spectra = SpectraOfTwoModes();
  const PointStructure structure = FreeStructure(2);
  const PointPrior prior = PriorOf(structure, spectra);
  struct Pair {
    double compared, known;
  };
  std::vector<Pair> pairs;
  for (const Eigen::VectorXd& start : StartsOf(spectra, structure, prior, 6, 1)) {
    const PointFit compared = FitPoint(spectra, structure, prior, start, kToCompare);
    if (!compared.converged) continue;
    const PointFit known = FitPoint(spectra, structure, prior, compared.parameters);
    pairs.push_back({compared.log_posterior, known.log_posterior});
  }
  ASSERT_GE(pairs.size(), 10u);
  const double best = std::ranges::max(pairs, {}, &Pair::known).known;
  for (const Pair& each : pairs) {
    EXPECT_NEAR(each.compared, each.known, 0.5 + 0.01 * (best - each.known));
  }
}

// A fit that need not know a share of what it gains ends sooner, and no further below the maximum
// than a few times the share.
TEST(PointFit, EndsWhereTheRestNeedNotBeKnown) {
  const RecordSpectra spectra = SpectraOfTwoModes();
  const PointStructure structure = FreeStructure(2);
  const PointPrior prior = PriorOf(structure, spectra);
  const PointFit best =
      FitPoint(spectra, structure, prior, StartsOf(spectra, structure, prior, 6, 1));
  Eigen::VectorXd start = best.parameters;
  start.head(structure.Frequencies()).array() += 0.05;
  start[structure.Delay()] += 0.05;
  const PointFit begun = FitPoint(spectra, structure, prior, start, {.iterations = 0});
  const PointFit known = FitPoint(spectra, structure, prior, start);
  PointFitOptions options;
  options.share = 1.0 / 400.0;
  options.over = begun.log_posterior;
  const PointFit compared = FitPoint(spectra, structure, prior, start, options);
  const double gained = known.log_posterior - begun.log_posterior;
  ASSERT_GT(gained, 4000.0);
  EXPECT_TRUE(compared.converged);
  EXPECT_LT(compared.iterations, known.iterations);
  EXPECT_NEAR(compared.log_posterior, known.log_posterior, 3.0 * options.share * gained);
  // Where it has gained nothing over what it is compared with it ends where any fit does.
  options.over = known.log_posterior + 1.0;
  EXPECT_EQ(FitPoint(spectra, structure, prior, start, options).log_posterior, known.log_posterior);
}

// Begun with a flame so steep that the loop grows at all frequencies, a fit ends at the loop that
// others find, wherever between the points of its sums the return difference vanishes on its way.
class SteepFlame : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SteepFlame, EndsAtTheLoopThatOthersFind) {
  const ModalLoop loop = DuctOfModes(2);
  const Record record = SimulateModalLoop(loop, 1.0, GetParam());
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  const RecordSpectra spectra = MakeRecordSpectra(record, cycle_hz, FlameInput::kPressureRate);
  const PointStructure structure = FreeStructure(2);
  const PointPrior prior = PriorOf(structure, spectra);
  const PointFit best =
      FitPoint(spectra, structure, prior, StartsOf(spectra, structure, prior, 6, 1));
  Eigen::VectorXd start = best.parameters;
  start.segment(structure.Flame(), spectra.flame.cols()) *= 100.0;
  const auto possible = [&](const Eigen::VectorXd& parameters) {
    const LoopPoint point = ToPoint(structure, spectra.flame.cols(), parameters);
    return std::isfinite(LogDeterminant(spectra, point));
  };
  ASSERT_FALSE(possible(start));
  const PointFit fit = FitPoint(spectra, structure, prior, start, {.iterations = 400});
  EXPECT_TRUE(possible(fit.parameters));
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(fit.log_posterior, best.log_posterior, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Records, SteepFlame, testing::Values(5, 8, 9, 11));

// Begun with a mode at the band's upper end a fit may end beside the maximum: which of such starts
// do is chance, but of each mode some. Of the weak modes, for without that which rules the cycle
// nothing of the loop is found.
TEST(ModeMaxima, FindTheWeakModeThatAFitMisses) {
  ModalLoop loop = DuctOfModes(3);
  loop.noise = 0.02;
  loop.sensor_noise = 0.001;
  const Record record = SimulateModalLoop(loop, 1.0, 5);
  const RecordSpectra spectra =
      MakeRecordSpectra(record, CycleFrequency(loop, 150.0, 300.0), FlameInput::kPressureRate);
  const PointStructure structure = FreeStructure(3);
  const PointPrior prior = PriorOf(structure, spectra);
  const PointFit right = Identify(loop, record, 1).from_truth;
  for (std::size_t missed = 1; missed < 3; ++missed) {
    int misses = 0;
    for (const double omega : {5.6, 5.8, 6.0, 6.2}) {
      LoopPoint point = ToPoint(structure, spectra.flame.cols(), right.parameters);
      point.modes[missed].omega = omega;
      point.modes[missed].xi = 0.003;
      const PointFit wrong = FitPoint(spectra, structure, prior, ToParameters(structure, point));
      if (wrong.log_posterior > right.log_posterior - 100.0) continue;
      ++misses;
      const PointFit found = BestByModes(spectra, structure, prior, wrong);
      EXPECT_GT(found.log_posterior, right.log_posterior - 1.0) << missed << " " << omega;
    }
    EXPECT_GT(misses, 0) << missed;
  }
}

// From wherever a fit begins, its delay and its modes stay where a rig's may be: a quadratic far
// from any maximum points anywhere.
TEST(PointFit, StaysWhereRigsAre) {
  const Record record = SimulateModalLoop(DuctOfModes(2), 0.6, 5);
  const double cycle_hz = CycleFrequency(DuctOfModes(2), 150.0, 300.0);
  const PointStructure structure = FreeStructure(2);
  RandomStream random(1);
  for (const FlameInput input :
       {FlameInput::kPressure, FlameInput::kVelocity, FlameInput::kPressureRate}) {
    const RecordSpectra spectra = MakeRecordSpectra(record, cycle_hz, input);
    const PointPrior prior = PriorOf(structure, spectra);
    for (int i = 0; i < 50; ++i) {
      Eigen::VectorXd start = prior.mean;
      for (Eigen::Index k = 0; k < start.size(); ++k) {
        start[k] += 2.0 * random.Normal() * prior.deviation[k];
      }
      const PointFit fit = FitPoint(spectra, structure, prior, start);
      EXPECT_TRUE(std::isfinite(fit.log_evidence));
      const Eigen::ArrayXd z = (fit.parameters - prior.mean).array() / prior.deviation.array();
      EXPECT_LT(std::abs(z[structure.Delay()]), 10.0) << i;
      EXPECT_LT(z.head(structure.Frequencies()).abs().maxCoeff(), 10.0) << i;
    }
  }
}

// A model with a mode more than the loop has says less of the record, for all its freedom.
TEST(PointFit, EvidencePrefersTheModesThatAreThere) {
  const ModalLoop loop = DuctOfModes(2);
  const Record record = SimulateModalLoop(loop, 1.0, 5);
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  const RecordSpectra spectra = MakeRecordSpectra(record, cycle_hz, FlameInput::kPressureRate);
  std::map<int, double> evidence;
  for (const int modes : {1, 2, 3}) {
    const PointStructure structure = FreeStructure(modes);
    const PointPrior prior = PriorOf(structure, spectra);
    evidence[modes] =
        FitPoint(spectra, structure, prior, StartsOf(spectra, structure, prior, 6, 1)).log_evidence;
  }
  EXPECT_GT(evidence[2], evidence[1] + 100.0);
  EXPECT_GT(evidence[2], evidence[3]);
}

// Of the 95 % intervals of 13 parameters of 30 records nine in ten to all but 1 % contain the
// truth; no parameter is biased by more than 0.6 of its standard deviation (3.3 / sqrt(30)).
TEST(LongPointFit, IntervalsCoverAndAreNotBiased) {
  constexpr int kRecords = 30;
  const ModalLoop loop = DuctOfModes(3);
  std::map<std::string, double> bias;
  int inside = 0;
  int all = 0;
  for (int i = 0; i < kRecords; ++i) {
    const IdentifiedLoop found =
        Identify(loop, SimulateModalLoop(loop, 4.0, 100 + static_cast<std::uint64_t>(i)), 8);
    for (const IdentifiedParameter& p : found.parameters) {
      bias[p.name] += p.Z() / kRecords;
      ++all;
      if (std::abs(p.Z()) < 1.96) ++inside;
    }
  }
  EXPECT_GE(inside, static_cast<int>(0.93 * all));
  EXPECT_LE(inside, static_cast<int>(0.97 * all));
  for (const auto& [name, z] : bias) EXPECT_LT(std::abs(z), 0.6) << name;
}

// An odd number of values: no index that wraps around falls into place by chance.
TEST(FlameBasis, WhatIsNoNumberStaysNone) {
  const Eigen::VectorXd v = Eigen::Vector3d(0.1, std::nan(""), -0.2);
  const Eigen::MatrixXd columns = FlameBasis(1.0).Columns(v);
  EXPECT_TRUE(columns.row(0).allFinite());
  EXPECT_TRUE(columns.row(1).hasNaN());
  EXPECT_TRUE(columns.row(2).allFinite());
}

}  // namespace
}  // namespace howl::point_fit_test
