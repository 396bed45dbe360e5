#include <array>
#include <cmath>
#include <cstdio>

#include "io/config/sections/config_sections.h"

namespace howl {
namespace {

std::string BoundText(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

void ReadParameter(const ConfigCursor& cursor, ParameterSpec& spec) {
  if (const auto scope = cursor.Find("scope")) {
    spec.scope =
        scope->Node().text == "shared" ? ParameterScope::kShared : ParameterScope::kExperiment;
  }
  cursor.Read("initial", spec.initial);
  cursor.Read("min", spec.min);
  cursor.Read("max", spec.max);
  cursor.Read("fixed", spec.fixed);
  if (!(spec.min < spec.max)) {
    const char* const key = cursor.Find("min") ? "min" : "max";
    cursor.FailAt(key, "min " + BoundText(spec.min) + (cursor.Find("min") ? "" : " (default)") +
                           " is not below max " + BoundText(spec.max) +
                           (cursor.Find("max") ? "" : " (default)") + ", expected min < max");
  }
  if (spec.initial && !(*spec.initial >= spec.min && *spec.initial <= spec.max)) {
    const std::string bounds = std::isinf(spec.max) ? "at least " + BoundText(spec.min) + " (min)"
                                                    : "from " + BoundText(spec.min) + " to " +
                                                          BoundText(spec.max) + " (min, max)";
    cursor.FailAt("initial",
                  BoundText(*spec.initial) + " is outside the bounds, expected " + bounds);
  }
  if (spec.fixed && !spec.initial) {
    cursor.FailAt("initial", "is missing, expected the value to hold, as fixed is true");
  }
}

void CheckSecondMode(const ConfigCursor& parameters, const ModelSpec& model) {
  const bool has_m = parameters.Find("M").has_value();
  const bool has_ratio = parameters.Find("M_over_N").has_value();
  if (has_m && has_ratio) {
    parameters.FailAt("M_over_N", "is given with M, expected only one of the two");
  }
  if (model.modes == 2 || (!has_m && !has_ratio)) return;
  parameters.FailAt(has_m ? "M" : "M_over_N",
                    "belongs to the second mode, but the model has one; expected modes: 2 under "
                    "model");
}

// A number that is stated must not be passed over: what a fit to whole records does not take, it
// does not accept.
void CheckTakenByRecords(const ConfigCursor& root) {
  for (const std::string key : {"parameters", "residuals"}) {
    if (!root.Find(key)) continue;
    root.FailAt(key,
                "is not taken by a loop that is fitted to whole records, as `model` states one; "
                "expected no such section");
  }
}

}  // namespace

void ReadModel(const ConfigCursor& root, Config& config) {
  if (const auto model = root.Find("model")) {
    config.model_line = model->Line();
    model->Read("harmonic_ratio", config.model.harmonic_ratio);
    ReadRecordLoop(*model, config);
  }
  if (config.record_loop) CheckTakenByRecords(root);
  const auto parameters = root.Find("parameters");
  if (!parameters) return;
  CheckSecondMode(*parameters, config.model);
  config.model.second_mode_relative = parameters->Find("M_over_N").has_value();
  for (const ParameterKind kind : kParameterKinds) {
    const auto parameter = parameters->Find(std::string(ParameterName(kind)));
    if (parameter) ReadParameter(*parameter, config.model[kind]);
  }
  for (const ExperimentConfig& each : config.experiments) {
    const std::string& name = each.experiment.name;
    for (const ParameterKind kind : kParameterKinds) {
      const std::string key = name + "." + std::string(ParameterName(kind));
      const auto parameter = parameters->Find(key);
      if (!parameter) continue;
      if (!config.model.Uses(kind)) {
        parameters->FailAt(key, "is not a parameter of this model, expected one that is");
      }
      if (config.model[kind].scope == ParameterScope::kShared) {
        parameters->FailAt(key, "is shared by all experiments, expected " +
                                    std::string(ParameterName(kind)) + ": {scope: experiment}");
      }
      OwnParameter& own =
          config.model.own.emplace_back(OwnParameter{name, kind, config.model[kind]});
      ReadParameter(*parameter, own.spec);
    }
  }
}

}  // namespace howl
