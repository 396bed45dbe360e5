// Long jobs in shards: joined, in whatever number and order, they are what one machine makes; what
// is missing, damaged or of another job is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <vector>

#include "tests/app/program.h"

namespace howl::shard_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kTable =
    "experiments:\n"
    "  - {name: exp1, phi: 0.56, frequency_hz: 212, phase_deg: -8, gain: 12}\n"
    "  - {name: exp2, phi: 0.60, frequency_hz: 214, phase_deg: -10, gain: 11}\n";

// The shard's number counts from 1.
std::string ShardOption(int shard, int count) {
  return " --shard " + std::to_string(shard) + "/" + std::to_string(count);
}

void RunShards(const std::string& command, const std::vector<int>& order) {
  for (const int shard : order) {
    const ProgramResult result =
        RunHowl(command + ShardOption(shard, static_cast<int>(order.size())));
    ASSERT_EQ(result.status, 0) << result.out << result.err;
  }
}

void ExpectSameFiles(const fs::path& one, const fs::path& other,
                     const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const std::string text = ReadFile(one / name);
    EXPECT_FALSE(text.empty()) << name;
    EXPECT_EQ(ReadFile(other / name), text) << name;
  }
}

class FamilyShards : public ::testing::Test {
 protected:
  std::string Command(const std::string& out) const {
    return "family " + config_ + " --out " + (folder_.path() / out).string();
  }
  std::string Merge(const std::string& out) const {
    return "merge " + (folder_.path() / out).string();
  }
  fs::path ShardFile(const std::string& out, const std::string& name) const {
    return folder_.path() / out / "shards" / (name + ".family.shard");
  }

  TemporaryFolder folder_;
  std::string config_ = folder_.Write("rig.yaml", kTable).string();
};

TEST_F(FamilyShards, JoinToTheBytesOfOneMachine) {
  const std::vector<std::string> files = {"family.json", "family.csv", "tradeoff.csv"};
  ASSERT_EQ(RunHowl(Command("whole")).status, 0);
  for (const std::vector<int>& order :
       {std::vector<int>{1}, {2, 1}, {5, 3, 1, 4, 2}, {9, 8, 7, 6, 5, 4, 3, 2, 1}}) {
    const std::string out = "of" + std::to_string(order.size());
    RunShards(Command(out), order);
    const ProgramResult merged = RunHowl(Merge(out));
    EXPECT_EQ(merged.status, 0) << merged.err;
    ExpectSameFiles(folder_.path() / "whole", folder_.path() / out, files);
  }
}

TEST_F(FamilyShards, NamesThoseThatAreMissing) {
  for (const int shard : {1, 3, 4, 8}) RunHowl(Command("part") + ShardOption(shard, 8));
  const ProgramResult result = RunHowl(Merge("part"));
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("4 of 8 shards of family are missing: 2, 5 to 7\n"));
  EXPECT_FALSE(fs::exists(folder_.path() / "part" / "family.json"));
}

TEST_F(FamilyShards, OfAnotherSeedConfigOrOptionAreRefused) {
  const std::string other = folder_.Write("other.yaml", std::string(kTable) + "\n").string();
  const std::string first = Command("mixed") + ShardOption(1, 2);
  for (const std::string& second :
       {Command("mixed") + " --seed 2" + ShardOption(2, 2),
        "family " + other + " --out " + (folder_.path() / "mixed").string() + ShardOption(2, 2),
        Command("mixed") + " --advise" + ShardOption(2, 2), Command("mixed") + ShardOption(3, 3)}) {
    fs::remove_all(folder_.path() / "mixed");
    ASSERT_EQ(RunHowl(first).status, 0);
    ASSERT_EQ(RunHowl(second).status, 0);
    const ProgramResult result = RunHowl(Merge("mixed"));
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("it is a shard of another job")) << second;
  }
}

TEST_F(FamilyShards, OfInputsThatChangedSinceAreRefused) {
  RunShards(Command("changed"), {1, 2});
  folder_.Write("rig.yaml", std::string(kTable) + "title: another\n");
  const ProgramResult result = RunHowl(Merge("changed"));
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("has changed since the shards ran"));
  // Nor is another job's shard overwritten.
  const ProgramResult again = RunHowl(Command("changed") + ShardOption(1, 2));
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("is of another job, program or input"));
}

TEST_F(FamilyShards, DamagedOnesAreNamed) {
  RunShards(Command("damaged"), {1, 2});
  const fs::path shard = ShardFile("damaged", "2-of-2");
  const std::string text = ReadFile(shard);
  std::string flipped = text;
  flipped[text.size() / 2] ^= 1;
  for (const std::string& damaged :
       {flipped, text.substr(0, text.size() / 2), text.substr(0, text.rfind("#units"))}) {
    std::ofstream(shard, std::ios::binary) << damaged;
    const ProgramResult result = RunHowl(Merge("damaged"));
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("2-of-2.family.shard")) << result.err;
  }
  // Run again, it is made again.
  ASSERT_EQ(RunHowl(Command("damaged") + ShardOption(2, 2)).status, 0);
  EXPECT_EQ(ReadFile(shard), text);
  EXPECT_EQ(RunHowl(Merge("damaged")).status, 0);
}

TEST(Shards, BadRequestsAreNamed) {
  const TemporaryFolder folder;
  const std::string config = folder.Write("rig.yaml", kTable).string();
  for (const char* const bad : {"0/4", "5/4", "1", "a/b", "1/0", "1/4x", "1/999999999"}) {
    const ProgramResult result = RunHowl("family " + config + " --shard " + bad);
    EXPECT_EQ(result.status, 2) << bad;
    EXPECT_THAT(result.err, HasSubstr("--shard: " + std::string(bad) + ", expected I/N")) << bad;
  }
  EXPECT_THAT(RunHowl("diagnose " + config + " --shard 1/2").err, HasSubstr("--bootstrap N"));
  const ProgramResult none = RunHowl("merge " + folder.path().string());
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("has no shard"));
}

TEST(TrialShards, JoinToTheSheetOfOneMachineThoughOneWasKilled) {
  const TemporaryFolder folder;
  const std::string config =
      folder
          .Write("rig.yaml",
                 "experiments:\n"
                 "  - {name: exp1, phi: 0.56, frequency_hz: 212, phase_deg: -8, gain: 12}\n")
          .string();
  const std::string asks =
      " --cases 3 --effects none,quantisation --severities large --duration 0.85 --threads 1";
  const std::string command = "trial " + config + asks + " --out " + folder.path().string();
  ASSERT_EQ(RunHowl(command + "/whole").status, 0);
  const std::string out = (folder.path() / "parts").string();
  const pid_t shard = StartHowl(command + "/parts --quiet" + ShardOption(2, 2));
  ASSERT_GT(shard, 0);
  // The second of three cases is this shard's only one; its diagnosis has begun.
  EXPECT_TRUE(WaitUntil([&] { return fs::exists(out + "/diagnoses/case002/diagnosis.state"); }));
  EXPECT_EQ(kill(-shard, SIGKILL), 0);
  EXPECT_EQ(waitpid(shard, nullptr, 0), shard);
  EXPECT_FALSE(fs::exists(out + "/shards/2-of-2.trial.shard"));
  RunShards(command + "/parts", {2, 1});
  // What was withheld is in no file that can be read before the merge.
  EXPECT_FALSE(fs::exists(out + "/key/key.json"));
  EXPECT_EQ(ReadFile(out + "/shards/1-of-2.trial.shard").find("\"effects\""), std::string::npos);
  const ProgramResult merged = RunHowl("merge " + out);
  EXPECT_EQ(merged.status, 0) << merged.err;
  ExpectSameFiles(folder.path() / "whole", out,
                  {"sheet.md", "trial.json", "seal.json", "key/key.json", "key/key.sealed"});
  // Merged again, nothing has changed.
  EXPECT_EQ(RunHowl("merge " + out).status, 0);
  std::ofstream(out + "/sheet.md", std::ios::app) << "better";
  EXPECT_EQ(RunHowl("merge " + out).status, 1);
}

// The replicates of a bootstrap, each shard with a share.
TEST(LongDiagnoseShards, JoinToTheBytesOfOneMachine) {
  const TemporaryFolder folder;
  const std::string config = folder.Write("rig.yaml", kTable).string();
  ASSERT_EQ(RunHowl("simulate " + config + " --out " + folder.path().string()).status, 0);
  const std::string command =
      "diagnose " + (folder.path() / "records.yaml").string() + " --bootstrap 19 --out ";
  ASSERT_EQ(RunHowl(command + (folder.path() / "whole").string()).status, 0);
  const std::string out = (folder.path() / "parts").string();
  RunShards(command + out, {3, 1, 2});
  EXPECT_EQ(RunHowl("merge " + out).status, 0);
  ExpectSameFiles(folder.path() / "whole", out, {"diagnosis.json"});
}

}  // namespace
}  // namespace howl::shard_test
