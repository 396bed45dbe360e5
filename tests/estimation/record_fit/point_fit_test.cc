// Loops of several modes with complex residues, found again in records of their limit cycles.
#include "estimation/record_fit/point_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <map>
#include <string>

#include "estimation/record_fit/flame_basis.h"
#include "estimation/record_fit/growing_roots.h"
#include "estimation/record_fit/return_difference.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl {
namespace {

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

// Begun with a flame so steep that the loop diverges all over the band, a fit ends at one that does
// not.
TEST(PointFit, EndsAtALoopThatDoesNotDiverge) {
  const ModalLoop loop = DuctOfModes(2);
  const Record record = SimulateModalLoop(loop, 1.0, 5);
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  const RecordSpectra spectra = MakeRecordSpectra(record, cycle_hz, FlameInput::kPressureRate);
  const PointStructure structure = FreeStructure(2);
  const PointPrior prior = PriorOf(structure, spectra);
  Eigen::VectorXd start =
      FitPoint(spectra, structure, prior, StartsOf(spectra, structure, prior, 6, 1)).parameters;
  start.segment(structure.Delay() + 1, spectra.flame.cols()) *= 100.0;
  const auto diverges = [&](const Eigen::VectorXd& parameters) {
    return Diverges(spectra, ToPoint(structure, spectra.flame.cols(), parameters));
  };
  ASSERT_TRUE(diverges(start)) << GrowingRoots(spectra,
                                               ToPoint(structure, spectra.flame.cols(), start));
  const PointFit fit = FitPoint(spectra, structure, prior, start);
  EXPECT_TRUE(std::isfinite(fit.log_posterior));
  EXPECT_FALSE(diverges(fit.parameters));
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

// Of a flame driven by a sinusoid, the mean slope and the slope at twice the cycle's frequency are
// together the describing function: where the loop balances, the determinant vanishes.
TEST(ReturnDifference, CouplingMakesTheDescribingFunction) {
  constexpr int kSamples = 20000;
  constexpr double kCycle_hz = 200.0;
  Record record;
  record.sampling_hz = 10000.0;
  for (int i = 0; i < kSamples; ++i) {
    const double phase = 2.0 * std::numbers::pi * kCycle_hz * i / record.sampling_hz;
    record.pressure.push_back(std::cos(phase) + 1e-3 * std::cos(3.3 * phase));
    record.heat_release.push_back(std::tanh(2.0 * std::sin(phase)));
  }
  const RecordSpectra spectra = MakeRecordSpectra(record, kCycle_hz, FlameInput::kPressureRate);
  // v = -A sin(phase): q = tanh(-2 v / A). Its spline, by least squares over the band.
  const Eigen::VectorXd flame = (spectra.flame.adjoint() * spectra.flame)
                                    .real()
                                    .ldlt()
                                    .solve((spectra.flame.adjoint() * spectra.heat_release).real());
  const double mean_slope = spectra.slopes.dot(flame);
  const std::complex<double> coupling = (spectra.coupling.transpose() * flame).value();
  double describing = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / kSamples;
    describing += 2.0 / kSamples * std::tanh(2.0 * std::sin(angle)) * std::sin(angle);
  }
  const double amplitude = 1.0 / spectra.scale.pressure;
  const double expected = -describing / (amplitude * spectra.scale.heat_release);
  EXPECT_NEAR((mean_slope - coupling.real()) / expected, 1.0, 0.02);
  EXPECT_NEAR(coupling.imag() / expected, 0.0, 1e-3);
  EXPECT_GT(std::abs(coupling.real() / expected), 0.1);
}

}  // namespace
}  // namespace howl
