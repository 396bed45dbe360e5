// Where the time of one diagnosis goes: six simulated operating points of 16 000 samples.
#include <benchmark/benchmark.h>

#include "bench/simulated_rig.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/fit/fitted_rig.h"
#include "diagnosis/gap/slack.h"
#include "diagnosis/samples/coherent_lines.h"
#include "diagnosis/samples/gain_fluctuation.h"
#include "model/effects/catalogue.h"

namespace howl {
namespace {

const std::vector<DiagnosisExperiment>& Rig() {
  static const std::vector<DiagnosisExperiment> rig = SimulatedPoints(6);
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
