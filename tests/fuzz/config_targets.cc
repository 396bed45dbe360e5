#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "app/campaign/campaign_rigs.h"
#include "app/campaign/campaign_spec.h"
#include "app/jobs/job_spec.h"
#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "io/records/record_faults.h"
#include "tests/fuzz/target.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

Config AnyConfig(const fs::path& path) { return LoadConfig(path, LoopsTaken::kAny); }

// A record for configs to name, with a gap, a jump of its times and a word among its numbers.
void WriteRecord(const fs::path& path) {
  constexpr int kRows = 100;
  std::ofstream file(path);
  file << "t,p,q,bad\n";
  for (int i = 0; i < kRows; ++i) {
    file << 2e-4 * i + (i > 80 ? 1.0 : 0.0) << "," << (i == 50 ? "nan" : std::to_string(i % 7))
         << "," << i % 5 << "," << (i == 20 ? "x" : "1") << "\n";
  }
}

// As howl check reads it: on after its mistakes, and its records on after their faults.
void Check(std::string_view input) {
  const fs::path config = InputFile(input);
  static const fs::path record = [] {
    WriteRecord(ScratchFolder() / "r.csv");
    return ScratchFolder() / "r.csv";
  }();
  const ConfigReading reading = ReadConfigOn(config);
  for (const UserError& mistake : reading.mistakes) CheckIsOneLine(mistake.what());
  bool is_read = false;
  Answered([&] {
    (void)AnyConfig(config);
    is_read = true;
  });
  CHECK_EQ(is_read, reading.mistakes.empty()) << "a mistake for one reading and none for the other";
  if (!reading.config) return;
  CHECK_LE(reading.config->experiments.size(), reading.experiments);
  for (const ExperimentConfig& each : reading.config->experiments) {
    if (!each.record || each.record->file != record) continue;
    const RecordReading read = ReadRecordOn(*each.record, config.string(), each.record_line);
    CHECK(read.record || !read.faults.empty());
    for (const UserError& fault : read.faults) CheckIsOneLine(fault.what());
  }
}

// The configs that a campaign makes of a template by a fleet's table and by a grid.
void Rigs(std::string_view input) {
  constexpr std::array<std::string_view, 4> kFiles = {"campaign.yaml", "a.yaml", "b.yaml",
                                                      "rigs.csv"};
  const fs::path folder = ScratchFolder() / "campaign";
  WriteFiles(folder, kFiles, input);
  const auto is_here = [&](const fs::path& path) { return path.parent_path() == folder; };
  Answered([&] {
    const CampaignSpec spec = LoadCampaign(folder / "campaign.yaml");
    // Elsewhere a file may be long.
    if (!std::ranges::all_of(spec.configs, is_here) || (spec.fleet && !is_here(*spec.fleet)))
      return;
    double rigs = 1.0;
    for (const GridAxis& axis : spec.grid) rigs *= static_cast<double>(axis.values.size());
    if (rigs > 100.0) return;  // a second's work
    const CampaignRigs made = MakeRigs(spec, 1, folder);
    for (const CampaignRig& rig : made.rigs) CHECK_EQ(rig.settings.size(), made.columns.size());
    // A config that was derived is read like any other; one of them, for that takes the longest.
    if (made.rigs.empty() || !made.rigs.back().is_derived) return;
    (void)AnyConfig(InputFile(made.rigs.back().config_text));
  });
}

}  // namespace

std::vector<FuzzTarget> ConfigTargets() {
  const auto reading = [](auto read) {
    return [read](std::string_view input) { Answered([&] { (void)read(InputFile(input)); }); };
  };
  return {{"config", reading(AnyConfig)},
          {"campaign", reading(LoadCampaign)},
          {"job", reading(LoadJob)},
          {"check", Check},
          {"rigs", Rigs}};
}

}  // namespace howl
