#include "diagnosis/plan/plan.h"

#include <algorithm>
#include <utility>

#include "diagnosis/plan/planner.h"
#include "diagnosis/search/choose_modes.h"

namespace howl {
namespace {

// Of a longer record the beginning is looked at, and counts for the whole: what an effect changes
// grows with the record's length.
constexpr std::size_t kLongestRecord = 32768;

std::vector<DiagnosisExperiment> Shortened(const std::vector<DiagnosisExperiment>& experiments,
                                           std::vector<double>* scales) {
  std::vector<DiagnosisExperiment> out = experiments;
  for (DiagnosisExperiment& each : out) {
    Record& record = each.record;
    const auto whole = static_cast<double>(record.pressure.size());
    record.pressure.resize(std::min(record.pressure.size(), kLongestRecord));
    record.heat_release.resize(record.pressure.size());
    scales->push_back(whole / static_cast<double>(record.pressure.size()));
  }
  return out;
}

}  // namespace

Plan MakePlan(const std::vector<DiagnosisExperiment>& experiments, const PlanOptions& options) {
  std::vector<double> scales;
  std::vector<DiagnosisExperiment> parts = Shortened(experiments, &scales);
  PlanOptions chosen = options;
  if (options.choose_modes) chosen.model.modes = ChooseModes(parts, options.model).modes;
  return Planner(std::move(parts), std::move(scales), chosen).Run();
}

}  // namespace howl
