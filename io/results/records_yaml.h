// records.yaml: a config for records that howl simulate wrote beside it.
#ifndef HOWL_IO_RESULTS_RECORDS_YAML_H_
#define HOWL_IO_RESULTS_RECORDS_YAML_H_

#include <string>
#include <vector>

#include "estimation/analysis/loop/experiment.h"
#include "io/config/config.h"

namespace howl {

// Each experiment's record is NAME.csv with columns p and q; the model is the config's.
std::string RecordsYaml(const Config& config, const std::vector<Experiment>& experiments,
                        double sampling_hz);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_RECORDS_YAML_H_
