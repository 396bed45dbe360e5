#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "app/command.h"
#include "app/digest.h"
#include "app/interruption.h"
#include "app/trial/trial_run.h"
#include "io/results/trial_sheet.h"
#include "io/user_error.h"

namespace howl {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kDefaultCases = 200;
constexpr int kMostCases = 100000;

std::vector<std::string> Words(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, ',');) {
    if (!word.empty()) words.push_back(word);
  }
  return words;
}

double Severity(const std::string& word) {
  for (const double severity : kSeverities) {
    if (word == SeverityName(severity)) return severity;
  }
  std::istringstream in(word);
  double value = -1.0;
  if (!(in >> value) || !in.eof() || value < 0.0 || value > 1.0) {
    throw UsageError("--severities: " + word +
                     ", expected small, medium, large, or numbers from 0 to 1");
  }
  return value;
}

// The command line as it would be typed again, for the sheet.
std::string CommandText(const Options& options) {
  std::string text = "howl trial " + options.config.string();
  for (const auto& [name, value] : options.own) text += " " + name + " " + value;
  return text + " --seed " + std::to_string(options.seed);
}

TrialRequest MakeRequest(const Options& options) {
  TrialRequest request;
  request.options.cases = options.Count("--cases", 1, kMostCases).value_or(kDefaultCases);
  request.options.effects =
      Words(options.Text("--effects").value_or("catalogue,none,outside,pairs"));
  for (const std::string& word : Words(options.Text("--severities").value_or("small,medium,large")))
    request.options.severities.push_back(Severity(word));
  request.options.seed = options.seed;
  try {
    PlanCases(request.options, ListRigEffects());
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--effects: ") + error.what());
  }
  const Config config = LoadConfig(options.config);
  request.rig_template = MakeRigTemplate(config, options);
  request.config_sha256 = Sha256OfFile(options.config).value_or("");
  request.command = CommandText(options);
  return request;
}

// One progress line that is overwritten; it gives the remaining time once that can be estimated.
Progress ShowProgress(const Options& options, const char* what) {
  if (options.quiet || isatty(STDERR_FILENO) == 0) return nullptr;
  return [what, start = Clock::now()](std::size_t done, std::size_t total) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const double left = seconds * static_cast<double>(total - done) / static_cast<double>(done);
    std::fprintf(stderr, "\r%s: %zu of %zu, %.0f min %02.0f s left  %s", what, done, total,
                 std::floor(left / 60.0), left - 60.0 * std::floor(left / 60.0),
                 done == total ? "\n" : "");
  };
}

// True when there are none.
bool ReportChanges(const TrialFolder& folder, const TrialLog& log) {
  const std::vector<std::string> changes = FindChanges(folder, log);
  for (const std::string& change : changes) std::fprintf(stderr, "%s\n", change.c_str());
  if (!changes.empty()) {
    std::fprintf(stderr, "howl: the trial in %s no longer stands: %zu %s changed\n",
                 folder.root.c_str(), changes.size(), changes.size() == 1 ? "thing" : "things");
  }
  return changes.empty();
}

int Finish(const TrialFolder& folder, const Options& options, TrialLog& log) {
  const ScoredTrial trial = ScoreTrial(folder, log);
  if (!log.Find("scored")) WriteScores(folder, trial, log);
  if (!options.quiet) {
    std::printf("%s", ReadWholeFile(folder.root / "sheet.md").value_or("").c_str());
    std::printf("written: trial.json, trial.csv and sheet.md in %s\n", folder.root.c_str());
  }
  return kDone;
}

int Run(const Options& options) {
  const TrialFolder folder{options.out};
  TrialLog log(folder.Log());
  const bool is_sealed = log.Find("sealed").has_value() || log.broken_line() > 0;
  if (is_sealed && !ReportChanges(folder, log)) return kNegativeAnswer;
  if (log.Find("opened")) {
    if (!options.quiet) std::printf("the trial is over; nothing has changed since\n\n");
    return Finish(folder, options, log);
  }

  WatchForInterruption();
  const TrialRequest request = MakeRequest(options);
  if (!is_sealed) {
    MakeCases(folder, request, options.threads, ShowProgress(options, "cases made"), log);
    if (!options.quiet) {
      std::printf("sealed: %s\n", log.Find("sealed")->value("seal_sha256", "").c_str());
      std::fflush(stdout);
    }
  }
  const std::string key = DecipherKey(folder, request);
  if (key.empty()) {
    throw UserError(folder.root.string(), 0, "",
                    "has another trial, expected the command that began it, or another --out");
  }
  RunDiagnoses(folder, options.threads, ShowProgress(options, "diagnosed"), log);
  // Nothing may have moved while the diagnoses ran.
  if (!ReportChanges(folder, log)) return kNegativeAnswer;
  OpenKey(folder, key, log);
  return Finish(folder, options, log);
}

}  // namespace

Command TrialCommand() {
  return {
      "trial",
      "ask, blind, how often the diagnosis is right on rigs like this one",
      "Makes cases with a second simulator (howl_rig), matched to the config's characteristics\n"
      "or to those of its records; each has one effect, none, two, or one that the catalogue\n"
      "has not. Seals key and cases by SHA-256, then diagnoses each case in a process of its\n"
      "own, opens the key once, and scores. An interrupted trial goes on where it stopped. Run\n"
      "again on a trial that is over, it says whether anything has changed since (exit 1).\n"
      "Writes trial.json, trial.csv and sheet.md.",
      {{"--cases", "N", "how many (default: 200)"},
       {"--effects", "LIST",
        "effects, a+b for two at once, or groups (default: catalogue,none,outside,pairs)"},
       {"--severities", "LIST", "small, medium, large, or 0 to 1 (default: the three)"},
       {"--duration", "S", "of each record, in seconds"},
       {"--sampling", "HZ", "sampling rate"},
       {"--experiments", "N", "operating points, spread over the config's (default: all)"},
       {"--combustion-noise", "R", "rms over the flame's saturation (default: drawn)"},
       {"--sensor-noise", "R", "rms over the cycle's amplitude (default: drawn)"}},
      Run};
}

}  // namespace howl
