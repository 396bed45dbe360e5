// Where fits of a second path begin, beside a flame that is known by one path alone.
#include "estimation/record_fit/second_path_starts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "estimation/record_fit/starts/richer_structure.h"
#include "tests/estimation/record_fit/drawn_record.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl {
namespace {

// The best of the fits that begin there is the one that begins at the truth, and its start is near.
TEST(SecondPathStarts, LeadToThePathThatIsThere) {
  const ModalLoop loop = BroadDuct();
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  const double radian_s = 1.0 / (2.0 * std::numbers::pi * cycle_hz);
  PointStructure one = FreeStructure(2);
  one.noise = {{LoopNoise::kCombustion, 2}, {LoopNoise::kDuct, 2}};
  PointStructure two = one;
  two.second_path = true;
  for (const double share : {0.3, -0.4}) {
    for (const double lambda : {1.2, 2.0, 5.0}) {
      const FlamePath path{DelaySpread::kNone, loop.tau_s, 0.0,
                           SecondPath{share, lambda * radian_s}};
      const RecordSpectra record =
          MakeRecordSpectra(DrawnRecord(loop, path, 1.5, 9), cycle_hz, FlameInput::kPressureRate);
      const PointPrior prior_of_one = PriorOf(one, record);
      const PointPrior prior = PriorOf(two, record);
      const PointFit alone =
          FitPoint(record, one, prior_of_one, StartsOf(record, one, prior_of_one, 6, 1));
      LoopPoint truth = ToPoint(one, record.flame.cols(), alone.parameters);
      truth = WithTruthOf(loop, record.scale, truth);
      truth.path.second = SecondPath{share, lambda};
      const PointFit right = FitPoint(record, two, prior, ToParameters(two, truth));
      PointFit best;
      best.log_posterior = -1e300;
      for (const Eigen::VectorXd& start : WithTwoPaths(
               record, two, prior, InRicherStructure(record, one, alone.parameters, two, {}),
               kSecondPathStarts)) {
        const PointFit fit = FitPoint(record, two, prior, start);
        if (fit.log_posterior > best.log_posterior) best = fit;
      }
      EXPECT_GT(best.log_posterior, right.log_posterior - 0.1) << share << " " << lambda;
      EXPECT_NEAR(best.parameters[two.SecondPath()], share, 0.1) << lambda;
    }
  }
}

}  // namespace
}  // namespace howl
