#include "app/input/diagnose_input.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <utility>

#include "app/input/record_input.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/records/cut_record.h"
#include "io/user_error.h"

namespace howl {

std::vector<DiagnosisExperiment> LoadDiagnosisExperiments(const Config& config) {
  return MakeDiagnosisExperiments(config, LoadRecords(config));
}

std::vector<DiagnosisExperiment> MakeDiagnosisExperiments(const Config& config,
                                                          std::vector<NamedRecord> records) {
  const std::string file = config.source.string();
  std::vector<DiagnosisExperiment> experiments;
  for (NamedRecord& named : records) {
    if (named.record.heat_release.empty()) {
      throw UserError(file, config.experiments.front().line, "heat_release",
                      named.name +
                          " has pressure alone, expected both signals: the diagnosis cuts "
                          "the loop between them");
    }
    experiments.push_back({named.name, named.phi, std::move(named.record)});
  }
  if (experiments.empty()) {
    throw UserError(file, config.experiments.front().line, "experiments",
                    "no experiment has a record, expected at least one to diagnose");
  }
  if (const std::optional<CutObstacle> obstacle = FindCutObstacle(experiments)) {
    const std::string& name = experiments[obstacle->experiment].name;
    throw UserError(file, ExperimentNamed(config, name).record_line, "record",
                    name + " " + obstacle->what);
  }
  return experiments;
}

std::vector<std::shared_ptr<const DeclaredEffect>> DeclaredEffectsOf(const Config& config) {
  std::vector<std::shared_ptr<const DeclaredEffect>> out;
  for (const EffectDeclaration& declaration : config.effects) {
    out.push_back(std::make_shared<const DeclaredEffect>(declaration));
  }
  return out;
}

BaseModel BaseOf(const Config& config) {
  return {.modes = config.model.modes,
          .harmonic_ratio = config.model.harmonic_ratio,
          .own_delays = config.model[ParameterKind::kTau].scope == ParameterScope::kExperiment};
}

namespace {

bool States(const Config& config, std::initializer_list<const char*> path) {
  const LocatedNode* at = &config.tree;
  for (const char* const key : path) {
    const LocatedMember* const member = at->Find(key);
    if (member == nullptr) return false;
    at = &member->value;
  }
  return true;
}

}  // namespace

bool StatesModes(const Config& config) { return States(config, {"model", "modes"}); }

int ModesOfLoop(const Config& config) { return StatesModes(config) ? config.model.modes : 2; }

bool StatesDelays(const Config& config) { return States(config, {"parameters", "tau_s", "scope"}); }

void CheckReference(const Config& config, const Config& reference,
                    const std::vector<DiagnosisExperiment>& rig,
                    const std::vector<DiagnosisExperiment>& model) {
  const std::string file = reference.source.string();
  const int line = reference.experiments.front().line;
  if (config.operating_parameter != reference.operating_parameter) {
    throw UserError(file, line, "operating_parameter",
                    "is " + reference.operating_parameter + " here, expected " +
                        config.operating_parameter + " as in " + config.source.string());
  }
  const auto [low, high] = std::minmax_element(
      model.begin(), model.end(),
      [](const DiagnosisExperiment& a, const DiagnosisExperiment& b) { return a.phi < b.phi; });
  for (const DiagnosisExperiment& each : rig) {
    const bool named =
        std::any_of(model.begin(), model.end(),
                    [&](const DiagnosisExperiment& other) { return other.name == each.name; });
    if (named || (each.phi >= low->phi && each.phi <= high->phi)) continue;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", each.phi);
    throw UserError(file, line, "experiments",
                    "have none called " + each.name + ", and none on both sides of its " +
                        config.operating_parameter + " " + text.data() +
                        ", expected one or the other");
  }
}

std::string InputBytes(const Config& config, const std::vector<std::string>& withheld,
                       const std::vector<DiagnosisExperiment>& rig,
                       const std::vector<DiagnosisExperiment>& reference) {
  std::ifstream file(config.source, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  for (const std::string& id : withheld) text << id << "\n";
  for (const std::vector<DiagnosisExperiment>* each : {&rig, &reference}) {
    text << each->size() << "\n";
    for (const DiagnosisExperiment& experiment : *each) {
      const Record& record = experiment.record;
      text << experiment.name << " " << record.pressure.size() << "\n";
      for (const double number : {experiment.phi, record.sampling_hz}) {
        text.write(reinterpret_cast<const char*>(&number), sizeof number);
      }
      for (const std::vector<double>* signal : {&record.pressure, &record.heat_release}) {
        text.write(reinterpret_cast<const char*>(signal->data()),
                   static_cast<std::streamsize>(signal->size() * sizeof(double)));
      }
    }
  }
  return text.str();
}

}  // namespace howl
