#include "diagnosis/loop_budget/loop_trial.h"

#include <atomic>
#include <numeric>
#include <utility>

#include "diagnosis/loop_budget/parameter_labels.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/mode_maxima.h"

namespace howl {
namespace {

struct Unit {
  std::size_t trial, row, point;
};

}  // namespace

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
  std::vector<LoopStarts> starts;
  std::vector<Unit> units;
  for (const LoopItem& item : items) {
    out.push_back({item, With(from.model, item)});
    starts.push_back(StartsWith(records, from, out.back().model, options.threads));
    for (std::size_t row = 0; row < starts.back().rows.size(); ++row) {
      for (std::size_t e = 0; e < records.size(); ++e) units.push_back({out.size() - 1, row, e});
    }
  }
  std::vector<PointFit> fits(units.size());
  std::atomic<std::size_t> done = 0;
  RunUnits(units.size(), options.threads, [&](std::size_t i) {
    const Unit& unit = units[i];
    const LoopForm& model = out[unit.trial].model;
    const std::string of = key + "trial/" + KeyOf(items[unit.trial]) + "/" +
                           std::to_string(unit.row) + "/" + std::to_string(unit.point);
    fits[i] = KeptFit(options.units, of, [&] {
      const RecordSpectra record = records.Whole(model, unit.point);
      const PointPrior prior = PriorOfTrial(records, from, model, unit.point, record);
      PointFit fit =
          FitPoint(record, model.structure, prior, starts[unit.trial].rows[unit.row][unit.point]);
      // Without hum a mode may have taken its line for a resonance, and would keep it.
      if (!IsHum(items[unit.trial].noise.source)) return fit;
      return BestByModes(record, model.structure, prior, std::move(fit));
    });
    if (options.progress) options.progress(++done, units.size());
  });
  for (std::size_t t = 0, first = 0; t < out.size(); ++t) {
    const std::size_t rows = starts[t].rows.size();
    const auto fit = [&](std::size_t row, std::size_t e) -> const PointFit& {
      return fits[first + row * records.size() + e];
    };
    const auto sum = [&](std::size_t row) {
      double nats = 0.0;
      for (std::size_t e = 0; e < records.size(); ++e) nats += fit(row, e).log_evidence;
      return nats;
    };
    std::size_t best = 0;
    for (std::size_t row = 1; row < rows; ++row) {
      if (sum(row) > sum(best)) best = row;
    }
    out[t].starts.resize(1);
    for (std::size_t e = 0; e < records.size(); ++e) {
      std::size_t of = best;
      for (std::size_t row = 0; starts[t].apart && row < rows; ++row) {
        if (fit(row, e).log_evidence > fit(of, e).log_evidence) of = row;
      }
      out[t].gain += fit(of, e).log_evidence;
      out[t].starts[0].push_back(fit(of, e).parameters);
    }
    out[t].gain -= standing;
    first += rows * records.size();
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
