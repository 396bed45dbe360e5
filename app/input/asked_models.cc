#include "app/input/asked_models.h"

#include <string>

#include "app/input/config_fit.h"
#include "estimation/fit/joint_fit.h"
#include "io/result_files.h"
#include "io/results/family/family_csv.h"

namespace howl {
namespace {

constexpr int kMostMembers = 100000000;

}  // namespace

std::optional<int> AskedMember(const Options& options) {
  return options.Count("--member", 1, kMostMembers);
}

std::vector<LoopModel> AskedModels(const Config& config, const Options& options,
                                   const std::vector<Experiment>& experiments) {
  const std::optional<int> number = AskedMember(options);
  if (!number) {
    const JointProblem problem = MakeJointProblem(config, experiments);
    return SolveConfig(config, options, problem).models;
  }
  const FamilyTable table = ReadFamilyCsv(options.out / kFamilyCsv);
  if (*number > static_cast<int>(table.rows.size())) {
    throw UsageError("--member: " + std::to_string(*number) + ", expected at most " +
                     std::to_string(table.rows.size()) + ", the members of family.csv");
  }
  const std::vector<double>& row = table.rows[static_cast<std::size_t>(*number - 1)];
  std::vector<LoopModel> models;
  for (const Experiment& experiment : experiments) {
    const auto value = [&](const char* column) {
      return row[table.Column(experiment.name + "." + column)];
    };
    models.push_back({.omega_hz = value("omega_hz"),
                      .xi = value("xi"),
                      .N = value("N"),
                      .M = value("M"),
                      .tau_s = value("tau_s"),
                      .harmonic_ratio = config.model.harmonic_ratio});
  }
  return models;
}

}  // namespace howl
