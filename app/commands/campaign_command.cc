#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/campaign/campaign_rigs.h"
#include "app/campaign/campaign_spec.h"
#include "app/campaign/campaign_tables.h"
#include "app/campaign/campaign_text.h"
#include "app/campaign/run_rig.h"
#include "app/command_line/command.h"
#include "app/files/digest.h"
#include "app/jobs/shard.h"
#include "app/jobs/unit_store.h"
#include "app/process/interruption.h"
#include "estimation/parallel.h"
#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "io/json_fields.h"
#include "io/json_text.h"
#include "io/result_files.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

constexpr const char* kTableOption = "--table";

std::string KeyOf(const CampaignRig& rig) { return "rig#" + rig.name; }

std::filesystem::path CampaignStatePath(const Options& options) {
  return options.out / "campaign.state";
}

// Each row says itself of which inputs it is, so that a campaign that grows, or of which a record
// has changed, runs only what is new.
std::string StateHeader() { return "howl.campaign.state/1 " + ProgramIdentity(); }

std::string CampaignSha256(const CampaignSpec& spec) {
  std::string text = spec.text;
  for (const std::filesystem::path& config : spec.configs) {
    text += Sha256OfFile(config).value_or("") + "\n";
  }
  if (spec.fleet) text += Sha256OfFile(*spec.fleet).value_or("");
  return Sha256(text);
}

bool IsOf(const std::string& row, const CampaignSpec& spec, const CampaignRigs& all,
          const CampaignRig& rig) {
  const auto json = ParseJsonOrNone<nlohmann::json>(row);
  return IsRigRow(json, all) && TextAt(json, "inputs_sha256") == RigInputsSha256(spec, rig);
}

bool HasError(const std::string& row) {
  return !TextAt(ParseJsonOrNone<nlohmann::json>(row), "error").empty();
}

// A key that a config has not, a value that it cannot have: said before the first rig is run.
void CheckFirst(const CampaignRigs& rigs) {
  WriteRigConfig(rigs.rigs.front());
  (void)LoadConfig(rigs.rigs.front().config);
}

// Runs the rigs that are asked for and whose rows are not there; adds their rows.
void RunRigs(const CampaignSpec& spec, const std::vector<const CampaignRig*>& rigs,
             const Options& options, UnitStore& store, Units& rows) {
  std::vector<const CampaignRig*> left;
  for (const CampaignRig* rig : rigs) {
    if (!rows.contains(KeyOf(*rig))) left.push_back(rig);
  }
  std::vector<std::string> made(left.size());
  WatchForInterruption();
  RunUnits(left.size(), options.threads, [&](std::size_t k) {
    if (IsInterrupted()) return;
    std::optional<std::string> row = RunRig(spec, *left[k], options.out);
    if (!row) return;
    store.Append(KeyOf(*left[k]), *row);
    made[k] = *std::move(row);
  });
  if (IsInterrupted()) {
    throw Interrupted("interrupted: the same command goes on from where it was");
  }
  for (std::size_t k = 0; k < left.size(); ++k) rows[KeyOf(*left[k])] = std::move(made[k]);
}

int RunCampaignShard(const Options& options, const Shard& shard) {
  const CampaignSpec spec = LoadCampaign(options.config);
  const CampaignRigs all = MakeRigs(spec, options.seed, options.out);
  CheckFirst(all);
  const std::string header = ShardHeader("campaign", options, CampaignSha256(spec), shard);
  if (IsShardDone(options.out, "campaign", shard, header)) return kDone;
  UnitStore store(ShardPartPath(options.out, "campaign", shard), header);
  std::vector<const CampaignRig*> own;
  for (std::size_t k = shard.index - 1; k < all.rigs.size(); k += shard.count) {
    own.push_back(&all.rigs[k]);
  }
  Units rows = store.found();
  RunRigs(spec, own, options, store, rows);
  FinishShard(options, "campaign", shard, header, rows);
  store.Forget();
  return kDone;
}

// The stored rows that are of the rigs as they now are.
Units ValidRows(const CampaignSpec& spec, const CampaignRigs& all, const Units& stored) {
  Units rows;
  for (const CampaignRig& rig : all.rigs) {
    const auto row = stored.find(KeyOf(rig));
    if (row != stored.end() && IsOf(row->second, spec, all, rig)) rows.insert(*row);
  }
  return rows;
}

Units RowsOf(const CampaignSpec& spec, const CampaignRigs& all, const Options& options) {
  const StoredUnits stored = ReadUnits(CampaignStatePath(options));
  const bool is_ours = stored.header == StateHeader() && !stored.repeats_a_key;
  Units rows = ValidRows(spec, all, is_ours ? stored.units : Units());
  if (options.Has(kTableOption)) return rows;
  // What failed may have failed for want of memory or of room on the disk.
  std::erase_if(rows, [](const auto& row) { return HasError(row.second); });
  if (!rows.empty() && !options.quiet) {
    std::fprintf(stderr, "going on from %s: %zu of %zu rigs are done\n",
                 CampaignStatePath(options).c_str(), rows.size(), all.rigs.size());
  }
  if (rows.size() != stored.units.size() || !is_ours) {
    WriteWholeFile(CampaignStatePath(options), StoreText(StateHeader(), rows));
  }
  std::vector<const CampaignRig*> rigs;
  for (const CampaignRig& rig : all.rigs) rigs.push_back(&rig);
  UnitStore store(CampaignStatePath(options), StateHeader());
  RunRigs(spec, rigs, options, store, rows);
  return rows;
}

int RunCampaignCommand(const Options& options) {
  if (const std::optional<Shard> shard = ShardOf(options)) return RunCampaignShard(options, *shard);
  const CampaignSpec spec = LoadCampaign(options.config);
  const CampaignRigs all = MakeRigs(spec, options.seed, options.out);
  if (!options.Has(kTableOption)) CheckFirst(all);
  const Units found = RowsOf(spec, all, options);
  RigRows rows;
  for (const CampaignRig& rig : all.rigs) {
    const auto row = found.find(KeyOf(rig));
    if (row != found.end()) rows.push_back(nlohmann::ordered_json::parse(row->second));
  }
  const nlohmann::ordered_json summary = CampaignJson(spec, all, rows);
  WriteWholeFile(options.out / kCampaignCsv, CampaignCsv(spec, all, rows));
  WriteWholeFile(options.out / kCampaignPointsCsv, CampaignPointsCsv(rows));
  WriteWholeFile(options.out / "campaign.json", summary.dump(2) + "\n");
  if (!options.quiet) PrintCampaign(summary, options.out);
  return summary["failed"] == 0 && summary["missing"].empty() ? kDone : kNegativeAnswer;
}

std::string CampaignInputsOf(const Options& options) {
  return CampaignSha256(LoadCampaign(options.config));
}

void AdoptCampaignUnits(const Options& options, const Units& units) {
  WriteWholeFile(CampaignStatePath(options), StoreText(StateHeader(), units));
}

}  // namespace

Command CampaignCommand() {
  return {"campaign",
          "run the same commands for many rigs, to one table",
          "CAMPAIGN.yaml names configs, or one config with a table of rigs or a grid of values,\n"
          "and the commands to run for each: simulate, analyse, fit, family, diagnose. Each rig\n"
          "has a folder in DIR/rigs; what is stored and has not changed is not run again.\n"
          "Writes campaign.csv, a row a rig; campaign_points.csv, a row for each quantity of\n"
          "each experiment; campaign.json. Exits with 1 where a rig has an error, which stands\n"
          "in its row.",
          {{kTableOption, "", "run nothing: the tables of what is stored"}, ShardOption()},
          RunCampaignCommand,
          false,
          "CAMPAIGN",
          Sharding{CampaignInputsOf, AdoptCampaignUnits, kTableOption},
          true};
}

}  // namespace howl
