// One diagnosis, from records to verdict: fit the base, try every effect, measure the gaps, weigh,
// conclude. Inner workings of diagnosis.h: search.cc fits, search_evidence.cc measures,
// search_own_delays.cc asks whether the delays differ, search_conclusion.cc concludes; diagnosis.cc
// chooses the base.
#ifndef HOWL_DIAGNOSIS_SEARCH_SEARCH_H_
#define HOWL_DIAGNOSIS_SEARCH_SEARCH_H_

#include <limits>
#include <optional>
#include <vector>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/candidates/effect_forms.h"
#include "diagnosis/gap/gap.h"
#include "diagnosis/gap/slack.h"
#include "diagnosis/search/diagnosis_options.h"
#include "diagnosis/verdict/diagnosis_result.h"
#include "diagnosis/verdict/verdict.h"

namespace howl {

// True where the gain by own delays is evidence that the experiments' delays differ; that shows in
// cut B alone.
bool DelaysDiffer(double own_delays_gain);

class Search {
 public:
  Search(const std::vector<DiagnosisExperiment>& experiments, const DiagnosisOptions& options);
  Diagnosis Run();
  // The gain of the best candidate, which may be negative; no value if the run was stopped.
  std::optional<double> LargestGain();

 private:
  void TakeLinesLeftOver();
  void TryAll();
  void Bootstrap();
  // From the bootstrap if there was one; else, where the best is weak, from a few replicates with
  // the best's unit alone.
  double GainOfNoiseForTheBest() const;
  Attempt Try(const EffectForms& forms) const;
  bool Stopped() const { return options_.stopped && options_.stopped(); }

  // The gap takes the least V_B that any fit leaves over.
  void MeasureGaps();
  void MeasureGap(Attempt* attempt) const;
  double PlaceboShrinkage(const Attempt& best) const;
  // The evidence with the best attempt, if there is any; `after` becomes the slack that it leaves.
  Evidence Look(const Attempt* top, Slack* after) const;

  // What the evidence amounts to once combinations were tried.
  struct Judgement {
    Evidence evidence;
    Belief belief;
    Slack after;
    std::optional<Attempt> together;
    double placebo_shrinkage = std::numeric_limits<double>::quiet_NaN();
  };
  Judgement Judge();
  bool Detected() const;
  // The gain by a delay of its own for each experiment, given the best attempt.
  double OwnDelaysGain() const;
  Diagnosis Conclude(const Evidence& evidence, const Belief& belief);
  // Fills in where the error is, how large it is, and what the base had absorbed of it.
  void Describe(const Judgement& at, Diagnosis* out);
  std::vector<Candidate> Candidates() const;

  const DiagnosisOptions& options_;
  std::vector<EffectForms> units_;
  std::vector<CutRecord> records_;
  std::vector<CoherentLine> lines_;
  std::optional<ReferenceModel> reference_;
  EffectFit base_;
  AttemptContext at_;
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

#endif  // HOWL_DIAGNOSIS_SEARCH_SEARCH_H_
