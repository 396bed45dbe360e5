// One reader for each section of a config that has passed the schema's check. Each states the rules
// that a schema cannot, and throws UserError where one is broken.
#ifndef HOWL_IO_CONFIG_SECTIONS_CONFIG_SECTIONS_H_
#define HOWL_IO_CONFIG_SECTIONS_CONFIG_SECTIONS_H_

#include <cstddef>
#include <set>
#include <string_view>
#include <vector>

#include "io/config/config.h"
#include "io/config/schema/config_cursor.h"
#include "io/user_error.h"

namespace howl {

// Reads on after a mistake in an experiment, to find all of them.
struct ExperimentMistakes {
  std::set<std::size_t>
      told;  // experiments of which a mistake is known: their names alone are read
  std::vector<UserError> found;
};

// The readers take the config's root and fill their part of `config`. With `mistakes` those of
// experiments are collected, and `told` holds all that have one; else the first is thrown.
void ReadExperiments(const ConfigCursor& root, Config& config,
                     ExperimentMistakes* mistakes = nullptr);
void ReadModel(const ConfigCursor& root, Config& config);  // `model`, `parameters`
// `model` where it states more than the paper's loop.
void ReadRecordLoop(const ConfigCursor& model, Config& config);
void ReadResiduals(const ConfigCursor& root, Config& config);  // after the experiments
void ReadFamily(const ConfigCursor& root, Config& config);
void ReadSolver(const ConfigCursor& root, Config& config);
void ReadAnalysis(const ConfigCursor& root, Config& config);
void ReadSimulation(const ConfigCursor& root, Config& config);
std::vector<SimulatedNoise> ReadNoiseSources(const ConfigCursor& simulation);
void ReadEffects(const ConfigCursor& root, Config& config);

RecordSpec ReadRecordSpec(const ConfigCursor& record, const std::filesystem::path& config_file);

// A path with ${NAME} replaced from the environment. Throws UserError at `file` for a name that is
// not set.
std::string ExpandEnvironment(const ConfigCursor& file);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_SECTIONS_CONFIG_SECTIONS_H_
