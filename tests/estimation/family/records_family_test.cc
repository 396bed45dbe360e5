// From a simulated rig's records to its family: the rig itself must be a member, whatever its
// modes. Truth is the rig; the simulator is model/simulation/simulate.h, which shares no estimate
// with analysis.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "estimation/analysis/analyse.h"
#include "estimation/analysis/loop/closed_form.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "estimation/family/bounds/enclose.h"
#include "estimation/family/bounds/feasible.h"
#include "estimation/unit_seed.h"
#include "model/cycles/floquet.h"
#include "model/cycles/harmonic_balance.h"
#include "model/simulation/simulate.h"
#include "tests/r228.h"

namespace howl::records_family_test {
namespace {

ModelSpec Modes(int modes) {
  ModelSpec model = DefaultModelSpec();
  model.modes = modes;
  model[ParameterKind::kM].scope = ParameterScope::kExperiment;
  return model;
}

// R228 with light damping at low phi; a second mode at 0.4 of the first where there is one.
Member Rig(int modes) {
  constexpr double kXi[] = {0.15, 0.11, 0.093, 0.076, 0.062, 0.026};
  Member rig;
  const std::vector<Experiment> experiments = R228();
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    rig.push_back(ClosedFormMember(experiments[i], kXi[i]));
    if (modes == 2) rig.back().M = 0.4 * rig.back().N;
  }
  return rig;
}

// Noise of the sensors, relative to the cycle's amplitudes.
struct SensorNoise {
  double pressure, heat_release;
};

// The records' experiments as fit and family take them. As howl simulate does: slopes that give
// less than a loop gain of 1.1 are raised to it, and combustion noise is 1 % of saturation.
std::vector<Experiment> Recorded(const Member& rig, const ModelSpec& model,
                                 const SensorNoise& sensors, std::uint64_t seed,
                                 int* delay_periods) {
  const std::vector<Experiment> published = R228();
  std::vector<SimulationCase> cases;
  for (std::size_t i = 0; i < rig.size(); ++i) {
    const LoopParameters<double> loop = rig[i].Loop();
    const double f = published[i].frequency_hz;
    const double response = Magnitude(LoopResponse(loop, f));
    const double gain = std::max(response * std::abs(*published[i].flame_slope), 1.1);
    RigParameters one;
    one.model = {loop, {FlameShape::kTanh, -gain / response, 1.0, 0.0}};
    one.noise.combustion_corner_hz = 500.0;
    one.noise.combustion_density = 2.0 * 1e-4 / (std::numbers::pi * 500.0);
    const std::vector<LimitCycle> cycles = LimitCycles(one.model, 2.0 * f);
    EXPECT_FALSE(cycles.empty());
    const LimitCycle& cycle = *std::ranges::min_element(
        cycles, {}, [&](const LimitCycle& c) { return std::abs(c.frequency_hz - f); });
    one.past = PastOnCycle(cycle);
    one.noise.pressure_sensor_std = sensors.pressure * cycle.pressure_amplitude();
    one.noise.heat_release_sensor_std = sensors.heat_release * cycle.heat_release_amplitude();
    cases.push_back({one, UnitSeed(seed, published[i].name)});
  }
  const std::vector<SimulatedRecord> simulated =
      SimulateBatch(cases, {.duration_s = 3.2, .sampling_hz = 5000.0, .settle_s = 1.0});
  std::vector<NamedRecord> records;
  for (std::size_t i = 0; i < simulated.size(); ++i) {
    records.push_back({published[i].name, published[i].phi, ToRecord(simulated[i])});
  }
  const AnalysisSet set = AnalyseRecords(records, {.model = model});
  *delay_periods = set.delay.branch;
  std::vector<Experiment> experiments;
  for (const Analysis& analysis : set.analyses) {
    const std::optional<Experiment> experiment = ToExperiment(analysis);
    EXPECT_TRUE(experiment.has_value()) << analysis.name;
    if (experiment) experiments.push_back(*experiment);
  }
  return experiments;
}

FamilyProblem Recorded(int modes, const SensorNoise& sensors, std::uint64_t seed) {
  FamilyProblem problem;
  problem.model = Modes(modes);
  problem.experiments =
      Recorded(Rig(modes), problem.model, sensors, seed, &problem.domain.delay_periods);
  return problem;
}

class RecordsFamilyTest : public testing::TestWithParam<int> {};

// The squared distance of the truth from each record's transfer is chi-square with three or four
// degrees of freedom: of that mean, and beyond the test's limit once in 300.
TEST_P(RecordsFamilyTest, TheRigIsAMemberWhateverTheSeedAndTheSensorsNoise) {
  const int modes = GetParam();
  constexpr int kSeeds = 6;
  const Member rig = Rig(modes);
  for (const SensorNoise& sensors : {SensorNoise{1e-3, 1e-3}, SensorNoise{1e-3, 0.0},
                                     SensorNoise{0.0, 1e-3}, SensorNoise{1e-3, 1e-2}}) {
    double mean_square = 0.0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const FamilyProblem problem = Recorded(modes, sensors, seed);
      ASSERT_EQ(problem.experiments.size(), rig.size());
      const ConditionSet failed = Falsify(problem.experiments, rig, problem.test);
      for (const Condition condition : kConditions) {
        EXPECT_FALSE(failed.Contains(condition)) << ConditionName(condition) << " at seed " << seed
                                                 << ", noise of q " << sensors.heat_release;
      }
      EXPECT_TRUE(FindMember(problem).has_value()) << seed;
      for (std::size_t i = 0; i < rig.size(); ++i) {
        const double distance =
            MahalanobisDistance(*problem.experiments[i].transfer_ellipsoid, rig[i]);
        mean_square += distance * distance;
        ++count;
      }
    }
    mean_square /= count;
    const double freedom = modes == 2 ? 4.0 : 3.0;
    // Above by no more than four standard errors; far below only where what is not known of q's
    // noise is all the doubt there is.
    EXPECT_LT(mean_square, freedom + 4.0 * std::sqrt(2.0 * freedom / count))
        << "noise of q " << sensors.heat_release;
  }
}

TEST_P(RecordsFamilyTest, BoundsHoldTheRig) {
  const int modes = GetParam();
  FamilyProblem problem = Recorded(modes, {1e-3, 1e-3}, 1);
  Member rig = Rig(modes);
  if (modes == 2) {
    problem.experiments.resize(2);
    rig.resize(2);
  }
  Enclosure enclosure(problem, {.max_cells = 20, .threads = 2});
  enclosure.Run();
  EXPECT_FALSE(enclosure.IsProvedEmpty());
  for (std::size_t i = 0; i < rig.size(); ++i) {
    for (const FamilyParameter parameter : kFamilyParameters) {
      if (!enclosure.IsBounded(i, parameter)) continue;
      const Range outer = enclosure.Bound(i, parameter).outer;
      const double value = ParameterValue(problem.experiments[i], rig[i], parameter);
      EXPECT_LE(outer.lo, value) << i << " " << FamilyParameterName(parameter);
      EXPECT_GE(outer.hi, value) << i << " " << FamilyParameterName(parameter);
    }
  }
}

std::string NumberOfModes(const testing::TestParamInfo<int>& one) {
  return std::to_string(one.param);
}

INSTANTIATE_TEST_SUITE_P(Modes, RecordsFamilyTest, testing::Values(1), NumberOfModes);
INSTANTIATE_TEST_SUITE_P(LongModes, RecordsFamilyTest, testing::Values(2), NumberOfModes);

}  // namespace
}  // namespace howl::records_family_test
