// family.json, schema howl.family/1, and tradeoff.csv: what `howl family` found.
#ifndef HOWL_IO_RESULTS_FAMILY_FAMILY_JSON_H_
#define HOWL_IO_RESULTS_FAMILY_FAMILY_JSON_H_

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "estimation/family/answers/conflict/conflict.h"
#include "estimation/family/answers/family_profile.h"
#include "estimation/family/answers/predict/advise.h"
#include "estimation/family/answers/predict/predict.h"
#include "estimation/family/answers/tradeoff.h"
#include "estimation/family/bounds/enclose.h"
#include "estimation/family/members/sample.h"
#include "estimation/family/members/transfer_volume.h"

namespace howl {

struct ExperimentPrediction {
  std::string experiment;  // empty where the prediction joins several
  Prediction prediction;
};

// What further experiments say of the members drawn.
struct FurtherTest {
  std::string config;
  std::vector<std::string> experiments;
  SurvivalCounts counts;
};

// What the records' transfers do to the family.
struct TransferReport {
  TransferVolume volume;
  std::vector<Member> without;  // members of the family without them, spread
};

struct ProfileReport {
  std::string quantity;
  Profile profile;
};

struct FamilyReport {
  const FamilyProblem& problem;
  const Enclosure& enclosure;
  std::size_t members = 0;    // listed
  std::size_t requested = 0;  // by the config
  SampleDiagnostics diagnostics;
  const Conflict& conflict;
  const std::vector<std::string>& recorded;  // experiments whose data a record gives
  const std::vector<ExperimentPrediction>& predictions;
  const std::optional<FurtherTest>& falsified;       // where it was asked for
  const std::optional<std::vector<Advice>>& advice;  // where it was asked for
  const std::optional<TransferReport>& transfer;     // where the test looks at transfers
  const std::optional<ProfileReport>& profile;       // where it was asked for
};

// `experiments` are the characteristics that the test compares with, in the paper's units.
nlohmann::ordered_json FamilyJson(const FamilyReport& report);

// Of it, what a later run is compared with: the test, counts of members, bounds, predictions, and
// why there is no member. Not how the searches went (boxes, chains).
nlohmann::ordered_json FamilyFiguresJson(const FamilyReport& report);

// omega_spread,xi_max: the smallest largest-xi that any member has at that spread. Spreads without
// any member are left out.
std::string TradeoffCsv(std::span<const TradeoffPoint> points);

// value,cost,flagged and every experiment's parameters, one row a point: cost is the largest share
// of its tolerance that an error uses, one at the edge of the family.
std::string ProfileCsv(std::span<const Experiment> experiments, const Profile& profile);

// "edge" (cost one), "bound" (the farthest member), "failed" or "points".
std::string_view ProfileEndName(ProfileEnd end);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_FAMILY_FAMILY_JSON_H_
