// Fits that find their way to weak modes far from any start.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "diagnosis/effect_fit.h"
#include "model/effects/catalogue.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl {
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

}  // namespace
}  // namespace howl
