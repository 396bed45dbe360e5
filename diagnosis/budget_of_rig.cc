#include "diagnosis/budget_of_rig.h"

#include <string>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/loop_budget/loop_budget.h"

namespace howl {
namespace {

constexpr double kPapersRatio = 3.0;

struct Stopped {};

class UnitsUntilStopped final : public UnitsOfPart {
 public:
  UnitsUntilStopped(FitUnits* memory, const std::function<bool()>& stopped)
      : UnitsOfPart(memory, "budget/"), stopped_(stopped) {}

  std::optional<std::string> Recall(const std::string& key) override {
    if (stopped_ && stopped_()) throw Stopped{};
    return UnitsOfPart::Recall(key);
  }

 private:
  const std::function<bool()>& stopped_;
};

}  // namespace

std::vector<LoopRecord> LoopRecordsOf(const std::vector<DiagnosisExperiment>& experiments) {
  const std::vector<CutRecord> cuts = MakeCutRecords(experiments);
  std::vector<LoopRecord> out;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    out.push_back({experiments[e].name, experiments[e].phi, cuts[e].at.cycle_frequency_hz,
                   experiments[e].record});
  }
  return out;
}

LoopForm PapersForm(int modes) {
  RecordLoopSpec spec;
  spec.modes = modes;
  if (modes > 1) spec.ratio = kPapersRatio;
  spec.own_damping = false;
  spec.complex_residues = false;
  return LeastForm(spec);
}

std::optional<Budget> BudgetOfRig(const std::vector<DiagnosisExperiment>& experiments, int modes,
                                  const DiagnosisOptions& options) {
  UnitsUntilStopped units(options.memory, options.stopped);
  LoopBudgetOptions how;
  how.seed = options.seed;
  how.threads = options.threads;
  how.units = &units;
  how.withheld = options.withheld;
  how.progress = options.budget_progress;
  try {
    return DiagnoseLoops(LoopRecordsOf(experiments), PapersForm(modes), how).diagnosis.budget;
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

}  // namespace howl
