// What analyse and fit print of one half of a measured record, and of the other half: the two are
// estimates of the same rig minutes apart at most, and have to agree within their 95 % intervals.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "estimation/analysis/analyse.h"
#include "estimation/fit/joint_fit.h"
#include "model/numerics/units.h"
#include "tests/estimation/analysis/measured_data.h"

namespace howl::halves_test {
namespace {

struct Agreement {
  int count = 0;
  int within = 0;
  std::string beyond;

  void Add(const std::string& name, const Estimate& a, const Estimate& b, double period = 0.0) {
    if (!std::isfinite(a.std) || !std::isfinite(b.std)) return;
    double difference = a.value - b.value;
    if (period > 0.0) difference = std::remainder(difference, period);
    ++count;
    if (std::abs(difference) <= kNormal95 * std::hypot(a.std, b.std)) {
      ++within;
    } else {
      beyond += " " + name;
    }
  }
};

Estimate RatioOfModes(const TransferFit& fit) {
  const Eigen::Matrix4d& c = fit.log_covariance;
  const double ratio = fit.M.value / fit.N.value;
  return {ratio, ratio * std::sqrt(std::max(c(2, 2) + c(3, 3) - 2.0 * c(2, 3), 0.0))};
}

void AddCycle(const Analysis& a, const Analysis& b, Agreement* agreement) {
  const Characteristics& x = a.characteristics;
  const Characteristics& y = b.characteristics;
  if (x.state == CycleState::kNoLimitCycle || y.state == CycleState::kNoLimitCycle) return;
  agreement->Add(a.name + ".frequency", x.frequency_hz, y.frequency_hz);
  if (!a.has_heat_release) return;
  agreement->Add(a.name + ".phase", x.phase_deg, y.phase_deg, 360.0);
  agreement->Add(a.name + ".gain", x.gain, y.gain);
  agreement->Add(a.name + ".tau", *a.tau_s, *b.tau_s);
  agreement->Add(a.name + ".slope", a.flame_curve->slope, b.flame_curve->slope);
  agreement->Add(a.name + ".loop_gain", *a.loop_gain, *b.loop_gain);
}

// The four strongest, as printed, where both halves have the line.
void AddLines(const Analysis& a, const Analysis& b, Agreement* agreement) {
  for (std::size_t i = 0; i < std::min<std::size_t>(a.lines.size(), 4); ++i) {
    const SpectralLine& line = a.lines[i];
    for (const SpectralLine& other : b.lines) {
      const double near = std::max({line.width_hz, other.width_hz, 0.02 * line.frequency_hz.value});
      if (line.harmonic != other.harmonic || line.narrow != other.narrow ||
          std::abs(line.frequency_hz.value - other.frequency_hz.value) > near) {
        continue;
      }
      agreement->Add(a.name + ".line", line.frequency_hz, other.frequency_hz);
      break;
    }
  }
}

void AddTransfer(const Analysis& a, const Analysis& b, Agreement* agreement) {
  if (!a.transfer_fit || !b.transfer_fit) return;
  agreement->Add(a.name + ".omega", a.transfer_fit->omega_hz, b.transfer_fit->omega_hz);
  agreement->Add(a.name + ".xi", a.transfer_fit->xi, b.transfer_fit->xi);
  agreement->Add(a.name + ".N", a.transfer_fit->N, b.transfer_fit->N);
  agreement->Add(a.name + ".M/N", RatioOfModes(*a.transfer_fit), RatioOfModes(*b.transfer_fit));
}

Record Half(const Record& record, int which) {
  const auto middle = static_cast<std::ptrdiff_t>(record.pressure.size() / 2);
  const auto part = [&](const std::vector<double>& x) {
    if (x.empty()) return x;
    return which == 0 ? std::vector<double>(x.begin(), x.begin() + middle)
                      : std::vector<double>(x.begin() + middle, x.end());
  };
  return {record.sampling_hz, part(record.pressure), part(record.heat_release)};
}

ModelSpec TwoModes() {
  ModelSpec model = DefaultModelSpec();
  model.modes = 2;
  return model;
}

std::vector<AnalysisSet> AnalyseHalves(const std::vector<NamedRecord>& records) {
  AnalysisOptions options;
  options.model = TwoModes();
  std::vector<AnalysisSet> sets;
  for (int which : {0, 1}) {
    std::vector<NamedRecord> half;
    for (const NamedRecord& each : records) {
      half.push_back({each.name, each.phi, Half(each.record, which)});
    }
    sets.push_back(AnalyseRecords(half, options));
  }
  return sets;
}

Agreement HalvesAgree(const std::vector<NamedRecord>& records) {
  const std::vector<AnalysisSet> sets = AnalyseHalves(records);
  Agreement agreement;
  for (std::size_t i = 0; i < records.size(); ++i) {
    AddCycle(sets[0].analyses[i], sets[1].analyses[i], &agreement);
    AddLines(sets[0].analyses[i], sets[1].analyses[i], &agreement);
    AddTransfer(sets[0].analyses[i], sets[1].analyses[i], &agreement);
  }
  return agreement;
}

// The experiments that both halves show in a limit cycle, fitted together as `fit` does.
Agreement FitsOfHalvesAgree(const std::vector<NamedRecord>& records) {
  const std::vector<AnalysisSet> sets = AnalyseHalves(records);
  std::vector<Experiment> halves[2];
  for (std::size_t i = 0; i < records.size(); ++i) {
    std::optional<Experiment> one = ToExperiment(sets[0].analyses[i]);
    std::optional<Experiment> other = ToExperiment(sets[1].analyses[i]);
    if (!one || !other) continue;
    one->delay_periods = sets[0].delay.branch;
    other->delay_periods = sets[1].delay.branch;
    halves[0].push_back(*std::move(one));
    halves[1].push_back(*std::move(other));
  }
  JointFit fits[2];
  for (int which : {0, 1}) {
    fits[which] =
        SolveJoint(JointProblem(halves[which], TwoModes(), DefaultResidualSet()), {}, 1, 1);
    EXPECT_TRUE(fits[which].converged) << fits[which].termination;
  }
  Agreement agreement;
  EXPECT_EQ(fits[0].parameters.size(), fits[1].parameters.size());
  for (std::size_t k = 0; k < fits[0].parameters.size(); ++k) {
    const FitParameter& a = fits[0].parameters[k];
    const FitParameter& b = fits[1].parameters[k];
    EXPECT_EQ(a.name, b.name);
    if (a.fixed) continue;
    agreement.Add(a.name, {std::log(a.value), a.std_relative}, {std::log(b.value), b.std_relative});
  }
  return agreement;
}

std::vector<NamedRecord> CombustorRecords(const std::string& folder) {
  std::vector<NamedRecord> records;
  for (const int point : {1, 5, 8, 9, 11, 12, 14, 15, 17, 19, 21, 22, 24}) {
    records.push_back(
        {"p" + std::to_string(point), 1.0 * point, fixtures::CombustorRecord(folder, point)});
  }
  return records;
}

TEST(Halves, FitsOfTheCombustorsRecordsAgreeWithinTheirIntervals) {
  const auto folder = fixtures::DataFolder("HOWL_DATA");
  if (!folder) GTEST_SKIP() << "HOWL_DATA is not set";
  const Agreement agreement = FitsOfHalvesAgree(CombustorRecords(*folder));
  EXPECT_GT(agreement.count, 30);
  EXPECT_GE(agreement.within, 0.9 * agreement.count)
      << "of " << agreement.count << "; beyond:" << agreement.beyond;
}

TEST(Halves, OfTheCombustorsRecordsAgreeWithinTheirIntervals) {
  const auto folder = fixtures::DataFolder("HOWL_DATA");
  if (!folder) GTEST_SKIP() << "HOWL_DATA is not set";
  const Agreement agreement = HalvesAgree(CombustorRecords(*folder));
  EXPECT_GT(agreement.count, 120);
  EXPECT_GE(agreement.within, 0.9 * agreement.count)
      << "of " << agreement.count << "; beyond:" << agreement.beyond;
}

TEST(Halves, OfTheRijkeTubesSteadyRecordsAgreeWithinTheirIntervals) {
  const auto folder = fixtures::DataFolder("HOWL_DATA");
  if (!folder) GTEST_SKIP() << "HOWL_DATA is not set";
  std::vector<NamedRecord> records;
  for (const int volts : {2, 13, 15, 17, 19}) {
    const std::string name = "quasi_static/" + std::to_string(volts);
    records.push_back({name, 1.0 * volts, fixtures::RijkeRecord(*folder, name)});
  }
  const Agreement agreement = HalvesAgree(records);
  EXPECT_GT(agreement.count, 10);
  EXPECT_GE(agreement.within, 0.9 * agreement.count)
      << "of " << agreement.count << "; beyond:" << agreement.beyond;
}

}  // namespace
}  // namespace howl::halves_test
