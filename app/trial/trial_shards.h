// A trial in shards: each makes, seals and diagnoses its share of the cases. A shard's units are
//
//   seal#3-of-16, key#..., log#...   its seal, its enciphered key, and its log
//   diagnosis#case017                     a case's diagnosis.json, where one was reached
//
// The key stays enciphered until howl merge has all shards, checks their seals, and opens it once.
#ifndef HOWL_APP_TRIAL_TRIAL_SHARDS_H_
#define HOWL_APP_TRIAL_TRIAL_SHARDS_H_

#include <filesystem>
#include <string>

#include "app/command_line/options.h"
#include "app/jobs/shard.h"
#include "app/jobs/unit_store.h"
#include "app/trial/trial_run.h"

namespace howl {

// SHA-256 of the config, of what is asked for, and of the program that makes the rigs.
std::string TrialInputsSha256(const TrialRequest& request);

// cases/ and diagnoses/ in `out`, which all shards share; the rest in a folder of the shard's own.
TrialFolder FolderOfShard(const std::filesystem::path& out, const Shard& shard);

Units UnitsOfShard(const TrialFolder& folder, const Shard& shard, const TrialLog& log);

// Writes key, seal, log and diagnoses of the whole trial. Throws UserError where a shard's key
// cannot be opened or its log is broken.
void AdoptTrialShards(const Options& options, const Units& units);

}  // namespace howl

#endif  // HOWL_APP_TRIAL_TRIAL_SHARDS_H_
