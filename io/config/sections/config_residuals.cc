#include <glog/logging.h>

#include <algorithm>

#include "estimation/residuals/registry.h"
#include "io/config/schema/schema_words.h"
#include "io/config/sections/config_sections.h"

namespace howl {
namespace {

LossKind LossOf(const std::string& name) {
  if (name == "huber") return LossKind::kHuber;
  if (name == "soft_l1") return LossKind::kSoftL1;
  if (name == "cauchy") return LossKind::kCauchy;
  if (name == "tukey") return LossKind::kTukey;
  CHECK_EQ(name, "none");
  return LossKind::kNone;
}

EquationForm FormOf(const std::string& name) {
  if (name == "full") return EquationForm::kFull;
  if (name == "reduced") return EquationForm::kReduced;
  CHECK_EQ(name, "auto");
  return EquationForm::kAuto;
}

void ReadNames(const ConfigCursor& list, const std::vector<std::string>& known,
               std::vector<std::string>& names) {
  for (const ConfigCursor& item : list.Items()) {
    const std::string& name = item.Node().text;
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      item.Fail("\"" + name + "\" is no experiment of this config, expected " +
                DescribeChoice(name, known));
    }
    names.push_back(name);
  }
}

void ReadResidual(const ConfigCursor& cursor, ResidualKind kind,
                  const std::vector<std::string>& known, ResidualSpec& spec) {
  if (cursor.Node().kind == LocatedNode::Kind::kBoolean) {
    spec.enabled = cursor.Node().boolean;
    return;
  }
  const ResidualDefinition& definition = DefinitionOf(kind);
  cursor.Read("enabled", spec.enabled);
  cursor.Read(std::string(definition.std.key), spec.std);
  if (!definition.center.key.empty()) {
    cursor.Read(std::string(definition.center.key), spec.center);
  }
  cursor.Read("weight", spec.weight);
  if (const auto loss = cursor.Find("loss")) spec.loss = LossOf(loss->Node().text);
  cursor.Read("loss_scale", spec.loss_scale);
  if (const auto form = cursor.Find("form")) spec.form = FormOf(form->Node().text);
  if (const auto names = cursor.Find("experiments")) ReadNames(*names, known, spec.experiments);
}

}  // namespace

void ReadResiduals(const ConfigCursor& root, Config& config) {
  const auto residuals = root.Find("residuals");
  if (!residuals) return;
  std::vector<std::string> known;
  for (const ExperimentConfig& each : config.experiments) known.push_back(each.experiment.name);
  residuals->Read("unreliable_weight", config.residuals.unreliable_weight);
  for (const ResidualKind kind : kResidualKinds) {
    const auto residual = residuals->Find(std::string(ResidualName(kind)));
    if (residual) ReadResidual(*residual, kind, known, config.residuals[kind]);
  }
}

}  // namespace howl
