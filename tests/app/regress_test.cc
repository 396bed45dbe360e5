#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl::regress_test {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kSmall = "r228_reliable";  // the config whose run takes least

std::filesystem::path Stored(const std::string& name) {
  return std::filesystem::path(HOWL_SOURCE_DIR) / "results" / name / "reference.json";
}

Json StoredJson(const std::string& name) { return Json::parse(ReadFile(Stored(name))); }

bool NeedsMeasuredRecords(const std::filesystem::path& config) {
  return ReadFile(config).find("${HOWL_DATA}") != std::string::npos;
}

std::vector<std::string> ShippedConfigs() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(HOWL_SOURCE_DIR "/configs")) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  }
  std::ranges::sort(names);
  return names;
}

class ShippedConfig : public ::testing::TestWithParam<std::string> {};

// Those with measured records: records_test.cc.
TEST_P(ShippedConfig, IsAsStored) {
  const std::string& name = GetParam();
  ASSERT_TRUE(std::filesystem::exists(Stored(name))) << "no stored results";
  if (NeedsMeasuredRecords(Config(name))) GTEST_SKIP() << "needs records";
  EXPECT_TRUE(StoredJson(name).contains("family"));
  const ProgramResult run = RunHowl("regress " + Config(name));
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("as stored"));
}

INSTANTIATE_TEST_SUITE_P(Regress, ShippedConfig, ::testing::ValuesIn(ShippedConfigs()),
                         [](const auto& instance) { return instance.param; });

TEST(Regress, RecordsOfAnAbsentFolderAreSkippedInOneClearLine) {
  ASSERT_TRUE(NeedsMeasuredRecords(Config("turbulent_combustor")));
  const ProgramResult run =
      RunHowl("regress " + Config("turbulent_combustor") + " --reference /nowhere");
  if (std::getenv("HOWL_DATA") == nullptr) {
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, StartsWith("skipped: "));
    EXPECT_THAT(run.out, HasSubstr("HOWL_DATA is not set"));
    EXPECT_EQ(std::ranges::count(run.out, '\n'), 1);
  } else {
    EXPECT_EQ(run.status, 2);  // nothing stored there
  }
  const TemporaryFolder folder;
  const std::string config =
      folder
          .Write("gone.yaml",
                 "experiments:\n  - {name: a, phi: 0.5, record: {file: gone.csv, pressure: p, "
                 "heat_release: q, sampling_hz: 5000}}\n")
          .string();
  const ProgramResult gone = RunHowl("regress " + config);
  EXPECT_EQ(gone.status, 0) << gone.err;
  EXPECT_THAT(gone.out, HasSubstr("skipped: "));
  EXPECT_THAT(gone.out, HasSubstr("there is no file"));
  // Nothing to store either: that is the user's mistake.
  const ProgramResult update = RunHowl("regress " + config + " --update");
  EXPECT_EQ(update.status, 2);
  EXPECT_EQ(std::ranges::count(update.err, '\n'), 1) << update.err;
}

// A config of the same name with one text changed, beside the stored results of the original.
ProgramResult RegressChanged(const std::string& from, const std::string& to) {
  const TemporaryFolder folder;
  std::string text = ReadFile(Config(kSmall));
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  return RunHowl("regress " + folder.Write("changed.yaml", text).string() + " --reference " +
                 Stored(kSmall).parent_path().string());
}

TEST(Regress, ADoubledGainToleranceIsCaught) {
  const ProgramResult run = RegressChanged("gain_tolerance: 0.01", "gain_tolerance: 0.02");
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("family.test.gain_tolerance"));
  EXPECT_THAT(run.out, HasSubstr("family.bounds.exp1.N.outer[1]"));
  EXPECT_THAT(run.out, HasSubstr("family.members.exp1.N.digests"));
}

TEST(Regress, ANarrowerSpreadIsCaught) {
  const ProgramResult run = RegressChanged("omega_spread_max: 0.25", "omega_spread_max: 0.22");
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("family.test.omega_spread_max"));
  EXPECT_THAT(run.out, HasSubstr("family.bounds."));
  EXPECT_THAT(run.out, HasSubstr("family.members."));
}

// One stored figure changed by 1 % is one figure that moved, named with both values.
void ExpectNamed(const std::string& pointer, const std::string& name) {
  SCOPED_TRACE(name);
  const TemporaryFolder folder;
  Json reference = StoredJson(kSmall);
  Json& figure = reference[Json::json_pointer(pointer)];
  ASSERT_TRUE(figure.is_number()) << pointer;
  const Json fresh = figure;
  figure =
      figure.is_number_integer() ? Json(figure.get<int>() + 1) : Json(1.01 * figure.get<double>());
  folder.Write("reference.json", reference.dump());
  const ProgramResult run =
      RunHowl("regress " + Config(kSmall) + " --reference " + folder.path().string());
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr(name));
  EXPECT_THAT(run.out, HasSubstr(figure.dump()));
  // Its last digits are the machine's, within the tolerance of `regress`.
  constexpr std::size_t kDigits = 13;
  EXPECT_THAT(run.out, HasSubstr(fresh.dump().substr(0, kDigits)));
  EXPECT_THAT(run.out, HasSubstr("1 value moved"));
}

TEST(Regress, EachKindOfFigureThatMovesIsNamed) {
  ExpectNamed("/solution/experiments/2/xi", "solution.experiments[exp3].xi");
  ExpectNamed("/family/test/xi_max", "family.test.xi_max");
  ExpectNamed("/family/bounds/exp1/omega_hz/outer/0", "family.bounds.exp1.omega_hz.outer[0]");
  ExpectNamed("/family/bounds/exp2/tau_s/inner/1", "family.bounds.exp2.tau_s.inner[1]");
  ExpectNamed("/family/counts/members", "family.counts.members");
  ExpectNamed("/family/predictions/0/interval/1",
              "family.predictions[exp1.growth_rate].interval[1]");
  ExpectNamed("/family/members/exp1/xi/quantiles/2", "family.members.exp1.xi.quantiles[2]");
}

// One digest in common is the same list: the other changes where a last bit crosses its cut.
TEST(Regress, MembersAreTheSameWhereOneDigestIs) {
  const std::string pointer = "/family/members/exp1/xi/digests/";
  for (const int changed : {1, 2}) {
    const TemporaryFolder folder;
    Json reference = StoredJson(kSmall);
    for (int k = 0; k < changed; ++k) {
      reference[Json::json_pointer(pointer + std::to_string(k))] = "0123456789abcdef";
    }
    folder.Write("reference.json", reference.dump());
    const ProgramResult run =
        RunHowl("regress " + Config(kSmall) + " --reference " + folder.path().string());
    EXPECT_EQ(run.status, changed == 1 ? 0 : 1) << run.out << run.err;
    if (changed == 2) {
      EXPECT_THAT(run.out, HasSubstr("family.members.exp1.xi.digests"));
    }
  }
}

TEST(Regress, UpdateStoresWhatTheNextRunFinds) {
  const TemporaryFolder folder;
  const std::string there = " --reference " + folder.path().string();
  ASSERT_EQ(RunHowl("regress " + Config(kSmall) + there + " --update").status, 0);
  EXPECT_EQ(RunHowl("regress " + Config(kSmall) + there + " --threads 1").status, 0);
}

// A file of the earlier schema has no family: what it has is compared, and what it has not is said.
TEST(Regress, TheEarlierSchemaIsStillRead) {
  const TemporaryFolder folder;
  Json reference = StoredJson(kSmall);
  reference["schema"] = "howl.reference/1";
  reference.erase("family");
  folder.Write("reference.json", reference.dump());
  const ProgramResult run =
      RunHowl("regress " + Config(kSmall) + " --reference " + folder.path().string());
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("holds no family"));
}

TEST(Regress, DamagedReferencesAreOneLineAndStatusTwo) {
  const std::string good = ReadFile(Stored(kSmall));
  struct Damage {
    std::string content, line;
  };
  std::vector<Damage> damages = {
      {"", "reference.json:1: not JSON"},
      {good.substr(0, good.size() / 2), "not JSON"},
      {"{\n\"schema\": \"howl.reference/2\",\n\"family\": }\n", "reference.json:3: not JSON"},
      {"[]", "reference.json: schema: is null"},
      {"{\"schema\": \"howl.reference/9\"}", "schema: is \"howl.reference/9\""},
      {"{\"schema\": \"howl.reference/2\", \"solution\": 1e999}", "out of range"}};
  const auto with = [&](const std::string& pointer, const Json& value, const std::string& line) {
    Json damaged = Json::parse(good);
    damaged[Json::json_pointer(pointer)] = value;
    damages.push_back({damaged.dump(1), line});
  };
  with("/solution/experiments/2/xi", "wide", "solution.experiments[exp3].xi: is \"wide\"");
  with("/solution/experiments", 7, "solution.experiments: is 7, expected a list");
  with("/solution/experiments/0/name", 7, "solution.experiments[0].name: is 7, expected a text");
  with("/family/bounds/exp1/xi/outer", "0", "family.bounds.exp1.xi.outer: is \"0\"");
  with("/family/members/exp1/xi/digests", 3, "family.members.exp1.xi.digests: is 3");
  with("/family", true, "family: is true, expected a mapping");
  for (const Damage& damage : damages) {
    SCOPED_TRACE(damage.line);
    const TemporaryFolder folder;
    folder.Write("reference.json", damage.content);
    const ProgramResult run =
        RunHowl("regress " + Config(kSmall) + " --reference " + folder.path().string());
    EXPECT_EQ(run.status, 2) << run.out << run.err;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr("reference.json"));
    EXPECT_THAT(run.err, HasSubstr(damage.line));
  }
}

}  // namespace
}  // namespace howl::regress_test
