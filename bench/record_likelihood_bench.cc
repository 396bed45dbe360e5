// What the likelihood of a record's loop costs: a value, its gradient with all that a step moves
// and with what one parameter alone moves, an information by matrices of derivatives, the products
// that it is the sum of, beside Eigen's, and one fit.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "bench/record_structures.h"
#include "estimation/record_fit/loop/point_likelihood.h"
#include "estimation/record_fit/point_fit.h"
#include "estimation/record_fit/starts/point_starts.h"
#include "model/noise/random_stream.h"
#include "model/numerics/transposed_product.h"

namespace howl {
namespace {

constexpr double kSamplingHz = 5000.0;
constexpr double kCycleHz = 120.0;
constexpr int kSamples = 20000;

// A cycle with harmonics in noise: of a likelihood's cost the record's length alone matters.
Record CycleInNoise() {
  Record out;
  out.sampling_hz = kSamplingHz;
  RandomStream random(1);
  for (int n = 0; n < kSamples; ++n) {
    const double phase = 2.0 * std::numbers::pi * kCycleHz * n / kSamplingHz;
    out.pressure.push_back(std::sin(phase) + 0.1 * std::sin(2.0 * phase) + 0.1 * random.Normal());
    out.heat_release.push_back(std::cos(phase) + 0.2 * std::cos(2.0 * phase) +
                               0.2 * random.Normal());
  }
  return out;
}

struct Point {
  Point()
      : record(MakeRecordSpectra(CycleInNoise(), kCycleHz, FlameInput::kPressureRate)),
        prior(PriorOf(structure, record)),
        parameters(StartsOf(record, structure, prior, 1, 1).front()) {}

  static PointStructure Structure() {
    for (const NamedStructure& each : RecordStructures()) {
      if (each.name == "spread delays") return each.structure;
    }
    return {};
  }

  PointStructure structure = Structure();
  RecordSpectra record;
  PointPrior prior;
  Eigen::VectorXd parameters;
};

const Point& ThePoint() {
  static const Point point;
  return point;
}

void BM_Value(benchmark::State& state) {
  const Point& at = ThePoint();
  PointLikelihood likelihood(at.record, at.structure);
  Eigen::VectorXd parameters = at.parameters;
  for (auto _ : state) {
    parameters *= 1.0 + 1e-12;
    benchmark::DoNotOptimize(likelihood.Value(parameters));
  }
  state.counters["bins"] = static_cast<double>(at.record.bins());
  state.counters["parameters"] = static_cast<double>(parameters.size());
}
BENCHMARK(BM_Value)->Unit(benchmark::kMicrosecond);

void BM_Gradient(benchmark::State& state) {
  const Point& at = ThePoint();
  PointLikelihood likelihood(at.record, at.structure);
  Eigen::VectorXd parameters = at.parameters;
  for (auto _ : state) {
    parameters *= 1.0 + 1e-12;
    benchmark::DoNotOptimize(likelihood.Gradient(parameters));
  }
}
BENCHMARK(BM_Gradient)->Unit(benchmark::kMicrosecond);

// As the differences of a curvature do.
void BM_GradientWhereOneParameterMoves(benchmark::State& state) {
  const Point& at = ThePoint();
  PointLikelihood likelihood(at.record, at.structure);
  Eigen::Index moved = 0;
  for (auto _ : state) {
    Eigen::VectorXd parameters = at.parameters;
    parameters[moved] += 1e-6;
    moved = (moved + 1) % parameters.size();
    benchmark::DoNotOptimize(likelihood.Gradient(parameters));
  }
}
BENCHMARK(BM_GradientWhereOneParameterMoves)->Unit(benchmark::kMicrosecond);

void BM_Information(benchmark::State& state) {
  const Point& at = ThePoint();
  PointLikelihood likelihood(at.record, at.structure);
  for (auto _ : state) benchmark::DoNotOptimize(likelihood.Information(at.parameters));
}
BENCHMARK(BM_Information)->Unit(benchmark::kMicrosecond);

// Slopes of 64 bins by slopes: 256 rows, as many columns as parameters.
void BM_SlopesBySlopes(benchmark::State& state) {
  const Eigen::MatrixXd slopes = Eigen::MatrixXd::Random(256, state.range(0));
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(slopes.cols(), slopes.cols());
  for (auto _ : state) {
    AddTransposedProduct(slopes, slopes, sum);
    benchmark::DoNotOptimize(sum.data());
  }
}
BENCHMARK(BM_SlopesBySlopes)->Arg(20)->Arg(40)->Arg(80)->Arg(120);

void BM_SlopesBySlopesByEigen(benchmark::State& state) {
  const Eigen::MatrixXd slopes = Eigen::MatrixXd::Random(256, state.range(0));
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(slopes.cols(), slopes.cols());
  for (auto _ : state) {
    sum.noalias() += slopes.transpose() * slopes;
    benchmark::DoNotOptimize(sum.data());
  }
}
BENCHMARK(BM_SlopesBySlopesByEigen)->Arg(20)->Arg(40)->Arg(80)->Arg(120);

void BM_Fit(benchmark::State& state) {
  const Point& at = ThePoint();
  PointFitOptions options;
  options.iterations = 30;
  for (auto _ : state) {
    benchmark::DoNotOptimize(FitPoint(at.record, at.structure, at.prior, at.parameters, options));
  }
}
BENCHMARK(BM_Fit)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace howl
