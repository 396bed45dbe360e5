// What a run holds of its output folder: the lock of the folder, and that of its shard.
#ifndef HOWL_APP_JOBS_OUTPUT_CLAIM_H_
#define HOWL_APP_JOBS_OUTPUT_CLAIM_H_

#include <filesystem>
#include <optional>
#include <string>

#include "app/files/output_lock.h"
#include "app/jobs/shard.h"

namespace howl {

class OutputClaim {
 public:
  // Alone without a shard; shards have the folder together, each its own file of it alone. Removes
  // what a run that was killed left unfinished. Throws UserError.
  OutputClaim(const std::filesystem::path& out, const std::string& command,
              const std::optional<Shard>& shard);

 private:
  OutputLock folder_;
  std::optional<OutputLock> shard_;
};

}  // namespace howl

#endif  // HOWL_APP_JOBS_OUTPUT_CLAIM_H_
