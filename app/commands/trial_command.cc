#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/command_line/command.h"
#include "app/files/digest.h"
#include "app/jobs/shard.h"
#include "app/process/interruption.h"
#include "app/trial/trial_run.h"
#include "app/trial/trial_shards.h"
#include "io/json_fields.h"
#include "io/results/trial_sheet.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

using Clock = std::chrono::steady_clock;

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

// What is left of making, sealing and diagnosing. Empty where something has changed meanwhile; else
// the key.
std::optional<std::string> SealAndDiagnose(const TrialFolder& folder, const TrialRequest& request,
                                           const Options& options, TrialLog& log) {
  if (!log.Find("sealed")) {
    MakeCases(folder, request, options.threads, ShowProgress(options, "cases made"), log);
    if (!options.quiet) {
      std::printf("sealed: %s\n", TextAt(*log.Find("sealed"), "seal_sha256").c_str());
      std::fflush(stdout);
    }
  }
  const std::string key = DecipherKey(folder, request);
  if (key.empty()) {
    throw UserError(folder.books.string(), 0, "",
                    "has another trial, expected the command that began it, or another --out");
  }
  RunDiagnoses(folder, options.threads, ShowProgress(options, "diagnosed"), log);
  // Nothing may have moved while the diagnoses ran.
  if (!ReportChanges(folder, log)) return std::nullopt;
  return key;
}

// The first entry of a log is that of the sealing: a log that has others alone was changed.
bool IsSealed(const TrialLog& log) { return !log.entries().empty(); }

int RunTrialShard(const Options& options, const Shard& shard) {
  TrialRequest request = MakeTrialRequest(options);
  request.shard = shard;
  const std::string header = ShardHeader("trial", options, TrialInputsSha256(request), shard);
  if (IsShardDone(options.out, "trial", shard, header)) return kDone;
  const TrialFolder folder = FolderOfShard(options.out, shard);
  std::filesystem::create_directories(folder.books);
  RemoveUnpublished(folder);
  TrialLog log(folder.Log());
  if (IsSealed(log) && !ReportChanges(folder, log)) return kNegativeAnswer;
  WatchForInterruption();
  if (!SealAndDiagnose(folder, request, options, log)) return kNegativeAnswer;
  FinishShard(options, "trial", shard, header, UnitsOfShard(folder, shard, log));
  std::filesystem::remove_all(folder.books);
  return kDone;
}

int RunTrialCommand(const Options& options) {
  if (const std::optional<Shard> shard = ShardOf(options)) return RunTrialShard(options, *shard);
  const TrialFolder folder{options.out, options.out};
  RemoveUnpublished(folder);
  TrialLog log(folder.Log());
  if (IsSealed(log) && !ReportChanges(folder, log)) return kNegativeAnswer;
  if (log.Find("opened")) {
    if (!options.quiet) std::printf("the trial is over; nothing has changed since\n\n");
    return Finish(folder, options, log);
  }

  WatchForInterruption();
  const TrialRequest request = MakeTrialRequest(options);
  const std::optional<std::string> key = SealAndDiagnose(folder, request, options, log);
  if (!key) return kNegativeAnswer;
  OpenKey(folder, *key, log);
  return Finish(folder, options, log);
}

std::string TrialInputsOf(const Options& options) {
  return TrialInputsSha256(MakeTrialRequest(options));
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
       {"--sensor-noise", "R", "rms over the cycle's amplitude (default: drawn)"},
       ShardOption()},
      RunTrialCommand,
      true,
      "CONFIG",
      Sharding{TrialInputsOf, AdoptTrialShards}};
}

}  // namespace howl
