// A small blind trial from end to end, interrupted once, and what happens to it afterwards.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace howl::trial_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kConfig =
    "experiments:\n"
    "  - {name: exp1, phi: 0.56, frequency_hz: 212, phase_deg: -8, gain: 12}\n";

// One trial for all: diagnoses cost seconds.
class Trial : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    command_ = "trial " + folder_->Write("rig.yaml", kConfig).string() +
               " --cases 3 --effects none,quantisation --severities large --duration 0.85 "
               "--threads 1 --out ";
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static fs::path Folder() { return folder_->path() / "trial"; }

  static std::vector<nlohmann::json> Log(const fs::path& trial) {
    std::ifstream file(trial / "log.jsonl");
    std::vector<nlohmann::json> entries;
    for (std::string line; std::getline(file, line);) {
      entries.push_back(nlohmann::json::parse(line));
    }
    return entries;
  }
  static int Count(const fs::path& trial, const std::string& event) {
    int count = 0;
    for (const nlohmann::json& entry : Log(trial)) count += entry.at("event") == event ? 1 : 0;
    return count;
  }

  // A copy with its times, as somebody who tampers would have it.
  static fs::path Copy(const std::string& name) {
    fs::path copy = folder_->path() / name;
    const std::string command = "cp -a " + Folder().string() + " " + copy.string();
    EXPECT_EQ(std::system(command.c_str()), 0);
    return copy;
  }
  static void Change(const fs::path& file, const std::string& from, const std::string& to) {
    std::string text = ReadFile(file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << file;
    text.replace(at, from.size(), to);
    chmod(file.c_str(), 0600);
    std::ofstream(file, std::ios::binary) << text;
  }
  static void ExpectFound(const fs::path& trial, const std::string& what) {
    const ProgramResult result = RunHowl(command_ + trial.string());
    EXPECT_EQ(result.status, 1) << result.out << result.err;
    EXPECT_THAT(result.err, HasSubstr(what));
    EXPECT_THAT(result.err, HasSubstr("no longer stands"));
  }

  // What comes after; they need a trial that is over.
  static void StandsWhileNothingChanges();
  static void NoticesATamperedKey();
  static void NoticesAChangedCase();
  static void NoticesADiagnosisMadeAgain();
  static void NoticesAChangedLogSealOrSheet();

  static TemporaryFolder* folder_;
  static std::string command_;
};

TemporaryFolder* Trial::folder_ = nullptr;
std::string Trial::command_;

TEST_F(Trial, RunsBlindGoesOnScoresAndNoticesChanges) {
  // Interrupted when the first diagnosis has ended.
  const pid_t child = StartHowl(command_ + Folder().string() + " --quiet");
  ASSERT_GT(child, 0);
  EXPECT_TRUE(WaitUntil([&] { return Count(Folder(), "diagnosed") > 0; }));
  kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);

  // The seal was there first, and nothing in the folder says what was withheld.
  EXPECT_EQ(Log(Folder()).front().at("event"), "sealed");
  EXPECT_EQ(Count(Folder(), "opened"), 0);
  EXPECT_FALSE(fs::exists(Folder() / "key" / "key.json"));
  for (const auto& entry : fs::recursive_directory_iterator(Folder())) {
    if (!entry.is_regular_file() || entry.path().filename() == "diagnosis.json") continue;
    EXPECT_EQ(ReadFile(entry.path()).find("quantisation"), std::string::npos) << entry.path();
  }
  struct stat sealed {};
  ASSERT_EQ(stat((Folder() / "key" / "key.sealed").c_str(), &sealed), 0);
  EXPECT_EQ(sealed.st_mode & 0777, 0400u);

  // Another seed is another trial.
  const ProgramResult other = RunHowl(command_ + Folder().string() + " --seed 2");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("has another trial"));

  const ProgramResult result = RunHowl(command_ + Folder().string());
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("# Blind trial: 3 cases"));
  EXPECT_EQ(Count(Folder(), "diagnosed"), 3);
  EXPECT_EQ(Count(Folder(), "opened"), 1);

  const auto trial = nlohmann::json::parse(ReadFile(Folder() / "trial.json"));
  EXPECT_EQ(trial.at("schema"), "howl.trial/1");
  EXPECT_EQ(trial.at("cases"), 3);
  EXPECT_EQ(trial.at("failed"), 0);
  EXPECT_EQ(trial.at("diagnose").at("false_alarms").at("total"), 1);
  // A digitiser of 18 levels is plain to see.
  EXPECT_EQ(trial.at("diagnose").at("all_severities").at("effect").at("right"), 2);
  EXPECT_EQ(trial.at("rivals").size(), 3u);
  EXPECT_EQ(trial.at("rivals").at(0).at("all_severities").at("effect").at("right"), 0);
  std::istringstream rows(ReadFile(Folder() / "trial.csv"));
  int lines = 0;
  for (std::string line; std::getline(rows, line);) ++lines;
  EXPECT_EQ(lines, 4);

  StandsWhileNothingChanges();
  NoticesATamperedKey();
  NoticesAChangedCase();
  NoticesADiagnosisMadeAgain();
  NoticesAChangedLogSealOrSheet();
}

void Trial::StandsWhileNothingChanges() {
  // What a run that was killed left of the key it wrote goes.
  const fs::path same = Copy("same");
  const fs::path left = same / "key" / ".key.json.howl-abc123";
  std::ofstream(left) << "half a key";
  const ProgramResult result = RunHowl(command_ + same.string());
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("nothing has changed since"));
  EXPECT_FALSE(fs::exists(left));
}

void Trial::NoticesATamperedKey() {
  const fs::path open = Copy("key");
  Change(open / "key" / "key.json", "quantisation", "mains_hum");
  ExpectFound(open, "key/key.json: has changed since the sealing");
  const fs::path sealed = Copy("sealed_key");
  const std::string text = ReadFile(sealed / "key" / "key.sealed");
  Change(sealed / "key" / "key.sealed", text.substr(40, 8), "tampered");
  ExpectFound(sealed, "key/key.sealed: has changed since the sealing");
}

void Trial::NoticesAChangedCase() {
  const fs::path data = Copy("data");
  Change(data / "cases" / "case002" / "data" / "exp1.csv", ",", ",1");
  ExpectFound(data, "cases/case002: has changed since the sealing");
  const fs::path more = Copy("more");
  std::ofstream(more / "cases" / "case001" / "hint") << "quantisation";
  ExpectFound(more, "cases/case001: has changed since the sealing");
}

void Trial::NoticesADiagnosisMadeAgain() {
  const fs::path edited = Copy("edited");
  Change(edited / "diagnoses" / "case001" / "diagnosis.json", "\"verdict\"", "\"Verdict\"");
  ExpectFound(edited, "diagnoses/case001/diagnosis.json: has changed since it was logged");

  // The same bytes, but later.
  const fs::path again = Copy("again");
  const fs::path file = again / "diagnoses" / "case003" / "diagnosis.json";
  const std::string text = ReadFile(file);
  fs::remove(file);
  std::ofstream(file, std::ios::binary) << text;
  ExpectFound(again, "diagnoses/case003/diagnosis.json: was written anew after the key was opened");
}

void Trial::NoticesAChangedLogSealOrSheet() {
  const fs::path log = Copy("log");
  Change(log / "log.jsonl", "\"status\":0", "\"status\":1");
  ExpectFound(log, "does not follow from the one before");
  const fs::path seal = Copy("seal");
  Change(seal / "seal.json", "\"case001\"", "\"case009\"");
  ExpectFound(seal, "seal.json: has changed since the sealing");
  const fs::path sheet = Copy("sheet");
  Change(sheet / "sheet.md", "3 cases", "9 cases");
  ExpectFound(sheet, "sheet.md: has changed since the scoring");
}

TEST(TrialMistakes, AreOneLine) {
  const TemporaryFolder folder;
  const std::string config = folder.Write("rig.yaml", kConfig).string();
  const std::string out = " --out " + (folder.path() / "out").string();
  for (const auto& [arguments, expected] : std::vector<std::pair<std::string, std::string>>{
           {" --effects q_sensor_bandpass", "--effects: q_sensor_bandpass"},
           {" --effects none,mains_humm+slow_drift", "did you mean mains_hum?"},
           {" --severities huge", "--severities: huge"},
           {" --cases 0", "--cases: 0"},
           {" --duration -1", "--duration: expected a positive number"}}) {
    const ProgramResult result = RunHowl("trial " + config + arguments + out);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_THAT(result.err, HasSubstr(expected));
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(folder.path() / "out"));
  }
}

}  // namespace
}  // namespace howl::trial_test
