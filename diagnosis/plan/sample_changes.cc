#include "diagnosis/plan/sample_changes.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/fitter.h"
#include "diagnosis/numerics/real_fft.h"
#include "diagnosis/records/channel_signal.h"
#include "diagnosis/samples/gain_fluctuation.h"
#include "diagnosis/samples/sample_limits.h"
#include "diagnosis/samples/static_map.h"
#include "diagnosis/verdict/verdict.h"
#include "model/noise/random_stream.h"

namespace howl {
namespace {

constexpr double kFullScale = 1.2;  // as model/effects/forms/quantisation.cc has it

double Mean(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

}  // namespace

double SampleAmplitude(const std::vector<double>& x) {
  double mean = 0.0;
  double square = 0.0;
  const auto count = static_cast<double>(x.size());
  for (const double value : x) mean += value / count;
  for (const double value : x) square += (value - mean) * (value - mean) / count;
  return std::sqrt(2.0 * square);
}

SampleFinding PricedFinding(double own, double rival, double parameters) {
  const double price = PriceOfParameters(parameters);
  return {own - price > DetectionGain(false), own - price, rival - price, false};
}

EffectFit EvaluatedBase(const std::vector<CutRecord>& records, const EffectFit& base) {
  EffectFit fit = base;
  Fitter fitter(records, *base.effect, nullptr);
  fitter.SetNoise(base);
  fitter.Evaluate(&fit);
  return fit;
}

SampleFinding SeeFluctuation(const PlanRecords& at, bool coloured, double time_s, double size) {
  std::vector<CutRecord> records = *at.records;
  for (std::size_t e = 0; e < records.size(); ++e) {
    CutRecord& record = records[e];
    const double tau_s = at.base->DelayOf(e);
    const FlameColumns columns = MakeFlameColumns(record, *at.base->effect, {}, tau_s);
    const FlameBasis basis(columns.range);
    const Eigen::VectorXd& flame = at.base->experiments[e].flame;
    RandomStream random(kPlanSeed + e);
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
  const GainFluctuation found = EstimateGainFluctuation(records, EvaluatedBase(records, *at.base));
  const double for_switching = found.coloured_cost - found.switching_cost;
  const double of_coloured = found.gain - std::max(0.0, for_switching);
  const double of_switching = found.gain - std::max(0.0, -for_switching);
  return coloured ? PricedFinding(of_coloured, of_switching, 2.0)
                  : PricedFinding(of_switching, of_coloured, 2.0);
}

SampleFinding SeeClipping(const PlanRecords& at, Channel channel, double fraction) {
  std::vector<DiagnosisExperiment> changed = *at.experiments;
  for (DiagnosisExperiment& each : changed) {
    std::vector<double>& x = SignalOf(each.record, channel);
    const double mean = Mean(x);
    const double most = fraction * SampleAmplitude(x);
    for (double& value : x) value = mean + std::clamp(value - mean, -most, most);
  }
  // Edges are those of the samples, for which nothing need be cut.
  std::vector<CutRecord> samples = *at.records;
  for (std::size_t e = 0; e < samples.size(); ++e) {
    SignalOf(samples[e], channel) = Eigen::Map<const Eigen::VectorXd>(
        SignalOf(changed[e].record, channel).data(), samples[e].samples);
  }
  if (HasSharpEdge(samples, channel)) return {true, 0.0, 0.0, true};
  const std::vector<CutRecord> records = MakeCutRecords(changed, (*at.records)[0].model);
  const double gain = FitClipping(records, channel, EvaluatedBase(records, *at.base)).gain;
  return PricedFinding(gain, 0.0, kClippingShapes * static_cast<double>(records.size()));
}

SampleFinding SeeLevels(const PlanRecords& at, double levels) {
  std::vector<CutRecord> records = *at.records;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const double step =
        2.0 * kFullScale * SampleAmplitude((*at.experiments)[e].record.pressure) / levels;
    for (double& value : records[e].pressure) value = step * std::nearbyint(value / step);
  }
  const bool found = FindQuantisation(records).found;
  return {found, 0.0, 0.0, found};
}

}  // namespace howl
