#include "diagnosis/search/choose_modes.h"

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/samples/coherent_lines.h"
#include "diagnosis/verdict/verdict.h"

namespace howl {
namespace {

double BaseCost(const std::vector<DiagnosisExperiment>& experiments, const BaseModel& model) {
  std::vector<CutRecord> records = MakeCutRecords(experiments, model);
  MaskLines(FindCoherentLines(records), &records);
  return FitBase(records).acoustic_cost;
}

}  // namespace

ModesChoice ChooseModes(const std::vector<DiagnosisExperiment>& experiments, BaseModel model) {
  model.modes = 1;
  const double one = BaseCost(experiments, model);
  model.modes = 2;
  const double two = BaseCost(experiments, model);
  const double gain = one - two - PriceOfParameters(static_cast<double>(experiments.size()));
  return {gain > DetectionGain(false) ? 2 : 1, gain};
}

}  // namespace howl
