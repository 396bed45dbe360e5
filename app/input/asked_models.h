// The loops that a command asks for: the joint fit's, or one member's with --member K.
#ifndef HOWL_APP_INPUT_ASKED_MODELS_H_
#define HOWL_APP_INPUT_ASKED_MODELS_H_

#include <optional>
#include <vector>

#include "app/command_line/options.h"
#include "estimation/analysis/loop/experiment.h"
#include "estimation/parameters.h"
#include "io/config/config.h"

namespace howl {

std::optional<int> AskedMember(const Options& options);

// One for each experiment. Throws UsageError where family.csv has no such member.
std::vector<LoopModel> AskedModels(const Config& config, const Options& options,
                                   const std::vector<Experiment>& experiments);

}  // namespace howl

#endif  // HOWL_APP_INPUT_ASKED_MODELS_H_
