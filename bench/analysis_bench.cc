// The whole analysis of the six experiments of the published programme: 16 000 samples each at
// 5000 Hz, on one core; characteristics, lines, delay, flame curve, transfer and its fit.
#include <benchmark/benchmark.h>

#include "estimation/analysis/analyse.h"
#include "tests/estimation/analysis/synthetic_record.h"

namespace howl {
namespace {

std::vector<NamedRecord> SixExperiments() {
  std::vector<NamedRecord> records;
  for (int i = 0; i < 6; ++i) {
    fixtures::SyntheticOptions options;
    options.frequency_hz = 219.0 - 5.0 * i;
    options.phase_deg = -5.0 * i;
    options.loop_gain = 1.25;
    options.second_harmonic = 0.1;
    options.line_ratio = 3.6;
    records.push_back({"exp" + std::to_string(i + 1), 0.56 - 0.02 * i,
                       fixtures::Synthesise(options, static_cast<std::uint64_t>(i)).record});
  }
  return records;
}

void BM_AnalyseSixExperiments(benchmark::State& state) {
  const std::vector<NamedRecord> records = SixExperiments();
  AnalysisOptions options;
  options.threads = 1;
  if (state.range(0) != 0) {
    options.model = DefaultModelSpec();
    options.model->modes = 2;
  }
  for (auto _ : state) benchmark::DoNotOptimize(AnalyseRecords(records, options));
}
BENCHMARK(BM_AnalyseSixExperiments)
    ->ArgName("fit_transfer")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);

void BM_WelchSpectrum(benchmark::State& state) {
  const Record record = SixExperiments().front().record;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        WelchSpectrum(record.pressure, record.heat_release, record.sampling_hz));
  }
}
BENCHMARK(BM_WelchSpectrum)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace howl
