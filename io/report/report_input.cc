#include "io/report/report_input.h"

#include <algorithm>

namespace howl {

Estimate EstimateAt(const nlohmann::json& json, const char* key) {
  if (!json.is_object() || !json.contains(key)) return {};
  return {NumberAt(json[key], "value"), NumberAt(json[key], "std")};
}

bool ReportInput::FamilyIsEmpty() const {
  return family.is_object() && family.contains("counts") &&
         NumberAt(family["counts"], "members") == 0.0;
}

const MeasuredPoint* ReportInput::Measured(const std::string& name) const {
  const auto found = std::ranges::find(measured, name, &MeasuredPoint::name);
  return found == measured.end() ? nullptr : &*found;
}

const ExperimentModel* ReportInput::Fitted(const std::string& name) const {
  const auto found = std::ranges::find(fitted, name, &ExperimentModel::name);
  return found == fitted.end() ? nullptr : &*found;
}

const NamedRecord* ReportInput::RecordOf(const std::string& name) const {
  const auto found = std::ranges::find(records, name, &NamedRecord::name);
  return found == records.end() ? nullptr : &*found;
}

const NamedRecord* ReportInput::SimulatedOf(const std::string& name) const {
  const auto found = std::ranges::find(simulated, name, &NamedRecord::name);
  return found == simulated.end() ? nullptr : &*found;
}

const MeasuredPoint* ReportInput::Reference() const {
  const MeasuredPoint* best = nullptr;
  int best_score = 0;
  for (const MeasuredPoint& point : measured) {
    const int score = (point.has_cycle() ? 1 : 0) + (point.has_cycle() && point.reliable ? 1 : 0) +
                      (point.has_cycle() && Fitted(point.name) != nullptr ? 2 : 0);
    if (score > best_score) {
      best = &point;
      best_score = score;
    }
  }
  return best;
}

std::string ReportInput::OperatingLabel() const {
  if (operating_parameter == "phi") return "equivalence ratio φ";
  const std::size_t unit = operating_parameter.rfind('_');
  if (unit == std::string::npos) return operating_parameter;
  std::string words = operating_parameter.substr(0, unit);
  std::ranges::replace(words, '_', ' ');
  return words + " (" + operating_parameter.substr(unit + 1) + ")";
}

}  // namespace howl
