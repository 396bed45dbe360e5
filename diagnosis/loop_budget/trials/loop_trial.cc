#include "diagnosis/loop_budget/trials/loop_trial.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "diagnosis/loop_budget/forms/odds.h"
#include "diagnosis/loop_budget/forms/parameter_labels.h"
#include "diagnosis/loop_budget/trials/law_of_trial.h"
#include "estimation/joint_records/best_row.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/mode_maxima.h"
#include "estimation/record_fit/spectra/middle_part.h"

namespace howl {
namespace {

// Fits that are compared, as those at values of a profile beside one another, are known better than
// what comes of them: with all of it a climb broke off 1000 nats below a top of 2839.
constexpr double kOfUnknown = 0.1;

// Where the trial of an item begins: of several rows of starts in the best by the middles of the
// records (middle_part.h).
std::vector<Eigen::VectorXd> StartOf(const LoopRecords& records, const LoopFit& from,
                                     const LoopForm& with, const std::string& key,
                                     const LoopBudgetOptions& options) {
  const LoopStarts starts = StartsWith(records, from, with, options.threads);
  if (starts.rows.size() == 1) return starts.rows[0];
  const auto on_middle = [&](std::size_t row, std::size_t e) {
    const RecordSpectra whole = records.Whole(with, e);
    const RecordSpectra& record = MiddleOf(whole);
    const std::string of = key + "middle/" + std::to_string(row) + "/" + std::to_string(e);
    PointFit fit = KeptFit(options.units, of, [&] {
      return FitPoint(record, with.structure, PriorOfTrial(records, from, with, e, record),
                      starts.rows[row][e], kToCompare);
    });
    fit.parameters = BesideMiddle(whole, with.structure, std::move(fit.parameters));
    return fit;
  };
  return BestRow({starts.rows.size(), records.size(), starts.apart}, options.threads, on_middle);
}

// Whether at most points a mode's half-power width is less than the record resolves.
bool HasATone(const LoopRecords& records, const LoopTrial& trial) {
  std::size_t points = 0;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const LoopPoint point = ToPoint(
        trial.model.structure, records.FlameTerms(trial.model.flame_input, e), trial.starts[0][e]);
    const double of_record = 2.0 * std::numbers::pi * records.cycle_hz()[e] * records.length_s()[e];
    if (std::ranges::any_of(point.modes, [of_record](const LoopMode& mode) {
          return mode.xi * mode.omega * of_record < std::numbers::pi;
        })) {
      ++points;
    }
  }
  return 2 * points > records.size();
}

// Whether a gain that follows the amplitude grows with it. Where the gain fluctuates by itself the
// amplitude follows it, and the later gain seems to grow with what the amplitude was: what
// saturates falls.
bool GainGrows(const LoopRecords& records, const LoopTrial& trial) {
  double sum = 0.0;
  for (std::size_t e = 0; e < records.size(); ++e) {
    sum += ToPoint(trial.model.structure, records.FlameTerms(trial.model.flame_input, e),
                   trial.starts[0][e])
               .Change(SlowChange::kGain)
               .sum();
  }
  return sum > 0.0;
}

}  // namespace

PointFitOptions ToCompareWith(double log_posterior) {
  PointFitOptions out = kToTheMaximum;
  out.share = kOfUnknown * UnknownOfTrial(1.0);
  out.over = log_posterior;
  return out;
}

PointPrior PriorOfTrial(const LoopRecords& records, const LoopFit& from, const LoopForm& with,
                        std::size_t e, const RecordSpectra& record) {
  const Eigen::Index terms = records.FlameTerms(from.model.flame_input, e);
  std::vector<std::string> known = ParameterLabels(from.model.structure, terms);
  const Eigen::Index flame = from.model.structure.Flame();
  for (Eigen::Index k = 0; k < terms; ++k) {
    // Whatever another input makes the flame's functions, their prior is that of the record.
    known[static_cast<std::size_t>(flame + k)].clear();
  }
  if (with.flame_input != from.model.flame_input) {
    known[static_cast<std::size_t>(from.model.structure.Delay())].clear();
  }
  return WithKnown(PriorOf(with.structure, record),
                   ParameterLabels(with.structure, record.flame.cols()), from.fit.prior[e], known);
}

double StandingEvidence(const LoopRecords& records, const LoopFit& from, const std::string& key,
                        const LoopBudgetOptions& options) {
  std::vector<double> evidence(records.size());
  RunUnits(records.size(), options.threads, [&](std::size_t e) {
    evidence[e] = KeptFit(options.units, key + "standing/" + std::to_string(e), [&] {
                    return FitPoint(records.Whole(from.model, e), from.model.structure,
                                    from.fit.prior[e], from.fit.points[e].parameters);
                  }).log_evidence;
  });
  return std::accumulate(evidence.begin(), evidence.end(), 0.0);
}

std::vector<LoopTrial> TryItems(const LoopRecords& records, const LoopFit& from, double standing,
                                const std::vector<LoopItem>& items, const std::string& key,
                                const LoopBudgetOptions& options) {
  std::vector<LoopTrial> out;
  const auto key_of = [&](const LoopItem& item) { return key + "trial/" + KeyOf(item) + "/"; };
  for (const LoopItem& item : items) {
    LoopTrial& trial =
        out.emplace_back(LoopTrial{item, With(from.model, item), -standing, 0.0, {}});
    trial.starts = {StartOf(records, from, trial.model, key_of(item), options)};
  }
  std::vector<PointFit> fits(items.size() * records.size());
  std::atomic<std::size_t> done = 0;
  RunUnits(fits.size(), options.threads, [&](std::size_t i) {
    const std::size_t e = i % records.size();
    const LoopTrial& trial = out[i / records.size()];
    fits[i] = KeptFit(options.units, key_of(trial.item) + std::to_string(e), [&] {
      const RecordSpectra record = records.Whole(trial.model, e);
      const PointPrior prior = PriorOfTrial(records, from, trial.model, e, record);
      PointFit fit = FitPoint(record, trial.model.structure, prior, trial.starts[0][e],
                              ToCompareWith(from.fit.points[e].log_posterior));
      // Without hum or a tone a mode may have taken its line for a resonance, and would keep it.
      if (!HasLines(trial.item.noise.source)) return fit;
      return BestByModes(record, trial.model.structure, prior, std::move(fit));
    });
    if (options.progress) options.progress(++done, fits.size());
  });
  for (std::size_t i = 0; i < out.size(); ++i) {
    LoopTrial& trial = out[i];
    const auto first = fits.begin() + static_cast<std::ptrdiff_t>(i * records.size());
    const std::vector<PointFit> of_points(first,
                                          first + static_cast<std::ptrdiff_t>(records.size()));
    for (const PointFit& fit : of_points) trial.gain += fit.log_evidence;
    trial.starts = {ParametersOf(of_points)};
    if (records.size() > 1) {
      // In this order what is not a number gains nothing.
      trial.gain +=
          std::max(0.0, GainedByLaw(records, from, trial.model, of_points, options.threads));
    }
    const bool tone = trial.item.kind == LoopItemKind::kMode && HasATone(records, trial);
    const bool grows =
        trial.item.change == &PointStructure::gain_follows_amplitude && GainGrows(records, trial);
    if (tone || grows) trial.gain = -std::numeric_limits<double>::infinity();
  }
  return out;
}

RecordsFitOptions FitOptionsOf(const LoopBudgetOptions& options, const std::string& key) {
  RecordsFitOptions out;
  out.starts = options.starts;
  out.seed = options.seed;
  out.threads = options.threads;
  out.units = options.units;
  out.key = key;
  return out;
}

LoopFit Scored(const LoopRecords& records, const LoopForm& model, RecordsFit fit,
               const RecordsFitOptions& options) {
  LoopFit out{model, std::move(fit), {}};
  out.log_density = LeftOutDensities(records.Points(model), out.fit, options);
  for (std::size_t e = 0; e < records.size(); ++e) {
    out.log_density[e] += records.LogJacobianOfWhole(model, e);
  }
  return out;
}

LoopFit FitLoopFrom(const LoopRecords& records, const LoopForm& model, const StartRows& starts,
                    MaximumTaken taken, const std::string& key, const LoopBudgetOptions& options) {
  RecordsFitOptions fit_options = FitOptionsOf(options, key);
  fit_options.other_maxima = taken == MaximumTaken::kBest;
  const std::vector<OperatingPoint> points = records.Points(model);
  return Scored(records, model, FitRecordsFrom(points, model.structure, starts, fit_options),
                fit_options);
}

}  // namespace howl
