#include "app/help/completion_values.h"

#include <algorithm>
#include <exception>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include "app/command_line/command_line.h"
#include "app/trial/trial_rig.h"
#include "diagnosis/diagnosis.h"
#include "estimation/family/problem/family_parameter.h"
#include "estimation/family/problem/membership.h"
#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "io/result_files.h"
#include "io/results/family/family_csv.h"
#include "trial/outcome.h"

namespace howl {
namespace {

using Names = std::vector<std::string>;

Names ExperimentNames(const ValueContext& context) {
  Names names;
  for (const ExperimentConfig& each : LoadConfig(context.config, LoopsTaken::kAny).experiments) {
    names.push_back(each.experiment.name);
  }
  return names;
}

Names Quantities(const ValueContext& context) {
  Names names;
  const Config config = LoadConfig(context.config, LoopsTaken::kAny);
  for (const ExperimentConfig& each : config.experiments) {
    for (const FamilyParameter parameter : kFamilyParameters) {
      if (parameter == FamilyParameter::kM && config.model.modes == 1) continue;
      names.push_back(each.experiment.name + "." + std::string(FamilyParameterName(parameter)));
    }
  }
  return names;
}

Names FamilyColumns(const ValueContext& context) {
  return ReadFamilyCsv(context.out / kFamilyCsv).columns;
}

// "-COLUMN" sorts descending.
Names SortColumns(const ValueContext& context) {
  Names names = FamilyColumns(context);
  if (!context.typed.starts_with('-')) return names;
  for (std::string& name : names) name.insert(0, 1, '-');
  return names;
}

Names CatalogueEffects(const ValueContext& /*context*/) {
  Names names;
  for (const EffectPointer& effect : Catalogue()) names.emplace_back(effect->id());
  std::ranges::sort(names);  // an effect may have several forms of one name
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Names TestConditions(const ValueContext& /*context*/) {
  Names names;
  for (const Condition condition : kConditions) names.emplace_back(ConditionName(condition));
  return names;
}

Names TrialEffects(const ValueContext& /*context*/) {
  Names names = {"catalogue", "none", "outside", "pairs"};
  for (const RigEffect& effect : ListRigEffects()) names.push_back(effect.id);
  return names;
}

Names Severities(const ValueContext& /*context*/) {
  Names names;
  for (const double severity : kSeverities) names.push_back(SeverityName(severity));
  return names;
}

Names LogLevels(const ValueContext& /*context*/) { return {"1", "2"}; }

// As they are named in the environment.
Names OptionNames(const ValueContext& context) {
  Names names;
  const auto take = [&](const std::vector<OptionHelp>& options) {
    for (const OptionHelp& each : options) {
      std::string name = each.name.substr(each.name.find_first_not_of('-'));
      std::ranges::replace(name, '-', '_');
      names.push_back(name);
    }
  };
  if (context.command != nullptr) take(context.command->options);
  take(CommonOptions());
  return names;
}

struct OptionValues {
  std::string_view option;
  std::string_view value;  // as its help has it: one name may take two kinds; empty: any
  Names (*names)(const ValueContext&);
  bool is_list;  // joined by commas
};

constexpr OptionValues kOptionValues[] = {{"--experiment", "", ExperimentNames, false},
                                          {"--profile", "", Quantities, false},
                                          {"--columns", "", FamilyColumns, true},
                                          {"--sort", "", SortColumns, false},
                                          {"--without", "EFFECTS", CatalogueEffects, true},
                                          {"--without", "CONDITION...", TestConditions, true},
                                          {"--effects", "", TrialEffects, true},
                                          {"--severities", "", Severities, true},
                                          {"--v", "", LogLevels, false},
                                          {"--fromenv", "", OptionNames, true},
                                          {"--tryfromenv", "", OptionNames, true},
                                          {"--undefok", "", OptionNames, true}};

Names TryNames(const OptionValues& values, const ValueContext& context) {
  try {
    return values.names(context);
  } catch (const std::exception&) {
    return {};  // a config that cannot be read; its own command will say so
  }
}

FileKind ValueFiles(const OptionHelp& option, const Command* command) {
  // Of howl init, --out is the config that it writes.
  if (option.name == "--out" && command != nullptr && command->name == "init") {
    return FileKind::kConfigs;
  }
  if (option.value == "DIR") return FileKind::kFolders;
  if (option.value == "FILE") return FileKind::kAny;
  return option.value.ends_with(".yaml") ? FileKind::kConfigs : FileKind::kNone;
}

}  // namespace

Completion ValuesOf(const OptionHelp& option, const ValueContext& context) {
  Completion values{{}, ValueFiles(option, context.command)};
  for (const OptionValues& each : kOptionValues) {
    if (each.option != option.name) continue;
    if (!each.value.empty() && each.value != option.value) continue;
    const std::size_t comma = each.is_list ? context.typed.rfind(',') : std::string::npos;
    const std::string before = comma == std::string::npos ? "" : context.typed.substr(0, comma + 1);
    for (const std::string& name : TryNames(each, context)) {
      values.words.push_back({before + name, ""});
    }
  }
  return values;
}

FileKind OperandFiles(const Command& command) {
  if (command.operands == "FOLDER") return FileKind::kFolders;
  return command.TakesSeveral() ? FileKind::kAny : FileKind::kConfigs;
}

}  // namespace howl
