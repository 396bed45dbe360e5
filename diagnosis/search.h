// One diagnosis, from records to verdict: fit the base, try every effect, measure the gaps, weigh,
// conclude. Inner workings of diagnosis.h: search.cc fits, search_repair.cc takes saturation out of
// p first, search_evidence.cc measures, diagnosis.cc concludes; diagnose.cc chooses the base.
#ifndef HOWL_DIAGNOSIS_SEARCH_H_
#define HOWL_DIAGNOSIS_SEARCH_H_

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/gap.h"
#include "diagnosis/pair.h"
#include "diagnosis/slack.h"
#include "diagnosis/verdict.h"

namespace howl {

// Saturation of p is detected without a model and taken out of the samples before the search for
// anything else. What the base does not explain in the repaired records is due to another effect.
struct PressureRepair {
  Candidate clipping;
  std::vector<CutRecord> recorded;
  EffectFit recorded_base;
  Slack recorded_slack;
  std::vector<ExperimentFit> recorded_held_out;
  std::vector<DiagnosisExperiment> experiments;  // repaired
};

// Own delays show in cut B alone.
bool DelaysDiffer(double own_delays_gain);

class Search {
 public:
  Search(const std::vector<DiagnosisExperiment>& experiments, const DiagnosisOptions& options);
  Diagnosis Run();
  // The best candidate's, or less than nothing; no value if stopped.
  std::optional<double> LargestGain();

 private:
  void TakeLinesLeftOver();
  void RepairPressure();
  // With p's plateaus filled in under the fit itself, instead of the base.
  struct RefilledFit {
    EffectFit fit;
    std::shared_ptr<const std::vector<CutRecord>> records;
  };
  RefilledFit Refill(const EffectFit& under_base) const;
  Attempt Refilled(const Attempt& attempt, const EffectForms& forms) const;
  void RefillBest();
  void TryEach();
  // With a reference, the gain that saturation alone gives a transfer function is no evidence of
  // it.
  void SubtractSpuriousGain(bool pressure);
  void TryAll();
  void Bootstrap();
  // By the bootstrap if there was one; else, where the best is weak, by a few replicates of it.
  double GainOfNoiseForTheBest() const;
  Attempt Try(const EffectForms& forms) const;
  bool Stopped() const { return options_.stopped && options_.stopped(); }

  // V_B of the gap: the least that any fit leaves over.
  void MeasureGaps();
  void MeasureGap(Attempt* attempt) const;
  double PlaceboShrinkage(const Attempt& best) const;
  // With the best attempt, if there is any; `after`: the slack that it leaves.
  Evidence Look(const Attempt* top, Slack* after) const;

  // What the evidence comes to, once combinations were tried.
  struct Judgement {
    Evidence evidence;
    Belief belief;
    Slack after;
    std::optional<Attempt> together;
    double placebo_shrinkage = std::numeric_limits<double>::quiet_NaN();
  };
  Judgement Judge();
  bool Detected() const;
  // What delays of the experiments' own take off beside the best attempt.
  double OwnDelaysGain() const;
  Diagnosis Conclude(const Evidence& evidence, const Belief& belief);
  // Where, how much, and what the base had absorbed.
  void Describe(const Judgement& at, Diagnosis* out);
  std::vector<Candidate> Candidates() const;
  // The clipping that was repaired, before whatever was found beside it.
  void AddClipping(Diagnosis* diagnosis);

  const DiagnosisOptions& options_;
  std::vector<EffectForms> units_;
  std::vector<CutRecord> records_;
  std::vector<CoherentLine> lines_;
  std::optional<ReferenceModel> reference_;
  EffectFit base_;
  std::optional<PressureRepair> repair_;
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
