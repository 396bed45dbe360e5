// The planning of one rig (plan.h): planner.cc looks at each effect, planner_pairs.cc at what would
// separate those that are not told apart.
#ifndef HOWL_DIAGNOSIS_PLAN_PLANNER_H_
#define HOWL_DIAGNOSIS_PLAN_PLANNER_H_

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/plan/plan.h"
#include "diagnosis/plan/plan_table.h"
#include "diagnosis/plan/plan_trials.h"

namespace howl {

// Inner workings of MakePlan; the options must outlive it.
class Planner {
 public:
  // scales: what each experiment's record counts for, as WeighedPoint has it.
  Planner(std::vector<DiagnosisExperiment> experiments, std::vector<double> scales,
          const PlanOptions& options);
  Plan Run();

 private:
  std::vector<WeighedPoint> PointsOf(const std::vector<CutRecord>& records, const EffectFit& fit,
                                     double scale) const;
  PlannedSize SizeOf(std::size_t line) const;
  // The effect's lines, the one of median smallest size first.
  std::vector<std::size_t> LinesOf(const std::string& id) const;
  PlannedEffect Planned(const std::vector<std::size_t>& lines) const;
  std::vector<PlannedRival> RivalsOf(std::size_t line) const;
  PlannedRival Against(std::size_t line, const std::string& rival) const;
  void FindPairs(Plan* plan) const;
  // The nats between entry i of `line` and the rival, with a trial measurement made.
  PlannedTrial Tried(const TrialMeasurement& trial, std::size_t line,
                     const std::string& rival) const;

  const PlanOptions& options_;
  std::vector<DiagnosisExperiment> experiments_;
  std::vector<double> scales_;
  std::vector<EffectPointer> catalogue_;
  std::vector<CutRecord> records_;
  EffectFit base_;
  PlanTable table_;
  std::optional<PlanGains> gains_;
  std::vector<std::string> transfer_;          // identifiers, in the catalogue's order
  std::map<std::string, std::size_t> median_;  // line of each
};

// Groups the plan's effects that are not told apart at their reference sizes.
void FindClasses(Plan* plan);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PLAN_PLANNER_H_
