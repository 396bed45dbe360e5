#include <glog/logging.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "app/input/problem_input.h"
#include "app/jobs/shard.h"
#include "app/jobs/shard_set.h"
#include "app/jobs/submitted_job.h"
#include "app/jobs/unit_store.h"
#include "app/trial/trial_log.h"
#include "estimation/family/bounds/enclose.h"
#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "tests/fuzz/target.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTable =
    "experiments:\n"
    "  - {name: exp1, phi: 0.56, frequency_hz: 212, phase_deg: -8, gain: 12}\n"
    "  - {name: exp2, phi: 0.60, frequency_hz: 214, phase_deg: -10, gain: 11}\n";

// A folder with one file, whose text is the input.
fs::path FolderWith(const char* file, std::string_view input) {
  fs::path folder = ScratchFolder() / "jobs";
  fs::remove_all(folder / "shards");
  fs::create_directories(folder / "shards");
  std::ofstream(folder / "shards" / file, std::ios::binary) << input;
  return folder;
}

void Shards(std::string_view input) {
  Options options;
  options.out = FolderWith("1-of-2.family.shard", input);
  Answered([&] { (void)ReadShards(options); });
}

void Job(std::string_view input) {
  const fs::path folder = FolderWith("job.json", input);
  Answered([&] {
    const std::optional<SubmittedJob> job = ReadJob(folder);
    // Each is looked for, and each number is handed to Slurm.
    CHECK(job && job->shards >= 1 && job->shards <= kMostShards);
    for (const std::string& array : job->arrays) CHECK(!array.starts_with("-"));
  });
}

void Store(std::string_view input) {
  const StoredUnits stored = ReadUnits(InputFile(input));
  CHECK_LE(stored.end, input.size());
  // What was believed is written and read as it was.
  if (stored.header.empty()) return;
  const StoredUnits again = ReadUnits(InputFile(StoreText(stored.header, stored.units)));
  CHECK(again.header == stored.header && again.units == stored.units && again.damaged == 0);
}

void Log(std::string_view input) {
  const TrialLog log = TrialLog::Parse(std::string(input));
  (void)log.Find("sealed");
}

// The state of a search for bounds: whatever it says, no bound lies inside out.
void Bounds(std::string_view input) {
  static const FamilyProblem problem = [] {
    const Config config = LoadConfig(InputFile(kTable));
    std::vector<Experiment> experiments;
    for (const ExperimentConfig& each : config.experiments) experiments.push_back(each.experiment);
    return MakeFamilyProblem(config, experiments);
  }();
  Enclosure enclosure(problem, EncloseOptions());
  std::istringstream state{std::string(input)};
  if (!enclosure.Load(state)) return;
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    for (const FamilyParameter parameter : kFamilyParameters) {
      if (!HasParameter(problem, i, parameter) || !enclosure.IsBounded(i, parameter)) continue;
      const EnclosedBound bound = enclosure.Bound(i, parameter);
      if (bound.inner.lo > bound.inner.hi) continue;  // no member was found
      CHECK_LE(bound.outer.lo, bound.inner.lo);
      CHECK_GE(bound.outer.hi, bound.inner.hi);
    }
  }
}

}  // namespace

std::vector<FuzzTarget> StateTargets() {
  return {{"shards", Shards},
          {"submitted", Job},
          {"units", Store},
          {"trial_log", Log},
          {"bounds", Bounds}};
}

}  // namespace howl
