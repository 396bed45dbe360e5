// Where fits of a second path begin, beside a flame that is known by one path alone.
#include "estimation/record_fit/second_path_starts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "estimation/record_fit/fit_under_prior.h"
#include "estimation/record_fit/mode_maxima.h"
#include "estimation/record_fit/starts/richer_structure.h"
#include "tests/estimation/record_fit/drawn_record.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::second_path_starts_test {
namespace {

// The best of the fits that begin there is the one that begins at the truth, and its start is near.
// Acoustics that made up for the missing path may rest beside their place, which a search for other
// places of the modes then finds, as every fit's does.
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
      best = BestByModes(record, two, prior, best);
      best = FitPoint(record, two, prior, best.parameters);
      EXPECT_GT(best.log_posterior, right.log_posterior - 0.1) << share << " " << lambda;
      EXPECT_NEAR(best.parameters[two.SecondPath()], share, 0.1) << lambda;
    }
  }
}

// A path half a period later whose share has the other sign is the same at the cycle: a fit rests
// there, until it begins with the path that other points tell.
TEST(FitUnder, LeavesAPathThatOthersDoNotHave) {
  const ModalLoop loop = DuctOfModes(2);
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  const double radian_s = 1.0 / (2.0 * std::numbers::pi * cycle_hz);
  const FlamePath path{DelaySpread::kNone, loop.tau_s, 0.0, SecondPath{0.2, 1.2 * radian_s}};
  const RecordSpectra record =
      MakeRecordSpectra(DrawnRecord(loop, path, 1.5, 9), cycle_hz, FlameInput::kPressureRate);
  PointStructure structure = FreeStructure(2);
  structure.noise = {{LoopNoise::kCombustion, 2}, {LoopNoise::kDuct, 2}};
  structure.second_path = true;
  PointPrior prior = PriorOf(structure, record);
  const PointFit alone =
      FitPoint(record, structure, prior, StartsOf(record, structure, prior, 6, 1));
  LoopPoint truth = ToPoint(structure, record.flame.cols(), alone.parameters);
  truth = WithTruthOf(loop, record.scale, truth);
  truth.path.second = SecondPath{0.2, 1.2};
  const Eigen::Index share = structure.SecondPath();
  prior.mean.segment(structure.Delay(), structure.Delays()) =
      ToParameters(structure, truth).segment(structure.Delay(), structure.Delays());
  prior.deviation[share] = 0.2;
  prior.deviation[share + 1] = 0.5;
  const PointFit right = FitPoint(record, structure, prior, ToParameters(structure, truth));
  truth.path.second = SecondPath{-0.2, 1.2 + std::numbers::pi};
  const PointFit other = FitPoint(record, structure, prior,
                                  WithBestFlame(record, structure, ToParameters(structure, truth)));
  ASSERT_LT(other.log_posterior, right.log_posterior - 1.0);
  const PointFit found = FitUnder(record, structure, prior, other.parameters, true);
  EXPECT_GT(found.log_posterior, right.log_posterior - 0.1);
}

}  // namespace
}  // namespace howl::second_path_starts_test
