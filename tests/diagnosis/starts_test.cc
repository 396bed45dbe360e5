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
  std::vector<SimulationCase> cases;
  for (int point = 0; point < 3; ++point) {
    SimulationCase one;
    one.rig = TestRig(point);
    const auto& acoustics = one.rig.model.loop.acoustics;
    one.rig.extra_modes = {{ratio * acoustics.omega_hz, xi, share * acoustics.N}};
    one.rig.past = {{0.1, 205.0, 0.0, 0.0}};
    one.seed = 31 + static_cast<std::uint64_t>(point);
    cases.push_back(std::move(one));
  }
  SimulationOptions options;
  options.duration_s = 3.2;
  options.settle_s = 0.5;
  std::vector<DiagnosisExperiment> out;
  for (const SimulatedRecord& record : SimulateBatch(cases, options)) {
    out.push_back({"exp" + std::to_string(out.size() + 1),
                   0.55 - 0.03 * static_cast<double>(out.size()),
                   {record.sampling_hz, record.pressure, record.heat_release}});
  }
  return out;
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
