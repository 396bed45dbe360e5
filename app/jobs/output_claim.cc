#include "app/jobs/output_claim.h"

#include "io/whole_file.h"

namespace howl {

OutputClaim::OutputClaim(const std::filesystem::path& out, const std::string& command,
                         const std::optional<Shard>& shard)
    : folder_(out, ".howl.lock", shard ? OutputLock::Kind::kTogether : OutputLock::Kind::kAlone,
              "howl " + command) {
  const std::filesystem::path shards = ShardFolder(out);
  if (!shard) {
    RemoveUnpublished(out);
    RemoveUnpublished(shards);
    return;
  }
  const std::string own = shard->Name() + "." + command;
  shard_.emplace(shards, own + ".lock", OutputLock::Kind::kAlone,
                 "howl " + command + " --shard " + shard->Name());
  RemoveUnpublished(shards, own);
}

}  // namespace howl
