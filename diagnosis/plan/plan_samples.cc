#include "diagnosis/plan/plan_samples.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/fit/fitter.h"
#include "diagnosis/numerics/real_fft.h"
#include "diagnosis/samples/coherent_lines.h"
#include "diagnosis/samples/gain_fluctuation.h"
#include "diagnosis/samples/sample_limits.h"
#include "diagnosis/samples/static_map.h"
#include "diagnosis/verdict/verdict.h"
#include "model/noise/random_stream.h"

namespace howl {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kHalvings = 7;     // of a factor of four: to 1 %
constexpr double kFactor = 4.0;  // between trial sizes
constexpr double kClippingFactor = 1.1;
constexpr double kFarthest = 1e3;        // from the first trial size, to either side
constexpr int kMultiples[] = {1, 3, 5};  // as model/effects/mains_hum.cc simulates it
constexpr double kFullScale = 1.2;       // as model/effects/quantisation.cc has it
// A tone of the plan's own lies between the cycle and its harmonic.
constexpr double kToneOverCycle = 1.45;
constexpr double kSlopeStep = 1e-3;  // of the flame's range
constexpr std::uint64_t kSeed = 21;

// What the estimators say of a trial: the gain of the effect itself and of its rival, both with
// their parameters paid for.
struct Found {
  bool seen = false;
  double own = 0.0;
  double rival = 0.0;
  bool model_free = false;
};

using Experiments = std::vector<DiagnosisExperiment>;

double Amplitude(const std::vector<double>& x) {
  double mean = 0.0;
  double square = 0.0;
  const auto count = static_cast<double>(x.size());
  for (const double value : x) mean += value / count;
  for (const double value : x) square += (value - mean) * (value - mean) / count;
  return std::sqrt(2.0 * square);
}

double Mean(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

void AddLine(double amplitude, double hz, double phase_rad, double sampling_hz,
             std::vector<double>* x) {
  const double step = 2.0 * std::numbers::pi * hz / sampling_hz;
  for (std::size_t i = 0; i < x->size(); ++i) {
    (*x)[i] += amplitude * std::cos(step * static_cast<double>(i) + phase_rad);
  }
}

Found Paid(double own, double rival, double parameters) {
  const double price = PriceOfParameters(parameters);
  return {own - price > DetectionGain(false), own - price, rival - price, false};
}

// The base's fit with the flame solved for anew, as a search finds it in records with the effect.
EffectFit Evaluated(const std::vector<CutRecord>& records, const EffectFit& base) {
  EffectFit fit = base;
  Fitter fitter(records, *base.effect, nullptr);
  fitter.SetNoise(base);
  fitter.Evaluate(&fit);
  return fit;
}

Found FindLines(const PlanRecords& at, const Experiments& changed, bool hum) {
  std::vector<CutRecord> records = MakeCutRecords(changed, (*at.records)[0].model);
  const std::vector<CoherentLine> lines = FindCoherentLines(records);
  if (lines.empty()) return {};
  MaskLines(lines, &records);
  const LineOrigin origin = ExplainLines(records, Evaluated(records, *at.base), lines);
  const double of_hum = origin.mains ? std::max(origin.heat_release_hum, origin.pressure_hum) : 0.0;
  return hum ? Paid(of_hum, origin.source, 2.0) : Paid(origin.source, of_hum, 2.0);
}

Found TryHum(const PlanRecords& at, double mains_hz, double rel) {
  Experiments changed = *at.experiments;
  RandomStream random(kSeed);
  for (DiagnosisExperiment& each : changed) {
    const double amplitude = rel * Amplitude(each.record.heat_release);
    for (const int k : kMultiples) {
      AddLine(amplitude / k, k * mains_hz, 2.0 * std::numbers::pi * random.Uniform(),
              each.record.sampling_hz, &each.record.heat_release);
    }
  }
  return FindLines(at, changed, true);
}

// The flame's mean slope over the record, in units of q over those of p'.
double MeanSlope(const CutRecord& record, const EffectFit& base, std::size_t e) {
  const FlameColumns columns = MakeFlameColumns(record, *base.effect, {}, base.DelayOf(e));
  const FlameBasis basis(columns.range);
  const Eigen::VectorXd& flame = base.experiments[e].flame;
  const double step = kSlopeStep * columns.range;
  const Eigen::VectorXd up = basis.Value(columns.v.array() + step, flame);
  const Eigen::VectorXd down = basis.Value(columns.v.array() - step, flame);
  return (up - down).mean() / (2.0 * step);
}

// A source s in the acoustics: p = G (q + s) and q = F p at a frequency beside the cycle's.
Found TryTone(const PlanRecords& at, double hz, double rel) {
  Experiments changed = *at.experiments;
  for (std::size_t e = 0; e < changed.size(); ++e) {
    const CutRecord& record = (*at.records)[e];
    const Complex<double> g =
        AcousticResponse(ToAcoustics(record.model, at.base->experiments[e].acoustics), hz);
    const Response acoustics(g.re, g.im);
    const Response s = LaplaceVariable(hz);
    const Response flame = MeanSlope(record, *at.base, e) * s * std::exp(-s * at.base->DelayOf(e));
    Record& samples = changed[e].record;
    const Response p =
        acoustics * (rel * Amplitude(samples.heat_release)) / (1.0 - acoustics * flame);
    const Response q = flame * p;
    AddLine(std::abs(p), hz, std::arg(p), samples.sampling_hz, &samples.pressure);
    AddLine(std::abs(q), hz, std::arg(q), samples.sampling_hz, &samples.heat_release);
  }
  return FindLines(at, changed, false);
}

// time_s: the correlation's, or the mean time between two changes of level.
Found TryFluctuation(const PlanRecords& at, bool coloured, double time_s, double size) {
  std::vector<CutRecord> records = *at.records;
  for (std::size_t e = 0; e < records.size(); ++e) {
    CutRecord& record = records[e];
    const double tau_s = at.base->DelayOf(e);
    const FlameColumns columns = MakeFlameColumns(record, *at.base->effect, {}, tau_s);
    const FlameBasis basis(columns.range);
    const Eigen::VectorXd& flame = at.base->experiments[e].flame;
    RandomStream random(kSeed + e);
    const double step_s = 1.0 / record.sampling_hz;
    const double keep = std::exp(-step_s / time_s);
    double gain = coloured ? random.Normal() : 0.0;
    Eigen::VectorXd moved(columns.v.size());
    for (Eigen::Index i = 0; i < moved.size(); ++i) {
      if (coloured) {
        gain = keep * gain + std::sqrt(1.0 - keep * keep) * random.Normal();
      } else if (random.Uniform() < 1.0 - keep) {
        gain = gain == 0.0 ? -1.0 : 0.0;
      }
      moved[i] = (1.0 + size * gain) * columns.v[i];
    }
    Eigen::VectorXcd spectrum =
        ForwardFft(basis.Value(moved, flame) - basis.Value(columns.v, flame));
    for (Eigen::Index k = 0; k < spectrum.size(); ++k) {
      spectrum[k] *= std::exp(-LaplaceVariable(static_cast<double>(k) * record.bin_hz) * tau_s);
    }
    record.heat_release_spectrum += spectrum;
    record.windowed_heat_release = ApplyWindow(
        record.heat_release_spectrum.segment(record.first - kTapReach, record.extended()),
        record.acoustic_count);
  }
  const GainFluctuation found = EstimateGainFluctuation(records, Evaluated(records, *at.base));
  const double for_switching = found.coloured_cost - found.switching_cost;
  const double of_coloured = found.gain - std::max(0.0, for_switching);
  const double of_switching = found.gain - std::max(0.0, -for_switching);
  return coloured ? Paid(of_coloured, of_switching, 2.0) : Paid(of_switching, of_coloured, 2.0);
}

// At this fraction of the amplitude.
Found TryClipping(const PlanRecords& at, bool pressure, double fraction) {
  Experiments changed = *at.experiments;
  for (DiagnosisExperiment& each : changed) {
    std::vector<double>& x = pressure ? each.record.pressure : each.record.heat_release;
    const double mean = Mean(x);
    const double most = fraction * Amplitude(x);
    for (double& value : x) value = mean + std::clamp(value - mean, -most, most);
  }
  // Edges are those of the samples, for which nothing need be cut.
  std::vector<CutRecord> samples = *at.records;
  for (std::size_t e = 0; e < samples.size(); ++e) {
    const Record& record = changed[e].record;
    (pressure ? samples[e].pressure : samples[e].heat_release) = Eigen::Map<const Eigen::VectorXd>(
        (pressure ? record.pressure : record.heat_release).data(), samples[e].samples);
  }
  if (HasSharpEdge(samples, pressure)) return {true, 0.0, 0.0, true};
  const std::vector<CutRecord> records = MakeCutRecords(changed, (*at.records)[0].model);
  const double gain = FitClipping(records, pressure, Evaluated(records, *at.base)).gain;
  return Paid(gain, 0.0, kClippingShapes * static_cast<double>(records.size()));
}

Found TryLevels(const PlanRecords& at, double levels) {
  std::vector<CutRecord> records = *at.records;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const double step = 2.0 * kFullScale * Amplitude((*at.experiments)[e].record.pressure) / levels;
    for (double& value : records[e].pressure) value = step * std::nearbyint(value / step);
  }
  const bool found = FindQuantisation(records).found;
  return {found, 0.0, 0.0, found};
}

struct SampleTrial {
  std::string rival;   // of the same kind; empty: none
  double first = 0.0;  // trial size
  double factor = kFactor;
  bool inverted = false;  // a smaller value is a larger effect
  double most = 0.0;      // value
  double least = 0.0;
  std::vector<std::pair<std::string, double>> others;
  std::function<Found(double)> at;
};

std::optional<SampleTrial> TrialOf(const PlanRecords& at, const Effect& effect) {
  const std::string id(effect.id());
  SampleTrial trial;
  // The second parameter stays at its null: the frequency of mains, a time of the catalogue's.
  const auto hold = [&](double value) {
    trial.others.emplace_back(effect.parameters()[1].name, value);
    return value;
  };
  if (id == "mains_hum" || id == "external_tone") {
    const bool hum = id == "mains_hum";
    trial.rival = hum ? "external_tone" : "mains_hum";
    trial.first = 0.01;
    trial.least = 1e-6;
    trial.most = 1.0;
    const double hz = hold(hum ? effect.parameters()[1].null_value
                               : kToneOverCycle * (*at.records)[0].at.cycle_frequency_hz);
    trial.at = [&at, hum, hz](double x) { return hum ? TryHum(at, hz, x) : TryTone(at, hz, x); };
  } else if (effect.kind() == EffectKind::kGain) {
    const bool coloured = id == "parametric_noise";
    trial.rival = coloured ? "intermittency" : "parametric_noise";
    trial.first = 0.05;
    trial.least = 1e-4;
    trial.most = 0.9;
    const double time_s = hold(effect.parameters()[1].null_value);
    trial.at = [&at, coloured, time_s](double x) {
      return TryFluctuation(at, coloured, time_s, x);
    };
  } else if (effect.kind() == EffectKind::kClipping) {
    const bool pressure = id == "p_clipping";
    trial.inverted = true;
    trial.first = 0.95;
    trial.factor = kClippingFactor;
    trial.least = 0.3;
    trial.most = 1.5;
    trial.at = [&at, pressure](double x) { return TryClipping(at, pressure, x); };
  } else if (effect.kind() == EffectKind::kQuantisation) {
    trial.inverted = true;
    trial.first = 100.0;
    trial.least = 4.0;
    trial.most = 1e6;
    trial.at = [&at](double x) { return TryLevels(at, x); };
  } else {
    return std::nullopt;
  }
  return trial;
}

// The value nearest to the null where `is` holds, by halving a factor; NaN where there is none.
double Boundary(const SampleTrial& trial, const std::function<bool(double)>& is) {
  const double larger = trial.inverted ? 1.0 / trial.factor : trial.factor;  // to a larger effect
  const auto inside = [&](double x) { return std::clamp(x, trial.least, trial.most); };
  double seen = trial.first;
  double unseen = trial.first;
  if (is(trial.first)) {
    while (is(unseen)) {
      seen = unseen;
      const double next = inside(unseen / larger);
      if (next == unseen || std::abs(std::log(next / trial.first)) > std::log(kFarthest)) {
        return seen;
      }
      unseen = next;
    }
  } else {
    while (!is(seen)) {
      unseen = seen;
      const double next = inside(seen * larger);
      if (next == seen) return kNaN;
      seen = next;
    }
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(seen * unseen);
    (is(middle) ? seen : unseen) = middle;
  }
  return seen;
}

}  // namespace

std::optional<PlannedEffect> PlanInSamples(const PlanRecords& at, const Effect& effect) {
  const std::optional<SampleTrial> trial = TrialOf(at, effect);
  if (!trial) return std::nullopt;
  const EffectParameter& p = effect.parameters().front();
  PlannedEffect out;
  out.effect = effect.id();
  out.block = effect.block();
  out.parameter = p.name;
  out.unit = p.unit;
  out.null_value = p.null_value;
  out.from_infinity = !std::isfinite(p.null_value);
  out.gain_needed =
      DetectionGain(false) + PriceOfParameters(static_cast<double>(effect.parameters().size()));
  out.size.smallest = Boundary(*trial, [&](double x) { return trial->at(x).seen; });
  out.size.others = trial->others;
  out.size.form = effect.form();
  out.sizes = {out.size};
  if (!std::isfinite(out.size.smallest)) return out;
  out.reference =
      trial->inverted ? out.size.smallest : std::min(2.0 * out.size.smallest, trial->most);
  const Found there = trial->at(out.reference);
  out.reference_gain = there.model_free ? std::numeric_limits<double>::infinity()
                                        : there.own + PriceOfParameters(2.0);
  if (trial->rival.empty()) return out;
  const auto needed = [](const Found& found) {
    return -std::log(kClassProbability) * Temperature(found.own);
  };
  PlannedRival rival;
  rival.effect = trial->rival;
  rival.nats = there.own - there.rival;
  rival.nats_needed = needed(there);
  rival.told_apart_at = Boundary(*trial, [&](double x) {
    const Found found = trial->at(x);
    return found.seen && found.own - found.rival > needed(found);
  });
  out.rivals.push_back(rival);
  return out;
}

}  // namespace howl
