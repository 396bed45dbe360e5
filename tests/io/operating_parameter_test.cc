// An operating parameter with a name of its own stands in CSV files under `phi`, where scripts look
// for it, and under its own name, in the last column.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/report/csv_table.h"
#include "io/report/family_members.h"
#include "io/results/analysis_files.h"
#include "io/results/family/family_csv.h"
#include "tests/io/record_files.h"

namespace howl::operating_parameter_test {
namespace {

AnalysisSet OnePoint() {
  AnalysisSet set;
  Analysis& analysis = set.analyses.emplace_back();
  analysis.name = "p1";
  analysis.phi = 461.0;
  analysis.lines.emplace_back();
  analysis.transfer.emplace().points.emplace_back();
  analysis.flame_curve.emplace().bins.emplace_back();
  return set;
}

TEST(OperatingParameter, EveryTableOfAnAnalysisHasItsOwnName) {
  const TemporaryFolder folder;
  for (const auto& write : {CharacteristicsCsv, LinesCsv, TransferCsv, FlameCurveCsv}) {
    const std::string plain = write(OnePoint(), "phi");
    const std::string own = write(OnePoint(), "air_slpm");
    EXPECT_THAT(own, testing::StartsWith(plain.substr(0, plain.find('\n')) + ",air_slpm\n"));
    const CsvTable table = ReadCsvTable(folder.Write("own.csv", own));
    ASSERT_EQ(table.rows.size(), 1U);
    EXPECT_EQ(table.Number(0, "phi"), 461.0);
    EXPECT_EQ(table.Number(0, "air_slpm"), 461.0);
    EXPECT_EQ(ReadCsvTable(folder.Write("plain.csv", plain)).Find("air_slpm"), std::nullopt);
  }
}

TEST(OperatingParameter, AFamilyIsReadWithAndWithoutIt) {
  const TemporaryFolder folder;
  const std::vector<Experiment> experiments = {
      {.name = "p1", .phi = 461.0, .frequency_hz = 90.0, .phase_deg = -5.0, .gain = 10.0},
      {.name = "p2", .phi = 509.0, .frequency_hz = 95.0, .phase_deg = -9.0, .gain = 11.0}};
  const LoopModel model{.omega_hz = 88.0, .xi = 0.1, .N = 900.0, .M = 0.0, .tau_s = 0.008};
  const std::vector<std::vector<LoopModel>> members = {{model, model}, {model, model}};
  for (const char* name : {"phi", "air_slpm"}) {
    const auto path = folder.Write("family.csv", FamilyCsv(experiments, members, name));
    const FamilyTable table = ReadFamilyCsv(path);
    ASSERT_EQ(table.rows.size(), 2U);
    EXPECT_EQ(table.rows[1][table.Column("p2.phi")], 509.0);
    EXPECT_EQ(table.rows[1][table.Column("p2." + std::string(name))], 509.0);
    EXPECT_EQ(table.rows[0][table.Column("omega_spread")], 0.0);
    EXPECT_EQ(table.rows[0][table.Column("xi_max")], 0.1);
    EXPECT_EQ(MakeFamilyMembers(table, 3.0).models[1][1].tau_s, 0.008);
  }
}

}  // namespace
}  // namespace howl::operating_parameter_test
