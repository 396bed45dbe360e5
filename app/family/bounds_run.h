// Runs the search for guaranteed bounds so that nothing it has found is lost: the state is saved
// beside the results every few seconds and when the user interrupts, and a later run of the same
// problem goes on from it.
#ifndef HOWL_APP_FAMILY_BOUNDS_RUN_H_
#define HOWL_APP_FAMILY_BOUNDS_RUN_H_

#include <string>

#include "app/command_line/options.h"
#include "app/jobs/shard.h"
#include "app/jobs/unit_store.h"
#include "estimation/family/bounds/enclose.h"
#include "io/config/config.h"

namespace howl {

// Throws Interrupted after saving. The state file stays until ForgetBounds, so that what comes
// after the search can be interrupted as well.
void RunBounds(const Config& config, const Options& options, Enclosure& enclosure);

// Runs the shard's share of the searches, and leaves them in the shard's file: the head of the
// state under the key "head", each search under "search#000017".
void RunBoundsShard(const Config& config, const Options& options, const Shard& shard,
                    Enclosure& enclosure);

// SHA-256 of all that the searches depend on beside the options and the program.
std::string FamilyInputsSha256(const Config& config, const Options& options);

// Leaves the searches of all shards where an interrupted run would have left them.
void AdoptBounds(const Options& options, const Units& units);

// Throws Interrupted when the user has asked for a stop: between the steps that follow the search.
void StopIfInterrupted(const Options& options);

// Removes the state file; to be called when the results are written.
void ForgetBounds(const Options& options);

}  // namespace howl

#endif  // HOWL_APP_FAMILY_BOUNDS_RUN_H_
