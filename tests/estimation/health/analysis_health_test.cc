// Each mistake, made in right records, is named; right records are not accused. States that are no
// steady cycle say which number failed.
#include "estimation/health/analysis_health.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/estimation/analysis/measured_data.h"
#include "tests/estimation/health/right_rig.h"

namespace howl::analysis_health_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

AnalysisOptions OneMode() {
  AnalysisOptions options;
  options.model = DefaultModelSpec();
  return options;
}

Health Check(const std::vector<NamedRecord>& records, const AnalysisOptions& options = OneMode()) {
  return CheckAnalysis(records, AnalyseRecords(records, options), options);
}

std::string Texts(const Health& health) {
  std::string text;
  for (const Finding& finding : health) text += finding.text + "\n";
  return text;
}

bool IsAccusation(const Finding& finding) {
  return finding.kind == FindingKind::kMistake || finding.kind == FindingKind::kSampling;
}

TEST(AnalysisHealth, RightRecordsAreNotAccused) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Health health = Check(RightRecords(seed));
    EXPECT_THAT(health, IsEmpty()) << Texts(health);
  }
}

TEST(AnalysisHealth, AnInvertedTransducerIsNamed) {
  for (const bool invert_pressure : {true, false}) {
    std::vector<NamedRecord> records = RightRecords(1);
    for (NamedRecord& each : records) {
      for (double& x : invert_pressure ? each.record.pressure : each.record.heat_release) x = -x;
    }
    const Health health = Check(records);
    EXPECT_THAT(health, Contains(AllOf(Field(&Finding::subject, "inverted"),
                                       Field(&Finding::experiment, ""))))
        << Texts(health);
  }
}

TEST(AnalysisHealth, OneInvertedRecordIsNamed) {
  std::vector<NamedRecord> records = RightRecords(2);
  for (double& x : records[3].record.pressure) x = -x;
  const Health health = Check(records);
  EXPECT_THAT(health, Contains(AllOf(Field(&Finding::subject, "inverted"),
                                     Field(&Finding::experiment, "exp4"))))
      << Texts(health);
  EXPECT_EQ(std::ranges::count_if(health, IsAccusation), 1) << Texts(health);
}

TEST(AnalysisHealth, ChannelsTakenForEachOtherAreNamed) {
  std::vector<NamedRecord> records = RightRecords(3);
  for (NamedRecord& each : records) std::swap(each.record.pressure, each.record.heat_release);
  const Health health = Check(records);
  EXPECT_THAT(health, Contains(AllOf(Field(&Finding::subject, "p_and_q_swapped"),
                                     Field(&Finding::experiment, ""))))
      << Texts(health);
}

// What a mode of its own at 500 Hz adds to p for this q: a resonance of two poles.
std::vector<double> OfASecondMode(const Record& record, double share) {
  const double radius = 0.98;
  const double turn = 2.0 * std::numbers::pi * 500.0 / record.sampling_hz;
  std::vector<double> sum = record.pressure;
  double last = 0.0;
  double before = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const double next =
        record.heat_release[i] + 2.0 * radius * std::cos(turn) * last - radius * radius * before;
    before = last;
    last = next;
    sum[i] += share * (last - before);
  }
  return sum;
}

TEST(AnalysisHealth, AModelThatIsPoorerThanTheRigIsSaidToMissTheTransfer) {
  std::vector<NamedRecord> records = RightRecords(1);
  for (NamedRecord& each : records) each.record.pressure = OfASecondMode(each.record, 5.0);
  const AnalysisSet set = AnalyseRecords(records, OneMode());
  const Health health = CheckAnalysis(records, set, OneMode());
  const auto found = std::ranges::find(health, "transfer", &Finding::subject);
  ASSERT_NE(found, health.end()) << Texts(health);
  double worst = 0.0;
  for (const Analysis& each : set.analyses) {
    worst = std::max(worst, each.transfer_fit->chi_square_per_dof);
  }
  EXPECT_EQ(found->value, worst);
  EXPECT_THAT(found->text, HasSubstr("are not those of one mode: chi2/dof"));
}

TEST(AnalysisHealth, ATimeColumnInMillisecondsIsNamed) {
  std::vector<NamedRecord> records = RightRecords(1);
  records.resize(1);
  const double right_hz = records[0].record.sampling_hz;
  records[0].record.sampling_hz = right_hz / 1000.0;
  const AnalysisSet set = AnalyseRecords(records, OneMode());
  const RateSource times = RateSource::kTimeColumn;
  const Health health = CheckAnalysis(records, set, OneMode(), {&times, 1});
  ASSERT_THAT(health, Contains(Field(&Finding::kind, FindingKind::kSampling))) << Texts(health);
  const auto found = std::ranges::find(health, FindingKind::kSampling, &Finding::kind);
  EXPECT_NEAR(found->limit, right_hz, 1e-6);
  EXPECT_THAT(found->text, HasSubstr("the time column steps by 0.2: if it is in milliseconds"));
  EXPECT_THAT(found->text, HasSubstr("has a cycle at 216"));
}

TEST(AnalysisHealth, ARateInKilohertzIsNamed) {
  std::vector<NamedRecord> records = RightRecords(2);
  records[1].record.sampling_hz /= 1000.0;
  const Health health = Check(records);
  EXPECT_EQ(std::ranges::count_if(health, IsAccusation), 1) << Texts(health);
  EXPECT_THAT(health, Contains(AllOf(Field(&Finding::kind, FindingKind::kSampling),
                                     Field(&Finding::experiment, "exp2"),
                                     Field(&Finding::text, HasSubstr("sampling_hz is 5: if it is "
                                                                     "in kHz")))));
}

TEST(AnalysisHealth, ASlowRigIsNotAccused) {
  // The same cycle a hundred times slower, looked for where it is.
  std::vector<NamedRecord> records = RightRecords(3);
  for (NamedRecord& each : records) each.record.sampling_hz /= 100.0;
  AnalysisOptions options = OneMode();
  options.characteristics.min_frequency_hz = 0.2;
  options.transfer.min_frequency_hz = 0.2;
  options.lines.min_frequency_hz = 0.05;
  const Health health = Check(records, options);
  EXPECT_EQ(std::ranges::count_if(health, IsAccusation), 0) << Texts(health);
}

TEST(AnalysisHealth, ACycleBelowOneHertzIsSuspected) {
  // Searched as low as it takes, the record in milliseconds has its cycle at 0.2 Hz.
  std::vector<NamedRecord> records = RightRecords(2);
  for (NamedRecord& each : records) each.record.sampling_hz /= 1000.0;
  AnalysisOptions options = OneMode();
  options.characteristics.min_frequency_hz = 0.02;
  options.transfer.min_frequency_hz = 0.02;
  options.lines.min_frequency_hz = 0.005;
  const Health health = Check(records, options);
  EXPECT_EQ(std::ranges::count(health, FindingKind::kSampling, &Finding::kind), kRightPoints)
      << Texts(health);
  EXPECT_THAT(Texts(health), ContainsRegex("has a cycle at 216.[0-9] Hz, not at 0.216[0-9] Hz"));
}

TEST(AnalysisHealth, NoLimitCycleSaysWhatFailed) {
  // Noise excites a loop at three fifths of the gain that it takes to oscillate: its squared
  // amplitude varies by about its squared mean.
  const std::vector<NamedRecord> records = RightRecords(1, 0.6);
  const Health health = Check(records);
  EXPECT_EQ(std::ranges::count_if(health, IsAccusation), 0) << Texts(health);
  for (const NamedRecord& record : records) {
    const auto found = std::ranges::find(health, record.name, &Finding::experiment);
    ASSERT_NE(found, health.end()) << record.name;
    EXPECT_EQ(found->kind, FindingKind::kState);
    EXPECT_EQ(found->subject, "power_fluctuation") << found->text;
    EXPECT_GT(found->value, found->limit);
  }
}

TEST(AnalysisHealth, WhiteNoiseHasNoPeak) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  NamedRecord record{"noise", 0.5, {5000.0, {}, {}}};
  for (int i = 0; i < 16000; ++i) record.record.pressure.push_back(normal(random));
  const Health health = Check({record});
  ASSERT_EQ(health.size(), 1U) << Texts(health);
  EXPECT_EQ(health[0].subject, "peak_over_floor");
  EXPECT_LE(health[0].value, health[0].limit);
  EXPECT_THAT(health[0].text, HasSubstr("times over its floor"));
}

TEST(AnalysisHealth, ADriftingCycleSaysHowFar) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  NamedRecord record{"drift", 0.5, {5000.0, {}, {}}};
  // The amplitude grows from 1 to 1.5: by 40 % of its mean.
  for (int i = 0; i < 16000; ++i) {
    const double t = i / 5000.0;
    const double envelope = 1.0 + 0.5 * i / 16000.0;
    record.record.pressure.push_back(envelope * std::sin(2.0 * M_PI * 210.0 * t) +
                                     0.05 * normal(random));
  }
  const Health health = Check({record});
  ASSERT_EQ(health.size(), 1U) << Texts(health);
  EXPECT_EQ(health[0].subject, "amplitude");
  EXPECT_NEAR(health[0].value, 0.4, 0.05);
  EXPECT_THAT(health[0].text, HasSubstr("not stationary"));
}

TEST(AnalysisHealth, MeasuredRecordsAreNotAccused) {
  const auto folder = fixtures::DataFolder("HOWL_DATA");
  if (!folder) GTEST_SKIP() << "HOWL_DATA is not set";
  std::vector<NamedRecord> records;
  for (const int point : {1, 5, 8, 9, 11, 12, 14, 15, 17, 19, 21, 22, 24}) {
    records.push_back({"p" + std::to_string(point), static_cast<double>(point),
                       fixtures::CombustorRecord(*folder, point)});
  }
  for (const int modes : {1, 2}) {
    AnalysisOptions options = OneMode();
    options.model->modes = modes;
    const Health health = Check(records, options);
    EXPECT_EQ(std::ranges::count_if(health, IsAccusation), 0) << Texts(health);
  }
  // The heated tube: pressure alone, some records without a cycle.
  std::vector<NamedRecord> tube;
  for (const char* name : {"ramps/13", "quasi_static/2", "quasi_static/15"}) {
    tube.push_back({name, 0.0, fixtures::RijkeRecord(*folder, name)});
  }
  const Health health = Check(tube);
  EXPECT_EQ(std::ranges::count_if(health, IsAccusation), 0) << Texts(health);
}

}  // namespace
}  // namespace howl::analysis_health_test
