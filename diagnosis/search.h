// One diagnosis, from records to verdict: fit the base, try every effect, measure the gaps, weigh,
// conclude. Inner workings of diagnosis.h: search.cc fits, search_evidence.cc measures,
// diagnosis.cc concludes.
#ifndef HOWL_DIAGNOSIS_SEARCH_H_
#define HOWL_DIAGNOSIS_SEARCH_H_

#include <optional>
#include <vector>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/gap.h"
#include "diagnosis/pair.h"
#include "diagnosis/slack.h"
#include "diagnosis/verdict.h"

namespace howl {

class Search {
 public:
  Search(const std::vector<DiagnosisExperiment>& experiments, const DiagnosisOptions& options);
  Diagnosis Run();
  // The best candidate's, or less than nothing; no value if stopped.
  std::optional<double> LargestGain();

 private:
  void TakeLinesLeftOver();
  void TryAll();
  void Bootstrap();
  // By the bootstrap if there was one; else, where the best is weak, by a few replicates of it.
  double GainOfNoiseForTheBest() const;
  Attempt Try(const EffectForms& forms) const;
  bool Stopped() const { return options_.stopped && options_.stopped(); }

  // V_B of the gap: the least that any fit leaves over.
  void MeasureGaps();
  void MeasureGap(Attempt* attempt) const;
  double ShrinkageByNoMeaning(const Attempt& best) const;
  // With the best attempt, if there is any; `after`: the slack that it leaves.
  Evidence Look(const Attempt* top, Slack* after) const;

  bool Detected() const;
  Diagnosis Conclude(const Evidence& evidence, const Belief& belief);

  const DiagnosisOptions& options_;
  std::vector<EffectForms> units_;
  std::vector<CutRecord> records_;
  std::vector<CoherentLine> lines_;
  std::optional<ReferenceModel> reference_;
  EffectFit base_;
  Setting at_;
  Slack slack_before_;
  LineOrigin origin_;
  GainFluctuation fluctuation_;
  std::vector<Attempt> attempts_;
  std::vector<double> bootstrap_gains_;
  double gain_of_noise_ = 0.0;
  std::vector<Eigen::VectorXd> flame_noise_;
  GapParts gap_before_;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SEARCH_H_
