// The records of a diagnosis. Mistakes throw UserError.
#ifndef HOWL_APP_INPUT_DIAGNOSE_INPUT_H_
#define HOWL_APP_INPUT_DIAGNOSE_INPUT_H_

#include <memory>
#include <string>
#include <vector>

#include "diagnosis/records/cut_record.h"
#include "estimation/analysis/analyse.h"
#include "io/config/config.h"
#include "model/effects/declared_effect.h"

namespace howl {

// Reads both signals of every experiment, and checks that they are long enough for the two cuts.
std::vector<DiagnosisExperiment> LoadDiagnosisExperiments(const Config& config);

// The same of records that were read already: those of `config`, in its order.
std::vector<DiagnosisExperiment> MakeDiagnosisExperiments(const Config& config,
                                                          std::vector<NamedRecord> records);

// The effects that the config declares.
std::vector<std::shared_ptr<const DeclaredEffect>> DeclaredEffectsOf(const Config& config);

// The loop that the config states for every command. Each experiment has a delay of its own unless
// tau_s is shared.
BaseModel BaseOf(const Config& config);

// Whether the config states `modes`, and the scope of tau_s; if not, the records choose.
bool StatesModes(const Config& config);
bool StatesDelays(const Config& config);

// Of the paper's loop as a budget begins with it: the config's, or two, of which the second comes
// to nothing on a rig with one.
int ModesOfLoop(const Config& config);

// Operating points are found by name or parameter, and interpolated in between.
void CheckReference(const Config& config, const Config& reference,
                    const std::vector<DiagnosisExperiment>& rig,
                    const std::vector<DiagnosisExperiment>& model);

// The bytes that identify what a state file belongs to: the config's text (it has the effects and
// the model), the effects that are left out, and every number.
std::string InputBytes(const Config& config, const std::vector<std::string>& withheld,
                       const std::vector<DiagnosisExperiment>& rig,
                       const std::vector<DiagnosisExperiment>& reference);

}  // namespace howl

#endif  // HOWL_APP_INPUT_DIAGNOSE_INPUT_H_
