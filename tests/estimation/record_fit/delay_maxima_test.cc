// Starts at other delays than a fit has.
#include "estimation/record_fit/delay_maxima.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "estimation/record_fit/other_starts.h"
#include "estimation/record_fit/point_posterior.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::delay_maxima_test {
namespace {

class DelayMaxima : public testing::Test {
 protected:
  DelayMaxima() {
    ModalLoop loop = DuctOfModes(2);
    const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
    loop.slope = 1.5 / loop.Open(cycle_hz).real();
    const Record record = SimulateModalLoop(loop, 2.0, 5);
    record_ = MakeRecordSpectra(record, cycle_hz, FlameInput::kPressureRate);
    structure_ = FreeStructure(2);
    prior_ = PriorOf(structure_, record_);
    right_ = Identify(loop, record, 12).fit;
    // At a wrong delay a flame of the other sign makes the cycle as well.
    Eigen::VectorXd start = right_.parameters;
    const Eigen::Index terms = record_.flame.cols();
    start[structure_.Delay()] = std::log(TauOf(right_) + 3.1416);
    start.segment(structure_.Flame(), terms) *= -1.0;
    wrong_ = FitPoint(record_, structure_, prior_, start);
  }
  double TauOf(const PointFit& fit) const { return std::exp(fit.parameters[structure_.Delay()]); }

  RecordSpectra record_;
  PointStructure structure_;
  PointPrior prior_;
  PointFit right_;
  PointFit wrong_;
};

TEST_F(DelayMaxima, AnotherPointsLoopLeadsToTheRightOne) {
  ASSERT_GT(std::abs(TauOf(wrong_) - TauOf(right_)), 1.0);
  ASSERT_LT(wrong_.log_posterior, right_.log_posterior - 10.0);
  const std::vector<Eigen::VectorXd> starts = OtherDelayStarts(
      record_, structure_, prior_, wrong_.parameters, {wrong_.parameters, right_.parameters});
  const PointFit found = BestWith(record_, structure_, prior_, wrong_, starts);
  EXPECT_NEAR(found.log_posterior, right_.log_posterior, 1.0);
  EXPECT_NEAR(TauOf(found), TauOf(right_), 1e-3);
}

TEST_F(DelayMaxima, OfLoopsWithTheSameDelayTheCutAloneMakesStarts) {
  const std::vector<Eigen::VectorXd> starts =
      OtherDelayStarts(record_, structure_, prior_, right_.parameters, {right_.parameters});
  EXPECT_LE(starts.size(), 1u);
  for (const Eigen::VectorXd& start : starts) {
    EXPECT_GT(std::abs(std::exp(start[structure_.Delay()]) - TauOf(right_)), 0.1);
  }
}

// The flame that leaves least of q may be one that the prior calls impossible, and the noise of a
// fit that explains its record is far below what another delay leaves: a fit that begins so spends
// its steps on the way back from there.
TEST_F(DelayMaxima, StartsArePossibleAndAsNoisyAsWhatTheyLeave) {
  const Eigen::Index last = structure_.Flame() + record_.flame.cols() - 1;
  PointPrior narrow = prior_;
  narrow.deviation[last] = 1e-6;
  const std::vector<Eigen::VectorXd> starts =
      OtherDelayStarts(record_, structure_, narrow, wrong_.parameters, {right_.parameters});
  ASSERT_FALSE(starts.empty());
  for (const Eigen::VectorXd& start : starts) {
    EXPECT_LT(std::abs(start[last] - narrow.mean[last]), 1e-4);
    EXPECT_GT(PointPosterior(record_, structure_, narrow).Value(start), -1e5);
  }
}

}  // namespace
}  // namespace howl::delay_maxima_test
