#include "diagnosis/search/bootstrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/fitted_rig.h"
#include "model/effects/catalogue.h"
#include "model/loop/instrument.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::bootstrap_test {
namespace {

double Rms(const Eigen::VectorXd& x) { return x.norm() / std::sqrt(static_cast<double>(x.size())); }

// The rig that was recorded has parameters, a flame and noise that are known: what is simulated
// from its fit has them again.
TEST(FittedRig, IsTheRigThatWasFitted) {
  const std::vector<DiagnosisExperiment> rig = SimulateRig();
  const std::vector<CutRecord> records = MakeCutRecords(rig);
  const EffectFit base = FitBase(records);
  const std::vector<CutRecord> again = MakeCutRecords(Replicate(records, base, rig, 50));
  const EffectFit refitted = FitBase(again);
  EXPECT_NEAR(refitted.tau_s, 0.00352, 2e-5);
  for (std::size_t e = 0; e < records.size(); ++e) {
    const RigParameters truth = TestRig(static_cast<int>(e));
    const Acoustics<double> acoustics = ToAcoustics({}, refitted.experiments[e].acoustics);
    EXPECT_NEAR(acoustics.omega_hz / truth.model.loop.acoustics.omega_hz, 1.0, 0.01);
    EXPECT_NEAR(acoustics.xi / truth.model.loop.acoustics.xi, 1.0, 0.1);
    EXPECT_NEAR(Rms(again[e].pressure) / Rms(records[e].pressure), 1.0, 0.03);
    EXPECT_NEAR(Rms(again[e].heat_release) / Rms(records[e].heat_release), 1.0, 0.03);
    EXPECT_NEAR(again[e].at.cycle_frequency_hz, records[e].at.cycle_frequency_hz, 1.0);
    // Noise, over the band: each is a mean of hundreds of bins.
    const double flame =
        refitted.experiments[e].flame_noise.mean() / base.experiments[e].flame_noise.mean();
    EXPECT_NEAR(flame, 1.0, 0.12);
    const double acoustic =
        refitted.experiments[e].acoustic_noise.mean() / base.experiments[e].acoustic_noise.mean();
    EXPECT_NEAR(acoustic, 1.0, 0.12);
    // The flame at half its range, against the rig's own.
    const double v = 0.5 * refitted.experiments[e].flame_range;
    const FlameBasis basis(refitted.experiments[e].flame_range);
    const Eigen::VectorXd& c = refitted.experiments[e].flame;
    const double rise = basis.At(v, c) - basis.At(-v, c);
    const Flame<double>& flame_of_rig = truth.model.flame;
    EXPECT_NEAR(rise / (FlameResponse(flame_of_rig, v) - FlameResponse(flame_of_rig, -v)), 1.0,
                0.05);
  }
}

TEST(FittedRig, DrawsOtherNoiseFromAnotherSeed) {
  const std::vector<CutRecord> records = MakeCutRecords(SimulatePoints(
      1, [](RigParameters*) {}, 3));
  const EffectFit base = FitBase(records);
  const SimulationOptions how = FittedRigOptions(records[0]);
  const SimulatedRecord one = Simulate(FittedRig(records[0], base, 0, 1), how);
  EXPECT_EQ(one.pressure, Simulate(FittedRig(records[0], base, 0, 1), how).pressure);
  EXPECT_NE(one.pressure, Simulate(FittedRig(records[0], base, 0, 2), how).pressure);
}

TEST(Bootstrap, PValueAndThresholdCountReplicates) {
  std::vector<double> gains(19);
  for (std::size_t i = 0; i < gains.size(); ++i) gains[i] = static_cast<double>(i);
  EXPECT_DOUBLE_EQ(BootstrapPValue(gains, 100.0), 0.05);
  EXPECT_DOUBLE_EQ(BootstrapPValue(gains, 17.5), 0.1);
  EXPECT_DOUBLE_EQ(BootstrapPValue(gains, -1.0), 1.0);
  EXPECT_DOUBLE_EQ(BootstrapDetectionGain(gains), 18.0);
  gains.resize(99);
  for (std::size_t i = 0; i < gains.size(); ++i) gains[i] = static_cast<double>(i);
  EXPECT_DOUBLE_EQ(BootstrapDetectionGain(gains), 94.0);  // four of 99 are above
}

DiagnosisOptions Few(std::size_t replicates) {
  DiagnosisOptions options;
  options.bootstrap = replicates;
  options.withheld = AllBut({"delay_varies_with_phi", "q_sensor_lowpass"});
  return options;
}

TEST(LongBootstrap, NoiseAloneGainsLittleAndAnEffectMuch) {
  const Diagnosis null = Diagnose(SimulateRig(), Few(3));
  ASSERT_EQ(null.bootstrap_gains.size(), 3u);
  EXPECT_TRUE(std::is_sorted(null.bootstrap_gains.begin(), null.bootstrap_gains.end()));
  EXPECT_LT(null.bootstrap_gains.back(), 8.0);
  EXPECT_EQ(null.kind, VerdictKind::kNone);
  const Diagnosis slow = Diagnose(
      SimulateRig({std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 700.0)}), Few(3));
  EXPECT_LT(slow.bootstrap_gains.back(), 8.0);
  EXPECT_EQ(slow.effect, "q_sensor_lowpass");
  EXPECT_DOUBLE_EQ(slow.candidates[0].p_value, 0.25);
}

TEST(LongBootstrap, IsTheSameForAllNumbersOfThreadsAndAnotherForAnotherSeed) {
  const std::vector<DiagnosisExperiment> rig = SimulateRig();
  DiagnosisOptions options = Few(2);
  options.threads = 1;
  const std::vector<double> one = Diagnose(rig, options).bootstrap_gains;
  options.threads = 2;
  EXPECT_EQ(one, Diagnose(rig, options).bootstrap_gains);
  options.seed = 2;
  EXPECT_NE(one, Diagnose(rig, options).bootstrap_gains);
}

TEST(LongBootstrap, OneCandidatesGainOfNoiseIsSmallAndTheSameForAllNumbersOfThreads) {
  const std::vector<DiagnosisExperiment> rig = SimulateRig();
  const std::vector<CutRecord> records = MakeCutRecords(rig);
  const EffectFit base = FitBase(records);
  std::vector<EffectPointer> forms;
  for (const EffectPointer& effect : Catalogue()) {
    if (effect->id() == "delay_varies_with_phi") forms.push_back(effect);
  }
  DiagnosisOptions options;
  options.threads = 1;
  const double one = GainOfNoise(records, base, rig, forms, options);
  EXPECT_LT(one, 16.0);  // the usual threshold in cut B stands
  EXPECT_GT(one, -4.0);  // a parameter costs 3.1, and noise never gains less than nothing
  options.threads = 2;
  EXPECT_EQ(one, GainOfNoise(records, base, rig, forms, options));
}

class Kept final : public FitUnits {
 public:
  std::optional<std::string> Recall(const std::string& key) override {
    const std::lock_guard<std::mutex> lock(lock_);
    const auto found = all_.find(key);
    if (found == all_.end()) return std::nullopt;
    return found->second;
  }
  void Keep(const std::string& key, const std::string& bytes) override {
    const std::lock_guard<std::mutex> lock(lock_);
    EXPECT_TRUE(all_.emplace(key, bytes).second) << key;
  }
  std::map<std::string, std::string> all_;

 private:
  std::mutex lock_;
};

TEST(LongBootstrap, GoesOnWhereItWasStopped) {
  const std::vector<DiagnosisExperiment> rig = SimulateRig();
  DiagnosisOptions options = Few(3);
  options.threads = 1;
  const std::vector<double> whole = Diagnose(rig, options).bootstrap_gains;
  Kept kept;
  options.memory = &kept;
  bool enough = false;
  options.bootstrap_progress = [&](std::size_t done, std::size_t) { enough = done == 2; };
  options.stopped = [&] { return enough; };
  EXPECT_TRUE(Diagnose(rig, options).stopped);
  EXPECT_EQ(std::count_if(kept.all_.begin(), kept.all_.end(),
                          [](const auto& entry) { return entry.first.starts_with("bootstrap"); }),
            2);
  options.stopped = nullptr;
  std::size_t done = 0;
  options.bootstrap_progress = [&](std::size_t now, std::size_t) { done = now; };
  EXPECT_EQ(Diagnose(rig, options).bootstrap_gains, whole);
  EXPECT_EQ(done, 3u);
}

TEST(FitMemory, AKeyThatComesTwiceIsAProgrammersMistake) {
  UniqueKeys keys("kept");
  keys.Take("no_meaning.0#0");
  keys.Take("no_meaning.1#0");
  EXPECT_DEATH(keys.Take("no_meaning.0#0"), "no_meaning.0#0 is kept twice");
}

}  // namespace
}  // namespace howl::bootstrap_test
