#include "estimation/analysis/analyse.h"

#include <algorithm>
#include <cmath>

#include "estimation/analysis/oscillations/cycle_beside_others.h"
#include "estimation/analysis/second_crossing.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

bool HasCycle(const Analysis& analysis) {
  return analysis.characteristics.state != CycleState::kNoLimitCycle;
}

bool HasPhase(const Analysis& analysis) {
  const Characteristics& c = analysis.characteristics;
  return HasCycle(analysis) && std::isfinite(c.phase_deg.value) && c.p_amplitude > 0.0 &&
         c.frequency_hz.value > 0.0;
}

// The cycle, the other oscillations and the lines.
void FindCycle(const Record& record, const CrossSpectrum& spectrum, const AnalysisOptions& options,
               const std::optional<CycleBand>& cycle_hz, Analysis* analysis) {
  CharacteristicsOptions search = options.characteristics;
  if (cycle_hz) {
    search.min_frequency_hz = cycle_hz->low_hz;
    search.max_frequency_hz = cycle_hz->high_hz;
  }
  analysis->characteristics = EstimateCharacteristics(record, spectrum, search);
  if ((cycle_hz || !HasCycle(*analysis)) && search.method == CharacteristicsMethod::kLocal) {
    std::optional<CycleBesideOthers> beside = ReadCycleBesideOthers(record, spectrum, search);
    if (beside && beside->characteristics.state != CycleState::kNoLimitCycle) {
      analysis->characteristics = std::move(beside->characteristics);
      analysis->slow_notches = std::move(beside->slow);
    }
  }
  const Estimate& f = analysis->characteristics.frequency_hz;
  if (cycle_hz && (f.value < cycle_hz->low_hz || f.value > cycle_hz->high_hz)) {
    // The skirt of an oscillation outside the range.
    PeakTest peak = analysis->characteristics.peak;
    peak.frequency_hz = f.value;
    analysis->characteristics = {};
    analysis->characteristics.peak = peak;
    analysis->slow_notches.clear();
  }
  analysis->lines =
      FindLines(record, spectrum, HasCycle(*analysis) && std::isfinite(f.value) ? f.value : 0.0,
                options.lines);
  analysis->oscillations = ListOscillations(record, spectrum, analysis->characteristics, search);
}

}  // namespace

Analysis AnalyseRecord(const Record& record, const AnalysisOptions& options,
                       const std::optional<CycleBand>& cycle_hz) {
  Analysis analysis;
  analysis.sampling_hz = record.sampling_hz;
  analysis.duration_s = static_cast<double>(record.pressure.size()) / record.sampling_hz;
  analysis.has_heat_release = !record.heat_release.empty();
  const std::vector<double> p = RemoveMean(record.pressure);
  const std::vector<double> q = RemoveMean(record.heat_release);
  const CrossSpectrum spectrum = WelchSpectrum(p, q, record.sampling_hz);
  FindCycle(record, spectrum, options, cycle_hz, &analysis);
  const Estimate& f = analysis.characteristics.frequency_hz;
  if (analysis.has_heat_release) {
    TransferOptions transfer_options = options.transfer;
    if (transfer_options.min_frequency_hz <= 0.0) {
      transfer_options.min_frequency_hz =
          std::isfinite(f.value) ? options.transfer_min_harmonic * f.value
                                 : LowestSearched(record.sampling_hz, analysis.duration_s);
    }
    analysis.transfer = EstimateTransfer(spectrum, analysis.lines, transfer_options);
    if (options.model) {
      const TransferBand band =
          std::isfinite(f.value) ? TransferBandOf(*options.model, f.value) : TransferBand{};
      std::optional<FirstModeCarries> first;
      if (HasCycle(analysis) && std::isfinite(f.value)) {
        first = {f.value, options.second_mode_share_max};
      }
      TransferFit fit = FitTransfer(*analysis.transfer, *options.model, band, first);
      if (fit.available) analysis.transfer_fit = std::move(fit);
    }
  } else if (std::isfinite(f.value)) {
    const Growth growth = EstimateGrowth(p, record.sampling_hz, f.value);
    if (growth.available) analysis.growth = growth;
  }
  return analysis;
}

void AddFlame(const Record& recorded, const Estimate& tau_s, const AnalysisOptions& options,
              Analysis* analysis) {
  const Characteristics& c = analysis->characteristics;
  analysis->tau_s = tau_s;
  const bool as_recorded = analysis->slow_notches.empty();
  const Record without_slow =
      as_recorded ? Record{} : WithoutOscillations(recorded, analysis->slow_notches);
  const Record& record = as_recorded ? recorded : without_slow;
  const CrossSpectrum spectrum = WelchSpectrum(RemoveMean(record.pressure),
                                               RemoveMean(record.heat_release), record.sampling_hz);
  FlameCurve curve = EstimateFlameCurve(record, spectrum, c, tau_s.value, options.flame_curve);
  if (std::isfinite(curve.slope.value)) {
    analysis->loop_gain = LoopGainFromSlope(c.gain, c.frequency_hz, curve.slope);
    analysis->low_loop_gain = ExplainLowLoopGain(c, curve, *analysis->loop_gain);
  }
  analysis->flame_curve = std::move(curve);
}

AnalysisSet AnalyseRecords(std::span<const NamedRecord> records, const AnalysisOptions& options) {
  AnalysisSet set;
  set.analyses.resize(records.size());
  RunUnits(records.size(), options.threads, [&](std::size_t i) {
    set.analyses[i] = AnalyseRecord(records[i].record, options, records[i].cycle_hz);
    set.analyses[i].name = records[i].name;
    set.analyses[i].phi = records[i].phi;
  });

  std::vector<DelayInput> inputs;
  std::vector<std::size_t> position(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!HasPhase(set.analyses[i])) continue;
    position[i] = inputs.size();
    inputs.push_back(
        {set.analyses[i].characteristics.frequency_hz, set.analyses[i].characteristics.phase_deg});
  }
  set.delay = EstimateDelays(inputs, options.delay_branch);
  RunUnits(records.size(), options.threads, [&](std::size_t i) {
    Analysis& analysis = set.analyses[i];
    if (HasPhase(analysis)) {
      AddFlame(records[i].record, set.delay.tau_s[position[i]], options, &analysis);
    }
  });

  std::vector<LoopGainPoint> points;
  for (const Analysis& analysis : set.analyses) {
    if (analysis.loop_gain && analysis.characteristics.stationary) {
      points.push_back({analysis.phi, *analysis.loop_gain});
    }
  }
  set.vanishing_phi = EstimateVanishingPhi(points);
  return set;
}

namespace {

// Neighbouring points share data, and where the model does not fit them, their scatter about the
// best one is the error to reckon with, which neighbours share too: all three widen the points'
// variance, as they widen the fit's standard deviations.
std::vector<TransferPoint> WidenedPoints(const Analysis& analysis) {
  std::vector<TransferPoint> points = analysis.transfer->points;
  const double misfit =
      analysis.transfer_fit ? std::max(1.0, analysis.transfer_fit->chi_square_per_dof) : 1.0;
  const double shared = analysis.transfer_fit ? analysis.transfer_fit->points_per_error : 1.0;
  const double factor = misfit * shared * analysis.transfer->neighbour_inflation;
  for (TransferPoint& point : points) {
    point.variance_re *= factor;
    point.variance_im *= factor;
    point.covariance *= factor;
  }
  return points;
}

}  // namespace

std::optional<Experiment> ToExperiment(const Analysis& analysis) {
  if (!HasPhase(analysis)) return std::nullopt;
  const Characteristics& c = analysis.characteristics;
  const auto known = [](double std) {
    return std::isfinite(std) && std > 0.0 ? std::optional<double>(std) : std::nullopt;
  };
  Experiment experiment;
  experiment.name = analysis.name;
  experiment.phi = analysis.phi;
  experiment.frequency_hz = c.frequency_hz.value;
  experiment.phase_deg = c.phase_deg.value;
  experiment.gain = c.gain.value;
  experiment.frequency_std_hz = known(c.frequency_hz.std);
  experiment.phase_std_deg = known(c.phase_deg.std);
  experiment.gain_std = known(c.gain.std);
  // The characteristic falls through zero; an estimate of a rising slope tells nothing about it.
  if (analysis.flame_curve && analysis.flame_curve->slope.value < 0.0) {
    experiment.flame_slope = analysis.flame_curve->slope.value;
    experiment.flame_slope_std = known(analysis.flame_curve->slope.std);
  }
  experiment.reliable = c.stationary;
  if (analysis.transfer) experiment.transfer = WidenedPoints(analysis);
  if (analysis.transfer_fit) {
    experiment.transfer_ellipsoid = MakeTransferEllipsoid(*analysis.transfer_fit);
  }
  if (const SpectralLine* const second = FindSecondCrossing(analysis)) {
    const Estimate& f = second->frequency_hz;
    experiment.lines.push_back({f.value, std::isfinite(f.std) ? f.std : 0.0});
  }
  return experiment;
}

}  // namespace howl
