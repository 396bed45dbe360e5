// What points say of one another's new values, against fits under the law that they give.
#include "diagnosis/loop_budget/trials/law_of_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/trials/loop_trial.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::law_of_trial_test {
namespace {

struct Trial {
  LoopRecords records;
  LoopFit from;
  LoopForm with;
  std::vector<PointPrior> wide;
  std::vector<PointFit> fits;
};

// Six ducts with this item, which they do not need, each fitted by itself.
Trial TrialOf(const std::string& id) {
  const LoopBudgetOptions options = Among({id});
  Trial out;
  out.records = LoopRecords(DuctsAt({1.2, 1.3, 1.4, 1.5, 1.6, 1.7}), 0);
  out.from = DuctsFit(out.records, options);
  const LoopItem item = *std::ranges::find(AllLoopItems(), id, &LoopItem::id);
  out.with = With(out.from.model, item);
  const std::vector<Eigen::VectorXd> starts =
      StartsWith(out.records, out.from, out.with, 0).rows[0];
  for (std::size_t e = 0; e < out.records.size(); ++e) {
    const RecordSpectra record = out.records.Whole(out.with, e);
    out.wide.push_back(PriorOfTrial(out.records, out.from, out.with, e, record));
    out.fits.push_back(FitPoint(record, out.with.structure, out.wide[e], starts[e]));
  }
  return out;
}

// A drift's value is small against its wide prior, and the same, zero, at all points.
TEST(LawOfTrial, GainsWhatFitsUnderItDo) {
  const Trial trial = TrialOf("slow_drift");
  RecordsFit fit;
  fit.structure = trial.with.structure;
  fit.reference = trial.from.fit.reference;
  fit.z = trial.from.fit.z;
  fit.points = trial.fits;
  fit.prior = trial.wide;
  const std::vector<PointPrior> of_others =
      PriorsOfOthers(trial.records.Points(trial.with), fit, 0);
  double expected = 0.0;
  for (std::size_t e = 0; e < trial.records.size(); ++e) {
    const RecordSpectra record = trial.records.Whole(trial.with, e);
    // The new values are those by which the two structures differ; the rest stays as it was.
    PointPrior prior = trial.wide[e];
    prior.degrees =
        Eigen::VectorXd::Constant(prior.mean.size(), std::numeric_limits<double>::infinity());
    prior.widest = prior.deviation;
    const PointStructure& structure = trial.with.structure;
    for (Eigen::Index k = 0; k < structure.AcousticChanges(); ++k) {
      const Eigen::Index i = structure.AcousticChange() + k;
      prior.mean[i] = of_others[e].mean[i];
      prior.deviation[i] = of_others[e].deviation[i];
      prior.degrees[i] = of_others[e].degrees[i];
      prior.widest[i] = of_others[e].widest[i];
    }
    expected +=
        FitPoint(record, trial.with.structure, prior, trial.fits[e].parameters).log_evidence -
        trial.fits[e].log_evidence;
  }
  ASSERT_GT(expected, 5.0);
  EXPECT_NEAR(GainedByLaw(trial.records, trial.from, trial.with, trial.fits, 0), expected,
              0.1 * expected);
}

}  // namespace
}  // namespace howl::law_of_trial_test
