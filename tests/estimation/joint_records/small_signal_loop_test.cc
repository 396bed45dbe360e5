// The root that stands for a loop about rest.
#include "estimation/joint_records/small_signal_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/noise/random_stream.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::small_signal_loop_test {
namespace {

// From anywhere Newton's method may come to a root far off, or to one without a frequency: neither
// is the cycle's.
TEST(SmallSignalLoop, IsOfARootNearTheCycle) {
  const ModalLoop loop = DuctOfModes(2);
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  const RecordSpectra record =
      MakeRecordSpectra(SimulateModalLoop(loop, 0.6, 5), cycle_hz, FlameInput::kVelocity);
  const PointStructure structure = FreeStructure(2);
  const PointPrior prior = PriorOf(structure, record);
  RandomStream random(1);
  int found = 0;
  int none = 0;
  for (int i = 0; i < 400; ++i) {
    PointFit fit;
    fit.parameters = prior.mean;
    for (Eigen::Index k = 0; k < fit.parameters.size(); ++k) {
      fit.parameters[k] += random.Normal() * prior.deviation[k];
    }
    fit.information = 1e8 * Eigen::MatrixXd::Identity(prior.mean.size(), prior.mean.size());
    const SmallSignalLoop small = SmallSignalLoopOf(record, structure, fit);
    if (!small.found) {
      ++none;
      continue;
    }
    ++found;
    EXPECT_GE(small.frequency_hz.value, cycle_hz / std::numbers::sqrt2) << i;
    EXPECT_LE(small.frequency_hz.value, cycle_hz * std::numbers::sqrt2) << i;
  }
  EXPECT_GT(found, 20);
  EXPECT_GT(none, 20);
}

}  // namespace
}  // namespace howl::small_signal_loop_test
