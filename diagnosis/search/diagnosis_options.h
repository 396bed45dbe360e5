// What a diagnosis is asked for, beside the rig's records.
#ifndef HOWL_DIAGNOSIS_SEARCH_DIAGNOSIS_OPTIONS_H_
#define HOWL_DIAGNOSIS_SEARCH_DIAGNOSIS_OPTIONS_H_

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "diagnosis/fit/fit_memory.h"
#include "diagnosis/records/cut_record.h"
#include "model/effects/effect.h"

namespace howl {

struct DiagnosisOptions {
  BaseModel model;
  bool choose_modes = false;   // by the records, whatever the model says
  bool choose_delays = false;  // the same: one for all, or each experiment's own
  int threads = 0;             // 0: as many as the machine has
  std::uint64_t seed = 1;      // of the bootstrap's replicates
  std::size_t bootstrap = 0;   // replicates (bootstrap/bootstrap.h)
  // Where it is set, only these replicates are run, for the memory, and the diagnosis then ends as
  // if it had been stopped: one of several processes' shares.
  std::function<bool(std::size_t replicate)> owns_replicate;
  std::vector<std::string> withheld;   // identifiers of the catalogue that are not tried
  std::vector<EffectPointer> further;  // effects of the user's own
  // Records that take the model's place (reference.h); none: the base alone is the model.
  std::vector<DiagnosisExperiment> reference;
  // Progress in starts of the search, of which an effect has a few or many.
  std::function<void(std::size_t done, std::size_t total)> progress;
  std::function<void(std::size_t done, std::size_t total)> bootstrap_progress;
  FitUnits* memory = nullptr;     // of an interrupted run of the same inputs
  std::function<bool()> stopped;  // asked between effects
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SEARCH_DIAGNOSIS_OPTIONS_H_
