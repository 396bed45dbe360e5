#include "diagnosis/candidates/declared_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/records/channel_signal.h"
#include "diagnosis/reference/reference.h"

namespace howl {
namespace {

constexpr int kTable = 4001;
constexpr double kTableReach = 3.0;   // over the record's largest value
constexpr double kFirstStep = 0.125;  // of the bounds' distance
constexpr double kLastStep = 0.002;

// The base in cut A alone.
class AcousticBase final : public NamedEffect {
 public:
  AcousticBase() : NamedEffect("none", LoopBlock::kAcoustics, {}) {}
  bool ChangesAcousticCut() const override { return true; }
};

struct Inverse {
  std::vector<double> signal;
  double mean_log_slope = 0.0;
};

// No value where the map does not rise, or does not reach the record's values.
std::optional<Inverse> TakeBack(const DeclaredEffect& effect, const std::vector<double>& values,
                                const std::vector<double>& recorded) {
  double mean = 0.0;
  for (const double y : recorded) mean += y / static_cast<double>(recorded.size());
  double largest = 0.0;
  for (const double y : recorded) largest = std::max(largest, std::abs(y - mean));
  const double reach = kTableReach * largest;
  const double step = 2.0 * reach / (kTable - 1);
  std::vector<double> table(kTable);
  for (int i = 0; i < kTable; ++i)
    table[static_cast<std::size_t>(i)] = effect.Map(-reach + i * step, values);
  // The interval around zero on which the map rises.
  std::size_t low = kTable / 2;
  std::size_t high = low;
  while (low > 0 && table[low - 1] < table[low]) --low;
  while (high + 1 < table.size() && table[high] < table[high + 1]) ++high;
  Inverse out;
  out.signal.reserve(recorded.size());
  for (const double with_mean : recorded) {
    const double y = with_mean - mean;
    if (!(y >= table[low] && y < table[high])) return std::nullopt;
    const auto above = std::upper_bound(table.begin() + static_cast<std::ptrdiff_t>(low),
                                        table.begin() + static_cast<std::ptrdiff_t>(high), y);
    const auto i = static_cast<std::size_t>(above - table.begin()) - 1;
    const double slope = table[i + 1] - table[i];
    out.signal.push_back(-reach + (static_cast<double>(i) + (y - table[i]) / slope) * step);
    out.mean_log_slope += std::log(slope / step) / static_cast<double>(recorded.size());
  }
  return out;
}

struct Repaired {
  std::vector<CutRecord> records;
  double slope_cost = 0.0;
};

std::optional<Repaired> Repair(const std::vector<DiagnosisExperiment>& experiments,
                               const std::vector<CutRecord>& records, const DeclaredEffect& effect,
                               const std::vector<double>& values) {
  const bool pressure = effect.declaration().place == LoopPlace::kPressureRecorded;
  std::vector<DiagnosisExperiment> repaired = experiments;
  Repaired out;
  for (std::size_t e = 0; e < repaired.size(); ++e) {
    Record& record = repaired[e].record;
    std::vector<double>& signal =
        SignalOf(record, pressure ? Channel::kPressure : Channel::kHeatRelease);
    std::optional<Inverse> inverse = TakeBack(effect, values, signal);
    if (!inverse) return std::nullopt;
    signal = std::move(inverse->signal);
    if (pressure) {
      out.slope_cost += 2.0 * static_cast<double>(records[e].acoustic_count) / kBinCorrelation *
                        inverse->mean_log_slope;
    }
  }
  out.records = MakeCutRecords(repaired, records[0].model);
  for (std::size_t e = 0; e < records.size(); ++e) {
    if (out.records[e].acoustic_count != records[e].acoustic_count ||
        out.records[e].first != records[e].first) {
      return std::nullopt;  // bent so far that the cycle is lost
    }
    out.records[e].masked = records[e].masked;
  }
  KeepReference(records, &out.records);
  return out;
}

class MapSearch {
 public:
  MapSearch(const std::vector<DiagnosisExperiment>& experiments,
            const std::vector<CutRecord>& records, const EffectFit& base,
            const DeclaredEffect& effect)
      : experiments_(experiments),
        records_(records),
        base_(base),
        effect_(effect),
        acoustic_(std::make_shared<AcousticBase>()) {}

  double Cost(const std::vector<double>& values) const {
    const std::optional<Repaired> repaired = Repair(experiments_, records_, effect_, values);
    if (!repaired) return std::numeric_limits<double>::infinity();
    return FitEffect(repaired->records, acoustic_, base_).acoustic_cost + repaired->slope_cost;
  }

  // A pattern search from the best start, whose step is halved where no neighbour is better.
  std::vector<double> Search(double* cost) const {
    std::vector<double> best = Nulls();
    *cost = std::numeric_limits<double>::infinity();
    std::vector<double> start;
    TryStarts(&start, &best, cost);
    if (!std::isfinite(*cost)) return best;
    double step = kFirstStep;
    while (step > kLastStep) {
      bool better = false;
      for (std::size_t j = 0; j < best.size(); ++j) {
        for (const double sign : {1.0, -1.0}) {
          std::vector<double> moved = best;
          moved[j] = Moved(effect_.parameters()[j], best[j], sign * step);
          const double now = moved[j] == best[j] ? *cost : Cost(moved);
          if (!(now < *cost)) continue;
          *cost = now;
          best = std::move(moved);
          better = true;
          break;
        }
      }
      if (!better) step *= 0.5;
    }
    return best;
  }

  std::vector<double> Nulls() const { return NullValues(effect_); }

 private:
  static double Moved(const EffectParameter& p, double x, double by) {
    const double to = p.scale == ParameterScale::kLogarithmic ? x * std::pow(p.high / p.low, by)
                                                              : x + by * (p.high - p.low);
    return std::clamp(to, p.low, p.high);
  }

  void TryStarts(std::vector<double>* start, std::vector<double>* best, double* cost) const {
    if (start->size() == effect_.parameters().size()) {
      const double now = Cost(*start);
      if (now < *cost) {
        *cost = now;
        *best = *start;
      }
      return;
    }
    for (const double value : effect_.parameters()[start->size()].starts) {
      start->push_back(value);
      TryStarts(start, best, cost);
      start->pop_back();
    }
  }

  const std::vector<DiagnosisExperiment>& experiments_;
  const std::vector<CutRecord>& records_;
  const EffectFit& base_;
  const DeclaredEffect& effect_;
  EffectPointer acoustic_;
};

}  // namespace

DeclaredMapFit FitDeclaredMap(const std::vector<DiagnosisExperiment>& experiments,
                              const std::vector<CutRecord>& records, const EffectFit& base,
                              const DeclaredEffect& effect) {
  const MapSearch search(experiments, records, base, effect);
  DeclaredMapFit out;
  double cost = 0.0;
  out.values = search.Search(&cost);
  out.fit = base;
  const std::optional<Repaired> repaired =
      std::isfinite(cost) ? Repair(experiments, records, effect, out.values) : std::nullopt;
  if (!repaired) {
    out.held_out = HoldOutEach(records, base);
    return out;
  }
  out.gain = std::max(0.0, search.Cost(search.Nulls()) - cost);
  out.fit = FitBase(repaired->records);
  out.held_out = HoldOutEach(repaired->records, out.fit);
  return out;
}

DeclaredLineFit FitDeclaredLine(const std::vector<CutRecord>& records, const EffectFit& base,
                                const std::vector<CoherentLine>& lines,
                                const DeclaredEffect& effect) {
  const EffectDeclaration& declared = effect.declaration();
  std::vector<CoherentLine> within;
  for (const CoherentLine& line : lines) {
    if (line.frequency_hz >= declared.line_low_hz && line.frequency_hz <= declared.line_high_hz) {
      within.push_back(line);
    }
  }
  DeclaredLineFit out;
  if (within.empty()) return out;
  const LineOrigin origin = ExplainLines(records, base, within);
  out.gain = declared.place == LoopPlace::kPressureRecorded      ? origin.pressure_hum
             : declared.place == LoopPlace::kHeatReleaseRecorded ? origin.heat_release_hum
                                                                 : origin.source;
  out.frequency_hz = origin.frequency_hz;
  out.relative_amplitude = origin.relative_amplitude;
  out.all_lines = within.size() == lines.size();
  return out;
}

}  // namespace howl
