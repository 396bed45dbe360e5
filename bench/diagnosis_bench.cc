// Where the time of one diagnosis goes: six simulated operating points of 16 000 samples.
#include <benchmark/benchmark.h>

#include "diagnosis/bootstrap/fitted_rig.h"
#include "diagnosis/coherent_lines.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/effect_fit.h"
#include "diagnosis/gain_fluctuation.h"
#include "diagnosis/slack.h"
#include "model/simulate.h"

namespace howl {
namespace {

const std::vector<DiagnosisExperiment>& Rig() {
  static const std::vector<DiagnosisExperiment> rig = [] {
    std::vector<SimulationCase> cases;
    for (int k = 0; k < 6; ++k) {
      SimulationCase one;
      one.rig.model = {
          {{206.0 - 2.0 * k, 0.17 - 0.01 * k, 6400.0 - 200.0 * k, 1700.0, 3.0}, 0.00352},
          {FlameShape::kTanh, -0.72e-4, 0.45, 0.0}};
      one.rig.noise = {4e-7, 1200.0, 0.02, 0.002};
      one.rig.past = {{0.1, 205.0, 0.0, 0.0}};
      one.seed = static_cast<std::uint64_t>(k);
      cases.push_back(std::move(one));
    }
    SimulationOptions options;
    options.duration_s = 3.2;
    options.settle_s = 0.5;
    std::vector<DiagnosisExperiment> experiments;
    for (const SimulatedRecord& record : SimulateBatch(cases, options)) {
      experiments.push_back({"exp" + std::to_string(experiments.size() + 1),
                             0.56 - 0.02 * static_cast<double>(experiments.size()),
                             {record.sampling_hz, record.pressure, record.heat_release}});
    }
    return experiments;
  }();
  return rig;
}

void BM_PrepareRecords(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(MakeCutRecords(Rig()));
}
BENCHMARK(BM_PrepareRecords)->Unit(benchmark::kMillisecond);

void BM_FitBase(benchmark::State& state) {
  const std::vector<CutRecord> records = MakeCutRecords(Rig());
  for (auto _ : state) benchmark::DoNotOptimize(FitBase(records));
}
BENCHMARK(BM_FitBase)->Unit(benchmark::kMillisecond);

// The argument counts the catalogue's forms.
void BM_FitEffect(benchmark::State& state) {
  const std::vector<CutRecord> records = MakeCutRecords(Rig());
  const EffectFit base = FitBase(records);
  const EffectPointer effect = Catalogue()[static_cast<std::size_t>(state.range(0))];
  state.SetLabel(std::string(effect->id()));
  if (effect->kind() != EffectKind::kTransfer) {
    state.SkipWithError("not fitted as a transfer function");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(FitEffect(records, effect, base));
}
BENCHMARK(BM_FitEffect)->DenseRange(0, 11)->Unit(benchmark::kMillisecond);

// A replicate of the bootstrap is this for every operating point, and a search.
void BM_SimulateFittedRig(benchmark::State& state) {
  const std::vector<CutRecord> records = MakeCutRecords(Rig());
  const EffectFit base = FitBase(records);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        Simulate(FittedRig(records[0], base, 0, 1), FittedRigOptions(records[0])));
  }
}
BENCHMARK(BM_SimulateFittedRig)->Unit(benchmark::kMillisecond);

void BM_Slack(benchmark::State& state) {
  const std::vector<CutRecord> records = MakeCutRecords(Rig());
  const EffectFit base = FitBase(records);
  for (auto _ : state) benchmark::DoNotOptimize(ComputeSlack(records, base));
}
BENCHMARK(BM_Slack)->Unit(benchmark::kMillisecond);

void BM_GainFluctuation(benchmark::State& state) {
  const std::vector<CutRecord> records = MakeCutRecords(Rig());
  const EffectFit base = FitBase(records);
  for (auto _ : state) benchmark::DoNotOptimize(EstimateGainFluctuation(records, base));
}
BENCHMARK(BM_GainFluctuation)->Unit(benchmark::kMillisecond);

void BM_Diagnose(benchmark::State& state) {
  DiagnosisOptions options;
  options.threads = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(Diagnose(Rig(), options));
}
BENCHMARK(BM_Diagnose)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();

}  // namespace
}  // namespace howl
