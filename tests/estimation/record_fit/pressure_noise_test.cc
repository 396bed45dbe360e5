// What a fitted loop takes for noise of p, against the noise that a simulated sensor added.
#include "estimation/record_fit/loop/pressure_noise.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <complex>
#include <cstdint>
#include <utility>

#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/spectra/unitary_transform.h"
#include "estimation/record_fit/starts/path_starts.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::pressure_noise_test {
namespace {

class PressureNoiseTest : public testing::Test {
 protected:
  PressureNoiseTest() : structure_(FreeStructure(2)) {
    loop_.slope *= 1.2;
    const Record record = SimulateModalLoop(loop_, 0.8, 1002);
    ModalLoop quiet = loop_;
    quiet.sensor_noise = 0.0;
    const Record clean = SimulateModalLoop(quiet, 0.8, 1002);
    recorded_ =
        MakeRecordSpectra(record, CycleFrequency(loop_, 150.0, 300.0), FlameInput::kPressureRate);
    added_.resize(static_cast<Eigen::Index>(record.pressure.size()));
    for (Eigen::Index n = 0; n < added_.size(); ++n) {
      const auto i = static_cast<std::size_t>(n);
      added_[n] = (record.pressure[i] - clean.pressure[i]) / recorded_.scale.pressure;
    }
    fit_ = Fitted(recorded_);
  }

  // Begun at the true loop.
  PointFit Fitted(const RecordSpectra& record) const {
    const PointPrior prior = PriorOf(structure_, record);
    const LoopPoint start =
        WithTruthOf(loop_, record.scale, ToPoint(structure_, record.flame.cols(), prior.mean));
    return FitPoint(record, structure_, prior, ToParameters(structure_, start));
  }

  Eigen::VectorXcd Band(const Eigen::VectorXd& signal) const {
    return UnitarySpectrum(signal).segment(recorded_.below.size(), recorded_.bins() + 1);
  }

  double GainOfSpread(const RecordSpectra& record) const {
    const PointFit without = Fitted(record);
    PointStructure spread = structure_;
    spread.delay_spread = DelaySpread::kNormal;
    LoopPoint start = ToPoint(structure_, record.flame.cols(), without.parameters);
    start.path.spread = spread.delay_spread;
    start.path.rho = 0.04;
    const PointFit with =
        FitPoint(record, spread, PriorOf(spread, record), ToParameters(spread, start));
    return with.log_evidence - without.log_evidence;
  }

  ModalLoop loop_ = DuctOfModes(2);
  PointStructure structure_;
  RecordSpectra recorded_;
  Eigen::VectorXd added_;  // the sensor's noise, in the record's unit
  PointFit fit_;
};

// The expectation of one of two jointly normal variables leaves the variance
// S - S^2 u^H Sigma^-1 u.
TEST_F(PressureNoiseTest, IsAsMuchOfTheSensorsNoiseAsNormalVariablesTell) {
  const LoopPoint point = ToPoint(structure_, recorded_.flame.cols(), fit_.parameters);
  const LoopResiduals at = ResidualsOf(recorded_, structure_, point);
  double all = 0.0;
  double expected = 0.0;
  for (Eigen::Index i = 0; i < recorded_.bins(); ++i) {
    const Eigen::Matrix2cd inverse = NoiseCovariance(structure_.noise, at, i).inverse();
    const Eigen::Vector2cd u(1.0, -at.f[i]);
    const double s = at.spectra(i, 1);
    all += s;
    expected += s - s * s * u.dot(inverse * u).real();
  }
  const Eigen::VectorXcd added = Band(added_);
  const Eigen::VectorXcd left = added - Band(PressureNoise(recorded_, structure_, fit_.parameters));
  const double share = left.squaredNorm() / added.squaredNorm();
  // Near the record's ends the noise is left as it is.
  EXPECT_NEAR(share, expected / all, 0.1);
  EXPECT_LT(share, 0.4);
}

// Noise in what drives a curve is mixed into all frequencies, where the curve foretells of q what
// is not there: spread delays, which foretell less of it, would be believed.
TEST_F(PressureNoiseTest, WithoutItAFlameIsAsDrivenByTheDuct) {
  const RecordSpectra of_duct = DrivenWithout(recorded_, added_);
  const RecordSpectra cleaned =
      DrivenWithout(recorded_, PressureNoise(recorded_, structure_, fit_.parameters));
  const double right = GainOfSpread(of_duct);
  EXPECT_LT(right, 0.0);
  EXPECT_GT(GainOfSpread(recorded_), right + 1.0);
  EXPECT_NEAR(GainOfSpread(cleaned), right, 0.5);
  EXPECT_GT(Fitted(cleaned).log_evidence, fit_.log_evidence + 3.0);
}

// Of the cycle's line a loop with too strong an acoustic answer misses what no noise explains.
TEST_F(PressureNoiseTest, IsNoneOfWhatALoopMisses) {
  LoopPoint wrong = ToPoint(structure_, recorded_.flame.cols(), fit_.parameters);
  for (LoopMode& mode : wrong.modes) {
    mode.a *= 1.1;
    mode.b *= 1.1;
  }
  const Eigen::VectorXcd noise =
      Band(PressureNoise(recorded_, structure_, ToParameters(structure_, wrong)));
  Eigen::Index cycle = 0;
  recorded_.pressure.cwiseAbs().maxCoeff(&cycle);
  const double missed = 0.1 * std::abs(recorded_.pressure[cycle]);
  EXPECT_LT(noise.segment(cycle - 2, 5).cwiseAbs().maxCoeff(), 0.05 * missed);
}

TEST_F(PressureNoiseTest, LeavesTheAnswerToSmallSignals) {
  const RecordSpectra cleaned = DrivenWithout(recorded_, added_);
  // A flame that is linear answers to all of recorded p: of the straight line no function's
  // spectrum moves.
  const Eigen::VectorXd knots = FlameBasis(recorded_.scale.input_range).Knots();
  const Eigen::VectorXd line = recorded_.scale.functions.colPivHouseholderQr().solve(
      (knots.head(kFlameTerms).array() - knots[kFlameTerms]).matrix());
  const Eigen::VectorXcd before = recorded_.flame * line;
  const Eigen::VectorXcd after = cleaned.flame * line;
  EXPECT_LT((after - before).norm(), 1e-3 * before.norm());
}

// A flame that is nearly a switch answers to when its input jumps, which the harmonics above the
// band tell: without them the delay errs by six deviations.
TEST(PressureNoise, LeavesTheHarmonicsThatTellWhenASwitchTurns) {
  constexpr int kRecords = 4;
  double sum = 0.0;
  for (int i = 0; i < kRecords; ++i) {
    ModalLoop loop = DuctOfModes(2);
    const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
    loop.slope = 6.0 / loop.Open(cycle_hz).real();
    const auto seed = static_cast<std::uint64_t>(100 + i);
    RecordSpectra record =
        MakeRecordSpectra(SimulateModalLoop(loop, 0.8, seed), cycle_hz, FlameInput::kPressureRate);
    const PointStructure structure = FreeStructure(2);
    const PointPrior prior = PriorOf(structure, record);
    LoopPoint start =
        WithTruthOf(loop, record.scale, ToPoint(structure, record.flame.cols(), prior.mean));
    start.flame = PathStarts(record).Flame(start.path);
    PointFit fit = FitPoint(record, structure, prior, ToParameters(structure, start));
    record = DrivenWithout(std::move(record), PressureNoise(record, structure, fit.parameters));
    fit = FitPoint(record, structure, prior, fit.parameters);
    const Eigen::Index delay = structure.Delay();
    sum += (fit.parameters[delay] - std::log(start.path.tau)) /
           std::sqrt(fit.Covariance()(delay, delay));
  }
  EXPECT_LT(std::abs(sum / kRecords), 2.0);
}

}  // namespace
}  // namespace howl::pressure_noise_test
