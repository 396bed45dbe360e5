#include "diagnosis/diagnosis.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "diagnosis/coherent_lines.h"
#include "diagnosis/declared_fit.h"
#include "diagnosis/effect_fit.h"
#include "diagnosis/gain_fluctuation.h"
#include "diagnosis/gap.h"
#include "diagnosis/reference.h"
#include "diagnosis/slack.h"
#include "diagnosis/static_map.h"

namespace howl {
namespace {

// Log-likelihoods are of Gaussian noise whose spectrum is itself fitted, and regressors carry noise
// of their own: gains of 20 come from no effect at all now and then.
constexpr double kDetectionGain = 25.0;
// Cut B's regressor is recorded p, whose sensor noise is taken out only in the mean.
constexpr double kFlameDetectionGain = 45.0;
constexpr double kDetectionWidth = 4.0;
// Slack that is left on rigs without an effect, or with one whose form is only nearly right.
constexpr double kAcousticAllowance = 40.0;
constexpr double kFlameAllowance = 120.0;
constexpr double kUnknownShare = 0.10;
constexpr double kUnknownWidth = 0.02;
constexpr double kUnknownGapShare = 0.016;  // of the squared gap
constexpr double kUnknownGapWidth = 0.004;
// Models are never exact: gains count by their share of the largest too.
constexpr double kTemperature = 3.0;
constexpr double kTemperatureShare = 0.02;
constexpr double kClassProbability = 0.05;
constexpr double kGainDataSize = 500.0;  // independent bins that a shared parameter draws on
constexpr double kOverdispersion = 2.5;
constexpr double kFlagGain = 1e6;
constexpr double kPlateauNoise = 0.45;
constexpr double kConfirmedUnknownShare = 0.35;
constexpr double kUnexplainedLines = 0.9;
constexpr double kTwoSigma = 1.96;

// A candidate before probabilities, and what its gap needs.
struct Attempt {
  Candidate candidate;
  std::vector<ExperimentFit> held_out;
  bool without_lines = false;
  std::optional<EffectFit> fit;
  double parameters = 1.0;
  // Evidence beside the likelihood: what slack is left over may be the effect's own crude form.
  bool confirmed = false;
};

struct Setting {
  const std::vector<CutRecord>* records = nullptr;
  const EffectFit* base = nullptr;
  const std::vector<DiagnosisExperiment>* experiments = nullptr;
  std::vector<ExperimentFit> base_held_out;
  const ReferenceModel* reference = nullptr;
  FitMemory* memory = nullptr;
};

// Starts of the search over all forms.
std::size_t WorkOf(const std::vector<EffectPointer>& forms) {
  std::size_t work = 0;
  for (const EffectPointer& form : forms) {
    std::size_t starts = 1;
    for (const EffectParameter& p : form->parameters()) {
      starts *= std::max<std::size_t>(p.starts.size(), 1);
    }
    work += starts;
  }
  return work;
}

std::vector<ExperimentFit> HoldOutAll(const Setting& at, const EffectFit& fit) {
  std::vector<ExperimentFit> out;
  for (std::size_t e = 0; e < at.records->size(); ++e) {
    out.push_back(HeldOut(*at.records, fit, e));
    if (!fit.effect->ChangesAcousticCut()) {
      out.back().acoustic_residual = at.base_held_out[e].acoustic_residual;
    }
    if (!fit.effect->ChangesFlameCut()) {
      out.back().flame_residual = at.base_held_out[e].flame_residual;
    }
  }
  return out;
}

EstimatedParameter WithError(const EffectParameter& p, double value, double error) {
  EstimatedParameter out{p.name, value, value - kTwoSigma * error, value + kTwoSigma * error,
                         p.unit};
  if (p.scale == ParameterScale::kLogarithmic && value > 0.0) {
    const double factor = std::exp(std::min(kTwoSigma * error / value, 20.0));
    out.low = value / factor;
    out.high = value * factor;
  }
  return out;
}

Attempt TryTransfer(const Setting& at, const std::vector<EffectPointer>& forms) {
  Attempt out;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    const EffectPointer& form = forms[i];
    const std::string key = std::string(form->id()) + "#" + std::to_string(i);
    EffectFit fit = FitOrRecall(at.memory, key, *at.records, form, *at.base);
    if (!out.fit || fit.cost() < out.fit->cost()) out.fit = std::move(fit);
  }
  const EffectFit& fit = *out.fit;
  out.candidate.effect = fit.effect->id();
  out.candidate.block = fit.effect->block();
  out.parameters = static_cast<double>(fit.values.size());
  out.candidate.gain = at.base->cost() - fit.cost();
  for (std::size_t j = 0; j < fit.values.size(); ++j) {
    out.candidate.parameters.push_back(
        WithError(fit.effect->parameters()[j], fit.values[j], fit.standard_errors[j + 1]));
  }
  out.held_out = HoldOutAll(at, fit);
  return out;
}

// A value whose error nothing here estimates: it has no interval.
EstimatedParameter WithoutError(const std::string& name, double value, const std::string& unit) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  return {name, value, unknown, unknown, unit};
}

Attempt Named(const Setting& at, const Effect& effect) {
  Attempt out;
  out.candidate.effect = effect.id();
  out.candidate.block = effect.block();
  out.held_out = at.base_held_out;
  out.parameters = static_cast<double>(effect.parameters().size());
  return out;
}

Attempt TryGain(const Setting& at, const Effect& effect, const GainFluctuation& fluctuation) {
  Attempt out = Named(at, effect);
  const bool coloured = effect.id() == "parametric_noise";
  const double worse = coloured ? fluctuation.coloured_cost - fluctuation.switching_cost
                                : fluctuation.switching_cost - fluctuation.coloured_cost;
  out.candidate.gain = fluctuation.gain - std::max(0.0, worse);
  if (coloured) {
    out.candidate.parameters.push_back(WithoutError(
        "rel_rms",
        std::sqrt(std::max(
            0.0, std::pow(fluctuation.in_phase_std, 2) - std::pow(fluctuation.quadrature_std, 2))),
        ""));
    out.candidate.parameters.push_back(
        WithoutError("correlation_s", fluctuation.correlation_s, "s"));
  } else {
    out.candidate.parameters.push_back(WithoutError("gain_drop", 1.0 - fluctuation.low_level, ""));
    out.candidate.parameters.push_back(WithoutError("dwell_s", fluctuation.dwell_s, "s"));
  }
  for (std::size_t e = 0; e < out.held_out.size(); ++e) {
    out.held_out[e].flame_residual = fluctuation.corrected[e];
  }
  return out;
}

Attempt TryLines(const Setting& at, const Effect& effect, const std::vector<CoherentLine>& lines,
                 const LineOrigin& origin) {
  Attempt out = Named(at, effect);
  if (lines.empty()) return out;
  const bool hum = effect.id() == "mains_hum";
  const double in_channel = std::max(origin.heat_release_hum, origin.pressure_hum);
  if (hum) {
    out.candidate.gain = origin.mains ? in_channel : 0.0;
    out.candidate.block = origin.pressure_hum >= origin.heat_release_hum
                              ? LoopBlock::kPressureInstrument
                              : LoopBlock::kHeatReleaseInstrument;
    out.candidate.parameters.push_back(WithoutError("rel", origin.relative_amplitude, ""));
    out.candidate.parameters.push_back(WithoutError("hz", origin.mains_hz, "Hz"));
  } else {
    out.candidate.gain = origin.source;
    out.candidate.parameters.push_back(WithoutError("rel", origin.relative_amplitude, ""));
    out.candidate.parameters.push_back(WithoutError("hz", origin.frequency_hz, "Hz"));
  }
  out.without_lines = true;
  return out;
}

Attempt TryClipping(const Setting& at, const Effect& effect) {
  Attempt out = Named(at, effect);
  const bool pressure = effect.id() == "p_clipping";
  ClippingFit clipping = FitClipping(*at.records, pressure, *at.base);
  if (at.reference) {
    clipping.gain =
        std::max(0.0, clipping.gain - 2.0 * (pressure ? at.reference->pressure_clipping_gain
                                                      : at.reference->heat_release_clipping_gain));
    clipping.sharp_edge &=
        !(pressure ? at.reference->pressure_sharp_edge : at.reference->heat_release_sharp_edge);
  }
  out.candidate.gain = clipping.gain + (clipping.sharp_edge ? kFlagGain : 0.0);
  out.candidate.parameters.push_back(WithoutError("fraction", clipping.fraction, ""));
  for (std::size_t e = 0; e < out.held_out.size(); ++e) {
    out.held_out[e].acoustic_residual = clipping.fit.experiments[e].acoustic_residual;
  }
  out.confirmed = clipping.sharp_edge || clipping.plateau_noise < kPlateauNoise;
  if (pressure && clipping.sharp_edge) {
    // The flame too is driven by the repaired signal.
    std::vector<DiagnosisExperiment> repaired = *at.experiments;
    for (std::size_t e = 0; e < repaired.size(); ++e) {
      const Eigen::VectorXd& signal = clipping.repaired[e];
      repaired[e].record.pressure.assign(signal.data(), signal.data() + signal.size());
      repaired[e].record.heat_release.resize(static_cast<std::size_t>(signal.size()));
    }
    std::vector<CutRecord> records = MakeCutRecords(repaired);
    KeepReference(*at.records, &records);
    const EffectFit fit = FitBase(records);
    for (std::size_t e = 0; e < out.held_out.size(); ++e)
      out.held_out[e] = HeldOut(records, fit, e);
  }
  // Four bumps in each experiment.
  out.parameters = 4.0 * static_cast<double>(out.held_out.size());
  return out;
}

Attempt TryQuantisation(const Setting& at, const Effect& effect) {
  Attempt out = Named(at, effect);
  FewLevels found = FindQuantisation(*at.records);
  if (at.reference && at.reference->quantisation_levels > 0.0) {
    found.found &= found.levels < 0.67 * at.reference->quantisation_levels;
  }
  out.candidate.gain = found.found ? 2.0 * kFlagGain : 0.0;
  out.candidate.parameters.push_back(WithoutError("levels", found.levels, ""));
  return out;
}

Attempt TryDeclaredMap(const Setting& at, const DeclaredEffect& effect) {
  Attempt out = Named(at, effect);
  DeclaredMapFit map = FitDeclaredMap(*at.experiments, *at.records, *at.base, effect);
  out.candidate.gain = map.gain;
  for (std::size_t j = 0; j < map.values.size(); ++j) {
    const EffectParameter& p = effect.parameters()[j];
    out.candidate.parameters.push_back(WithoutError(p.name, map.values[j], p.unit));
  }
  out.held_out = std::move(map.held_out);
  return out;
}

Attempt TryDeclaredLine(const Setting& at, const DeclaredEffect& effect,
                        const std::vector<CoherentLine>& lines) {
  Attempt out = Named(at, effect);
  const DeclaredLineFit line = FitDeclaredLine(*at.records, *at.base, lines, effect);
  out.candidate.gain = line.gain;
  out.without_lines = line.all_lines;
  if (line.gain > 0.0) {
    out.candidate.parameters.push_back(WithoutError("rel", line.relative_amplitude, ""));
    out.candidate.parameters.push_back(WithoutError("hz", line.frequency_hz, "Hz"));
  }
  // As many as a catalogue's line has.
  out.parameters = 2.0;
  return out;
}

double Logistic(double x) { return 1.0 / (1.0 + std::exp(-std::clamp(x, -50.0, 50.0))); }

double PValue(double gain, double parameters, std::size_t catalogue) {
  if (gain <= 0.0) return 1.0;
  const boost::math::chi_squared distribution(parameters);
  const double one =
      boost::math::cdf(boost::math::complement(distribution, 2.0 * gain / kOverdispersion));
  return -std::expm1(static_cast<double>(catalogue) * std::log1p(-std::min(one, 1.0 - 1e-12)));
}

bool IsInstrument(LoopBlock block) {
  return block == LoopBlock::kPressureInstrument || block == LoopBlock::kHeatReleaseInstrument;
}

// Which cuts a block's error shows in.
bool Reaches(LoopBlock block, bool acoustic_cut) {
  if (IsInstrument(block)) return true;
  const bool acoustic = block == LoopBlock::kAcoustics || block == LoopBlock::kSource;
  return acoustic == acoustic_cut;
}

std::vector<Place> FindPlaces(const Setting& at, const std::vector<Attempt>& attempts,
                              const Diagnosis& diagnosis, const Slack& before) {
  const bool acoustic = before.acoustic_excess > 0.1 * before.flame_excess;
  const bool flame = before.flame_excess > std::max(kFlameAllowance, 0.1 * before.acoustic_excess);
  struct Score {
    LoopBlock block;
    double gain;
  };
  std::vector<Score> scores;
  for (const Attempt& attempt : attempts) {
    double gain = std::max(0.0, attempt.candidate.gain);
    // No effect explains it: the place is where the cuts disagree with the model.
    if (diagnosis.kind == VerdictKind::kUnknown && acoustic && flame &&
        !IsInstrument(attempt.candidate.block)) {
      gain *= 0.3;
    }
    if (diagnosis.kind == VerdictKind::kUnknown && acoustic != flame &&
        (IsInstrument(attempt.candidate.block) || !Reaches(attempt.candidate.block, acoustic))) {
      gain *= 0.3;
    }
    auto same = std::find_if(scores.begin(), scores.end(), [&](const Score& score) {
      return score.block == attempt.candidate.block;
    });
    if (same == scores.end()) {
      scores.push_back({attempt.candidate.block, gain});
    } else {
      same->gain = std::max(same->gain, gain);
    }
  }
  double total = 0.0;
  if (diagnosis.kind == VerdictKind::kEffect) {
    // Where the probable effects act.
    for (Score& score : scores) {
      score.gain = 0.0;
      for (const Attempt& attempt : attempts) {
        if (attempt.candidate.block == score.block) score.gain += attempt.candidate.probability;
      }
      total += score.gain;
    }
  } else {
    double top = 0.0;
    for (const Score& score : scores) top = std::max(top, score.gain);
    const double temperature = kTemperature + 0.1 * top;
    for (Score& score : scores) {
      score.gain = std::exp((score.gain - top) / temperature);
      total += score.gain;
    }
  }
  if (total <= 0.0) return {};
  // The band and the experiments, from the slack's map.
  const std::vector<CutRecord>& records = *at.records;
  double low = records[0].frequency(0);
  double high = records[0].frequency(records[0].acoustic_count - 1);
  double most = 0.0;
  for (const SlackBand& band : before.acoustic) most = std::max(most, band.gain);
  if (acoustic && most > 10.0) {
    double first = std::numeric_limits<double>::infinity();
    double last = 0.0;
    for (const SlackBand& band : before.acoustic) {
      if (band.gain < 0.1 * most) continue;
      first = std::min(first, band.low_hz);
      last = std::max(last, band.high_hz);
    }
    low = first;
    high = last;
  }
  std::vector<double> by_experiment(records.size(), 0.0);
  for (std::size_t e = 0; e < records.size(); ++e) {
    if (flame) by_experiment[e] += before.flame_by_experiment[e];
    for (const SlackBand& band : before.acoustic) by_experiment[e] += band.by_experiment[e];
  }
  const double largest = *std::max_element(by_experiment.begin(), by_experiment.end());
  std::vector<std::string> names;
  for (std::size_t e = 0; e < records.size(); ++e) {
    if (by_experiment[e] >= 0.2 * largest) names.push_back(records[e].name);
  }
  std::vector<Place> places;
  for (const Score& score : scores) {
    if (score.gain / total < 0.02) continue;
    places.push_back({score.block, low, high, names, score.gain / total});
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.share > b.share; });
  return places;
}

std::string Advice(const Diagnosis& diagnosis) {
  if (diagnosis.kind == VerdictKind::kNone) {
    return "nothing to separate; longer records would lower the floor";
  }
  if (diagnosis.kind == VerdictKind::kUnknown) {
    return "a stable operating point, or a loudspeaker's sweep, would give the transfer functions "
           "of both cuts without the cycle";
  }
  const auto has = [&](std::string_view id) {
    return diagnosis.effect == id ||
           std::find(diagnosis.indistinguishable.begin(), diagnosis.indistinguishable.end(), id) !=
               diagnosis.indistinguishable.end();
  };
  if (diagnosis.indistinguishable.empty()) return "the effect stands alone: no further experiment";
  if (has("delay_dispersion") || has("second_delay_path") || has("flame_lowpass")) {
    return "a point with a stronger line near the second crossing, or a stable, noise-driven one: "
           "the flame's response above three times the cycle separates these";
  }
  if (has("nonlinear_damping") || has("amplitude_dependent_delay")) {
    return "a point with a weaker cycle: two amplitudes separate these";
  }
  if (has("parametric_noise") || has("intermittency") || has("slow_drift")) {
    return "a record ten times as long: the statistics of the slow envelope separate these";
  }
  return "another operating point, as far away as the rig allows";
}

}  // namespace

Diagnosis Diagnose(const std::vector<DiagnosisExperiment>& experiments,
                   const DiagnosisOptions& options) {
  std::vector<CutRecord> records = MakeCutRecords(experiments);
  std::vector<CoherentLine> lines = FindCoherentLines(records);
  MaskLines(lines, &records);
  std::optional<ReferenceModel> reference;
  if (!options.reference.empty()) {
    reference = AbsorbReference(options.reference, experiments, &records);
    lines = NewLines(lines, reference->lines);
  }
  const EffectFit base = FitBase(records);
  Setting at{&records, &base, &experiments, {}, nullptr, options.memory};
  for (std::size_t e = 0; e < records.size(); ++e) {
    at.base_held_out.push_back(HeldOut(records, base, e));
  }
  const LineOrigin origin = ExplainLines(records, base, lines);
  GainFluctuation fluctuation = EstimateGainFluctuation(records, base);
  if (reference) {
    fluctuation.gain = std::max(0.0, fluctuation.gain - reference->fluctuation_gain);
    at.reference = &*reference;
  }

  // One unit of work for each identifier, whatever its forms.
  std::vector<std::vector<EffectPointer>> units;
  std::vector<EffectPointer> all = Catalogue();
  all.insert(all.end(), options.further.begin(), options.further.end());
  for (const EffectPointer& effect : all) {
    const std::string id(effect->id());
    if (std::find(options.withheld.begin(), options.withheld.end(), id) != options.withheld.end()) {
      continue;
    }
    if (!units.empty() && units.back()[0]->id() == effect->id()) {
      units.back().push_back(effect);
    } else {
      units.push_back({effect});
    }
  }
  std::size_t work = 0;
  for (const std::vector<EffectPointer>& unit : units) work += WorkOf(unit);
  std::vector<Attempt> attempts(units.size());
  std::atomic<std::size_t> done = 0;
  std::mutex progress_lock;
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, units.size(),
        [&](std::size_t i) {
          if (options.stopped && options.stopped()) return;
          const Effect& effect = *units[i][0];
          switch (effect.kind()) {
            case EffectKind::kTransfer:
              attempts[i] = TryTransfer(at, units[i]);
              break;
            case EffectKind::kGain:
              attempts[i] = TryGain(at, effect, fluctuation);
              break;
            case EffectKind::kLine:
              attempts[i] = TryLines(at, effect, lines, origin);
              break;
            case EffectKind::kClipping:
              attempts[i] = TryClipping(at, effect);
              break;
            case EffectKind::kQuantisation:
              attempts[i] = TryQuantisation(at, effect);
              break;
            case EffectKind::kDeclaredMap:
              attempts[i] = TryDeclaredMap(at, dynamic_cast<const DeclaredEffect&>(effect));
              break;
            case EffectKind::kDeclaredLine:
              attempts[i] = TryDeclaredLine(at, dynamic_cast<const DeclaredEffect&>(effect), lines);
              break;
          }
          const std::size_t now = done += WorkOf(units[i]);
          if (options.progress) {
            const std::lock_guard<std::mutex> lock(progress_lock);
            options.progress(now, work);
          }
        },
        tbb::simple_partitioner());
  });

  if (options.stopped && options.stopped()) {
    Diagnosis unfinished;
    unfinished.stopped = true;
    return unfinished;
  }

  // V_B: the least that any fit leaves over.
  std::vector<Eigen::VectorXd> flame_noise;
  for (const ExperimentFit& fit : base.experiments) flame_noise.push_back(fit.flame_noise);
  double least = base.flame_cost;
  for (const Attempt& attempt : attempts) {
    if (!attempt.fit || attempt.fit->flame_cost >= least) continue;
    least = attempt.fit->flame_cost;
    for (std::size_t e = 0; e < records.size(); ++e) {
      flame_noise[e] = attempt.fit->experiments[e].flame_noise;
    }
  }
  const bool count_lines = !lines.empty();
  const GapParts before = ComputeGapParts(records, at.base_held_out, flame_noise, !count_lines);
  Diagnosis out;
  out.gap_before = Gap(before);
  out.gap_floor = GapFloor(records);
  if (reference) out.gap_floor = std::max(out.gap_floor, reference->gap_floor);
  for (Attempt& attempt : attempts) {
    Candidate& candidate = attempt.candidate;
    const double raw = candidate.gain;
    candidate.gain -= 0.5 * attempt.parameters * std::log(kGainDataSize);
    candidate.p_value = PValue(raw, attempt.parameters, units.size());
    const GapParts after = ComputeGapParts(records, attempt.held_out, flame_noise,
                                           !count_lines || attempt.without_lines);
    candidate.gap_after = Gap(after);
    candidate.shrinkage = 1.0 - candidate.gap_after / std::max(out.gap_before, 1e-12);
    const Interval interval = ShrinkageInterval(before, after);
    candidate.shrinkage_low = interval.low;
    candidate.shrinkage_high = interval.high;
  }
  std::stable_sort(attempts.begin(), attempts.end(), [](const Attempt& a, const Attempt& b) {
    return a.candidate.gain > b.candidate.gain;
  });

  // Slack before and after the best effect.
  const Slack slack_before = ComputeSlack(records, base);
  out.slack_acoustic_before = slack_before.acoustic_excess;
  out.slack_flame_before = slack_before.flame_excess;
  EffectFit best = base;
  const Attempt* top = attempts.empty() ? nullptr : &attempts[0];
  if (top) {
    if (top->fit) {
      best = *top->fit;
    } else {
      for (std::size_t e = 0; e < records.size(); ++e) {
        best.experiments[e].acoustic_residual = top->held_out[e].acoustic_residual;
        best.experiments[e].flame_residual = top->held_out[e].flame_residual;
      }
    }
  }
  const Slack slack_after = ComputeSlack(records, best);
  out.slack_acoustic_after = slack_after.acoustic_excess;
  out.slack_flame_after = slack_after.flame_excess;

  const double largest = top ? std::max(0.0, top->candidate.gain) : 0.0;
  const double rest = std::max(0.0, out.slack_acoustic_after - kAcousticAllowance) +
                      std::max(0.0, out.slack_flame_after - kFlameAllowance);
  const bool flame_alone = top && top->fit && !top->fit->effect->ChangesAcousticCut();
  const double detection = flame_alone ? kFlameDetectionGain : kDetectionGain;
  // Lines that no candidate accounts for are a fact, whatever else fits.
  const bool unexplained_lines =
      !lines.empty() && std::none_of(attempts.begin(), attempts.end(), [](const Attempt& attempt) {
        return attempt.without_lines && attempt.candidate.gain > kDetectionGain;
      });
  double nothing =
      Logistic((detection - largest) / kDetectionWidth) * Logistic((40.0 - rest) / 5.0);
  double unknown = 0.0;
  const bool flagged = largest >= 0.5 * kFlagGain;
  const bool confirmed = top && top->confirmed;
  if (!flagged && rest > 20.0) {
    const double share = confirmed ? kConfirmedUnknownShare : kUnknownShare;
    unknown = Logistic((rest / (rest + largest) - share) / kUnknownWidth);
  }
  if (!flagged && !confirmed && top) {
    // Nor may the held-out gap stay well above the floor.
    const double above = std::pow(top->candidate.gap_after, 2) - 4.0 * std::pow(out.gap_floor, 2);
    const double left = std::max(0.0, above) / std::pow(out.gap_before, 2);
    unknown = std::max(unknown, Logistic((left - kUnknownGapShare) / kUnknownGapWidth));
  }
  if (unexplained_lines) {
    nothing = 0.0;
    unknown = std::max(unknown, kUnexplainedLines);
  }
  out.probability_none = nothing;
  out.probability_unknown = (1.0 - nothing) * unknown;
  const double temperature = kTemperature + kTemperatureShare * (flagged ? 0.0 : largest);
  double total = 0.0;
  for (const Attempt& attempt : attempts) {
    total += std::exp((attempt.candidate.gain - attempts[0].candidate.gain) / temperature);
  }
  for (Attempt& attempt : attempts) {
    attempt.candidate.probability =
        (1.0 - nothing) * (1.0 - unknown) *
        std::exp((attempt.candidate.gain - attempts[0].candidate.gain) / temperature) / total;
  }
  if (nothing > 0.5) {
    out.kind = VerdictKind::kNone;
  } else if (unknown > 0.5 || !top) {
    out.kind = VerdictKind::kUnknown;
  } else {
    out.kind = VerdictKind::kEffect;
    out.effect = top->candidate.effect;
    for (std::size_t i = 1; i < attempts.size(); ++i) {
      if (attempts[i].candidate.probability > kClassProbability * top->candidate.probability) {
        out.indistinguishable.push_back(attempts[i].candidate.effect);
      }
    }
  }
  out.gap_after = top && out.kind != VerdictKind::kNone
                      ? std::min(top->candidate.gap_after, out.gap_before)
                      : out.gap_before;
  if (out.kind != VerdictKind::kNone) out.where = FindPlaces(at, attempts, out, slack_before);
  out.advice = Advice(out);
  for (Attempt& attempt : attempts) out.candidates.push_back(std::move(attempt.candidate));
  return out;
}

}  // namespace howl
