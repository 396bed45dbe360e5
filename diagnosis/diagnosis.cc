#include "diagnosis/diagnosis.h"

#include <limits>

#include "diagnosis/search/choose_modes.h"
#include "diagnosis/search/search.h"

namespace howl {
Diagnosis Diagnose(const std::vector<DiagnosisExperiment>& experiments,
                   const DiagnosisOptions& options) {
  DiagnosisOptions chosen = options;
  double second_mode_gain = std::numeric_limits<double>::quiet_NaN();
  if (options.choose_modes) {
    const ModesChoice choice = ChooseModes(experiments, options.model);
    chosen.model.modes = choice.modes;
    second_mode_gain = choice.second_mode_gain;
  }
  if (options.choose_delays) chosen.model.own_delays = false;
  Diagnosis out = Search(experiments, chosen).Run();
  const double own_delays_gain = out.own_delays_gain;
  if (DelaysDiffer(own_delays_gain)) {
    // A second search of one run keeps its fits under names of its own.
    UnitsOfPart memory(options.memory, "own_delays.");
    if (options.memory) chosen.memory = &memory;
    chosen.choose_delays = false;
    chosen.model.own_delays = true;
    out = Search(experiments, chosen).Run();
    out.own_delays_gain = own_delays_gain;
  }
  out.second_mode_gain = second_mode_gain;
  return out;
}

}  // namespace howl
