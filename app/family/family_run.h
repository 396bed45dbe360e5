// The results of `howl family` before they are written and printed.
#ifndef HOWL_APP_FAMILY_FAMILY_RUN_H_
#define HOWL_APP_FAMILY_FAMILY_RUN_H_

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line/options.h"
#include "app/jobs/shard.h"
#include "estimation/family/answers/conflict/conflict.h"
#include "estimation/family/answers/predict/predict.h"
#include "estimation/family/answers/tradeoff.h"
#include "estimation/family/bounds/enclose.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/sample.h"
#include "io/config/config.h"
#include "io/results/family/family_json.h"

namespace howl {

struct FamilyRun {
  FamilyProblem problem;
  std::vector<BoundedExpression> bounded;  // of the config's predictions
  std::unique_ptr<Enclosure> enclosure;
  std::vector<Member> members;  // as listed
  SampleDiagnostics diagnostics;
  std::vector<Member> sample;         // drawn uniformly, for predictions and advice
  Conflict conflict;                  // when there is no member
  std::vector<std::string> recorded;  // experiments whose data a record gives
  std::vector<TradeoffPoint> tradeoff;
  std::vector<ExperimentPrediction> predictions;
  std::optional<FurtherTest> falsified;
  std::optional<std::vector<Advice>> advice;
  std::optional<TransferReport> transfer;  // where the test looks at records' transfers
  std::optional<ProfileReport> profile;    // where it was asked for
};

// Bounds, members, trade-off, predictions. Throws UserError for an expression that does not parse
// and Interrupted when the user asks for a stop.
FamilyRun RunFamily(const Config& config, const Options& options);

// The shard's share of the searches for bounds (app/family/bounds_run.h); what follows them is the
// merge's.
void RunFamilyShard(const Config& config, const Options& options, const Shard& shard);

// Throws UserError for the first expression of the config that does not parse.
void CheckPredictions(const Config& config, const FamilyProblem& problem);

// The same of experiments that were read already, without the trade-off and with nothing saved on
// the way.
FamilyRun RunFamilyAnew(const Config& config, const Options& options,
                        std::vector<Experiment> experiments);

// The results that are written of a run.
FamilyReport ReportOf(const Config& config, const FamilyRun& run);

}  // namespace howl

#endif  // HOWL_APP_FAMILY_FAMILY_RUN_H_
