#include "app/family/family_run.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "app/family/bounds_run.h"
#include "app/family/family_questions.h"
#include "app/input/problem_input.h"
#include "estimation/family/members/member_spread.h"
#include "io/config/reading/config_reading.h"
#include "io/user_error.h"

namespace howl {
namespace {

// A list this short is meant for reading, so its members are chosen far apart from each other.
constexpr std::size_t kShortList = 50;
constexpr std::size_t kChooseFrom = 2000;
constexpr std::size_t kPredictedMembers = 60;

std::vector<BoundedExpression> ParsePredictions(const Config& config,
                                                const FamilyProblem& problem) {
  std::vector<BoundedExpression> bounded;
  for (std::size_t k = 0; k < config.family.predictions.size(); ++k) {
    const PredictionSpec& spec = config.family.predictions[k];
    ExpressionError error;
    const auto expression = Expression::Parse(spec.expression, problem.experiments, error);
    if (!expression) {
      throw UserError(config.source.string(), spec.line,
                      "family.predictions[" + std::to_string(k) + "].expression",
                      "at character " + std::to_string(error.position + 1) + ": " + error.message);
    }
    const std::size_t last = expression->IsPerExperiment() ? problem.experiments.size() : 1;
    for (std::size_t i = 0; i < last; ++i) bounded.push_back({*expression, i});
  }
  return bounded;
}

void TakePredictions(const Config& config, FamilyRun& run) {
  std::size_t next = 0;
  for (const PredictionSpec& spec : config.family.predictions) {
    const bool per_experiment = run.bounded[next].expression.IsPerExperiment();
    const std::size_t last = per_experiment ? run.problem.experiments.size() : 1;
    for (std::size_t i = 0; i < last; ++i, ++next) {
      Prediction prediction;
      prediction.name = spec.name;
      prediction.kind = IntervalKind::kGuaranteed;
      prediction.interval = run.enclosure->BoundOfExpression(next).outer;
      prediction.members = run.sample.size();
      run.predictions.push_back(
          {per_experiment ? run.problem.experiments[i].name : "", prediction});
    }
  }
}

std::vector<Member> DrawUniformly(const Options& options, std::size_t count, FamilyRun& run) {
  SampleOptions sampling;
  sampling.count = count;
  sampling.seed = options.seed;
  sampling.threads = options.threads;
  MemberSample sample = SampleMembers(run.problem, sampling);
  if (sample.members.empty()) {  // too thin for the sampler's own starts
    sampling.starts = run.enclosure->Witnesses();
    if (!sampling.starts.empty()) sample = SampleMembers(run.problem, sampling);
  }
  run.diagnostics = sample.diagnostics;
  return std::move(sample.members);
}

void DrawMembers(const Config& config, const Options& options, FamilyRun& run) {
  const auto listed = static_cast<std::size_t>(config.family.members);
  const bool is_short = listed <= kShortList;
  const std::size_t drawn = is_short ? kChooseFrom : listed;
  run.sample = DrawUniformly(options, std::min(drawn, kChooseFrom), run);
  std::vector<Member> members;
  if (config.family.draw == MemberDraw::kUniform) {
    members = drawn <= kChooseFrom ? run.sample : DrawUniformly(options, drawn, run);
  } else {
    members = EnumerateMembers(run.problem, drawn, options.seed, options.threads).members;
  }
  // A family too thin to be enumerated may still be sampled, and one too thin for the chains to
  // move in still has its listed members.
  if (members.empty()) members = run.sample;
  if (run.sample.empty()) run.sample = members;
  if (!is_short || members.size() <= listed) {
    run.members = std::move(members);
    return;
  }
  for (const std::size_t index : SpreadMembers(members, listed)) {
    run.members.push_back(members[index]);
  }
}

// A prediction of the config by its name (exp1.NAME where it differs from experiment to
// experiment), or what ParseQuantity knows.
MemberQuantity AskedQuantity(const Config& config, const std::string& text,
                             const FamilyProblem& problem) {
  ExpressionError error;
  for (const PredictionSpec& spec : config.family.predictions) {
    const auto expression = Expression::Parse(spec.expression, problem.experiments, error);
    if (!expression) continue;
    if (!expression->IsPerExperiment() && text == spec.name) {
      return QuantityOf(*expression, problem, 0);
    }
    for (std::size_t i = 0; expression->IsPerExperiment() && i < problem.experiments.size(); ++i) {
      if (text == problem.experiments[i].name + "." + spec.name) {
        return QuantityOf(*expression, problem, i);
      }
    }
  }
  std::optional<MemberQuantity> quantity = ParseQuantity(text, problem, error);
  if (!quantity) throw UsageError("--profile " + text + ": " + error.message);
  return *std::move(quantity);
}

void AskProfile(const Config& config, const Options& options, FamilyRun& run) {
  const std::optional<std::string> text = options.Text("--profile");
  if (!text) return;
  std::vector<Member> members = run.enclosure->Witnesses();
  if (members.empty()) members = run.members;
  const std::optional<Profile> profile =
      ProfileFamily(run.problem, AskedQuantity(config, *text, run.problem), members);
  if (!profile) {
    throw UsageError(
        "--profile: expected omega_hz, xi, N and tau_s of each experiment's own, and "
        "tolerances that are not zero");
  }
  run.profile = ProfileReport{*text, *profile};
}

void MeasureTransfer(const Options& options, FamilyRun& run) {
  constexpr std::size_t kMembersWithout = 400;
  if (!run.problem.HasTransfer()) return;
  TransferReport report;
  report.volume =
      MeasureTransferVolume(run.problem, {.seed = options.seed, .threads = options.threads});
  report.without =
      EnumerateMembers(WithoutTransfer(run.problem), kMembersWithout, options.seed, options.threads)
          .members;
  run.transfer = std::move(report);
}

// The further experiments of --falsify; empty without it.
std::vector<Experiment> LoadFurther(const Options& options) {
  const std::optional<std::string> other = options.Text("--falsify");
  return other ? LoadExperiments(LoadConfig(*other), options) : std::vector<Experiment>();
}

void AskFurther(const Options& options, const std::vector<Experiment>& further, FamilyRun& run) {
  if (const std::optional<std::string> other = options.Text("--falsify")) {
    FurtherTest test;
    test.config = *other;
    for (const Experiment& experiment : further) test.experiments.push_back(experiment.name);
    test.counts = TestFurther(run.problem, run.sample, further).counts;
    run.falsified = std::move(test);
  }
  if (options.Has("--advise")) run.advice = AdviseMeasurements(run.problem, run.sample);
}

// A family too thin to be drawn from may still have the members that searches found.
void ExplainNoMember(const Options& options, FamilyRun& run) {
  run.members = run.enclosure->Witnesses();
  if (run.members.empty()) {
    run.conflict = ExplainEmpty(run.problem, options.threads);
    run.conflict.proved |= run.enclosure->IsProvedEmpty();
    if (!run.conflict.member.empty()) run.members.push_back(run.conflict.member);
  }
  run.sample = run.members;
}

using BoundsRun = std::function<void(Enclosure&)>;

// The problem, and the search for its bounds, which has not begun.
FamilyRun PrepareFamily(const Config& config, const Options& options,
                        std::vector<Experiment> experiments) {
  FamilyRun run;
  run.problem = MakeFamilyProblem(config, std::move(experiments));
  for (const ExperimentConfig& each : config.experiments) {
    if (each.record) run.recorded.push_back(each.experiment.name);
  }
  if (const auto text = options.Text("--profile")) AskedQuantity(config, *text, run.problem);
  run.bounded = ParsePredictions(config, run.problem);
  run.enclosure =
      std::make_unique<Enclosure>(run.problem, EncloseOptions{.width = config.family.width,
                                                              .seed = options.seed,
                                                              .threads = options.threads,
                                                              .expressions = run.bounded});
  return run;
}

// Computes all but the trade-off. `run_bounds` runs the search to its end.
FamilyRun RunQuestions(const Config& config, const Options& options,
                       std::vector<Experiment> experiments, const BoundsRun& run_bounds) {
  FamilyRun run = PrepareFamily(config, options, std::move(experiments));
  // Its mistakes are reported before the search, which may take long.
  const std::vector<Experiment> further = LoadFurther(options);
  run_bounds(*run.enclosure);
  StopIfInterrupted(options);
  if (!run.enclosure->IsProvedEmpty()) DrawMembers(config, options, run);
  StopIfInterrupted(options);
  if (run.members.empty()) ExplainNoMember(options, run);
  if (!run.members.empty()) {
    TakePredictions(config, run);
    std::ranges::copy(PredictLoops(run.problem, config.simulation,
                                   Thinned(run.sample, kPredictedMembers), options.threads),
                      std::back_inserter(run.predictions));
    AskFurther(options, further, run);
    AskProfile(config, options, run);
  }
  StopIfInterrupted(options);
  MeasureTransfer(options, run);
  StopIfInterrupted(options);
  return run;
}

}  // namespace

void CheckPredictions(const Config& config, const FamilyProblem& problem) {
  (void)ParsePredictions(config, problem);
}

FamilyRun RunFamily(const Config& config, const Options& options) {
  FamilyRun run =
      RunQuestions(config, options, LoadExperiments(config, options),
                   [&](Enclosure& enclosure) { RunBounds(config, options, enclosure); });
  run.tradeoff =
      ComputeTradeoff(run.problem, DefaultSpreads(run.problem), options.threads, options.seed);
  StopIfInterrupted(options);
  return run;
}

void RunFamilyShard(const Config& config, const Options& options, const Shard& shard) {
  const FamilyRun run = PrepareFamily(config, options, LoadExperiments(config, options));
  RunBoundsShard(config, options, shard, *run.enclosure);
}

FamilyRun RunFamilyAnew(const Config& config, const Options& options,
                        std::vector<Experiment> experiments) {
  return RunQuestions(config, options, std::move(experiments),
                      [](Enclosure& enclosure) { enclosure.Run(); });
}

FamilyReport ReportOf(const Config& config, const FamilyRun& run) {
  return {.problem = run.problem,
          .enclosure = *run.enclosure,
          .members = run.members.size(),
          .requested = static_cast<std::size_t>(config.family.members),
          .diagnostics = run.diagnostics,
          .conflict = run.conflict,
          .recorded = run.recorded,
          .predictions = run.predictions,
          .falsified = run.falsified,
          .advice = run.advice,
          .transfer = run.transfer,
          .profile = run.profile};
}

}  // namespace howl
