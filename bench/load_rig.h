// The records that a config names, for studies.
#ifndef HOWL_BENCH_LOAD_RIG_H_
#define HOWL_BENCH_LOAD_RIG_H_

#include <algorithm>
#include <string>
#include <vector>

#include "bench/measured_rig.h"
#include "io/config/config.h"
#include "io/records/records.h"

namespace howl {

// The records of the config's experiments that are named, or of all where none is.
inline MeasuredRig LoadRig(const Config& config, const std::vector<std::string>& names = {}) {
  MeasuredRig rig;
  for (const ExperimentConfig& each : config.experiments) {
    if (!names.empty() && std::ranges::find(names, each.experiment.name) == names.end()) continue;
    rig.push_back({each.experiment.name, each.experiment.phi,
                   LoadRecord(*each.record, config.source.string(), each.record_line)});
  }
  return rig;
}

}  // namespace howl

#endif  // HOWL_BENCH_LOAD_RIG_H_
