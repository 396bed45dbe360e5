// Lines put into the samples: a hum of the mains, a tone.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/plan/sample_changes.h"
#include "diagnosis/samples/coherent_lines.h"
#include "model/noise/random_stream.h"

namespace howl {
namespace {

constexpr int kMultiples[] = {1, 3, 5};  // as model/effects/forms/mains_hum.cc simulates it
constexpr double kSlopeStep = 1e-3;      // of the flame's range

void AddLine(double amplitude, double hz, double phase_rad, double sampling_hz,
             std::vector<double>* x) {
  const double step = 2.0 * std::numbers::pi * hz / sampling_hz;
  for (std::size_t i = 0; i < x->size(); ++i) {
    (*x)[i] += amplitude * std::cos(step * static_cast<double>(i) + phase_rad);
  }
}

SampleFinding FindLines(const PlanRecords& at, const std::vector<DiagnosisExperiment>& changed,
                        bool hum) {
  std::vector<CutRecord> records = MakeCutRecords(changed, (*at.records)[0].model);
  const std::vector<CoherentLine> lines = FindCoherentLines(records);
  if (lines.empty()) return {};
  MaskLines(lines, &records);
  const LineOrigin origin = ExplainLines(records, EvaluatedBase(records, *at.base), lines);
  const double of_hum = origin.mains ? std::max(origin.heat_release_hum, origin.pressure_hum) : 0.0;
  return hum ? PricedFinding(of_hum, origin.source, 2.0)
             : PricedFinding(origin.source, of_hum, 2.0);
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

}  // namespace

SampleFinding SeeHum(const PlanRecords& at, double mains_hz, double rel) {
  std::vector<DiagnosisExperiment> changed = *at.experiments;
  RandomStream random(kPlanSeed);
  for (DiagnosisExperiment& each : changed) {
    const double amplitude = rel * SampleAmplitude(each.record.heat_release);
    for (const int k : kMultiples) {
      AddLine(amplitude / k, k * mains_hz, 2.0 * std::numbers::pi * random.Uniform(),
              each.record.sampling_hz, &each.record.heat_release);
    }
  }
  return FindLines(at, changed, true);
}

SampleFinding SeeTone(const PlanRecords& at, double hz, double rel) {
  std::vector<DiagnosisExperiment> changed = *at.experiments;
  for (std::size_t e = 0; e < changed.size(); ++e) {
    const CutRecord& record = (*at.records)[e];
    const Complex<double> g =
        AcousticResponse(ToAcoustics(record.model, at.base->experiments[e].acoustics), hz);
    const Response acoustics(g.re, g.im);
    const Response s = LaplaceVariable(hz);
    const Response flame = MeanSlope(record, *at.base, e) * s * std::exp(-s * at.base->DelayOf(e));
    Record& samples = changed[e].record;
    const Response p =
        acoustics * (rel * SampleAmplitude(samples.heat_release)) / (1.0 - acoustics * flame);
    const Response q = flame * p;
    AddLine(std::abs(p), hz, std::arg(p), samples.sampling_hz, &samples.pressure);
    AddLine(std::abs(q), hz, std::arg(q), samples.sampling_hz, &samples.heat_release);
  }
  return FindLines(at, changed, false);
}

}  // namespace howl
