// Bias and coverage of slow changes, as fits of simulated records tell them. The amplitude of a
// cycle moves little: from 2 s the delay's dependence is told to a half, and too small by a
// quarter.
#include "estimation/record_fit/slow/slow_signals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "estimation/parallel.h"
#include "estimation/record_fit/starts/richer_structure.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::slow_signals_test {
namespace {

constexpr std::size_t kRecords = 16;
// The simulation's damping and delay follow 2 p^2 with the cycle's harmonics in it.
constexpr double kHarmonics = 0.02;

struct Change {
  std::string name;
  SlowChange change;
  bool PointStructure::*flag;
  double duration_s;
  std::function<void(double squared_amplitude, ModalLoop*)> put;
  // k or r in all, given the loop, the amplitude and the units.
  std::function<double(const ModalLoop&, double squared_amplitude, const LoopPoint& truth,
                       const RecordScale&)>
      truth;
};

void PrintTo(const Change& change, std::ostream* out) { *out << change.name; }

const std::vector<Change>& Changes() {
  static const std::vector<Change> kChanges = {
      {"Damping", SlowChange::kDamping, &PointStructure::damping_follows_amplitude, 2.0,
       [](double square, ModalLoop* loop) { loop->damping_per_square = 0.02 / square; },
       [](const ModalLoop& loop, double square, const LoopPoint& truth, const RecordScale&) {
         const LoopMode& mode = truth.modes[0];
         return 2.0 * loop.damping_per_square * square * mode.omega / std::hypot(mode.a, mode.b);
       }},
      {"Frequency", SlowChange::kFrequency, &PointStructure::frequency_drifts, 2.0,
       [](double, ModalLoop* loop) { loop->frequency_span = 0.01; },
       [](const ModalLoop& loop, double, const LoopPoint& truth, const RecordScale&) {
         const LoopMode& mode = truth.modes[0];
         return 2.0 * loop.frequency_span * mode.omega * mode.omega / std::hypot(mode.a, mode.b);
       }},
      {"Delay", SlowChange::kDelay, &PointStructure::delay_follows_amplitude, 6.0,
       [](double square, ModalLoop* loop) { loop->delay_per_amplitude = 2e-4 / std::sqrt(square); },
       [](const ModalLoop& loop, double square, const LoopPoint&, const RecordScale& scale) {
         return loop.delay_per_amplitude * std::sqrt(square) * scale.AngularFrequency();
       }},
      {"Gain", SlowChange::kGain, &PointStructure::gain_follows_amplitude, 2.0,
       [](double square, ModalLoop* loop) { loop->gain_per_amplitude = -0.2 / std::sqrt(square); },
       [](const ModalLoop& loop, double square, const LoopPoint&, const RecordScale&) {
         const double at_cycle = loop.gain_per_amplitude * std::sqrt(square);
         return at_cycle / (1.0 + at_cycle);
       }}};
  return kChanges;
}

double SquaredAmplitude(const Record& record) {
  return 2.0 * std::pow(RootMeanSquare(record.pressure), 2);
}

class SlowSignals : public testing::TestWithParam<Change> {};

TEST_P(SlowSignals, AreToldWithoutBiasAndWithTheirErrors) {
  const Change& change = GetParam();
  ModalLoop loop = DuctOfModes(2);
  change.put(SquaredAmplitude(SimulateModalLoop(loop, change.duration_s, 1)), &loop);
  std::vector<double> z(kRecords);
  RunUnits(kRecords, 0, [&](std::size_t i) {
    const Record record = SimulateModalLoop(loop, change.duration_s, i + 1);
    RecordSpectra spectra =
        MakeRecordSpectra(record, CycleFrequency(loop, 150.0, 300.0), FlameInput::kPressureRate);
    const PointStructure plain = FreeStructure(2);
    const PointFit before = FitPoint(spectra, plain, PriorOf(plain, spectra),
                                     StartsOf(spectra, plain, PriorOf(plain, spectra), 4, 1));
    const Eigen::Index flame = spectra.flame.cols();
    const LoopPoint found = ToPoint(plain, flame, before.parameters);
    PointStructure structure = plain;
    structure.*change.flag = true;
    SetSlowSignals(structure, &found, {}, &spectra);
    const PointFit fit =
        FitPoint(spectra, structure, PriorOf(structure, spectra),
                 InRicherStructure(spectra, plain, before.parameters, structure, {}));
    const LoopPoint point = ToPoint(structure, flame, fit.parameters);
    const Eigen::Index first =
        structure.FlameChanges() > 0 ? structure.FlameChange(flame) : structure.AcousticChange();
    const Eigen::Index count = ColumnsOf(change.change).count;
    const double deviation = std::sqrt(fit.Covariance().block(first, first, count, count).sum());
    const double truth = change.truth(loop, SquaredAmplitude(record),
                                      WithTruthOf(loop, spectra.scale, found), spectra.scale);
    z[i] = (point.Change(change.change).sum() - truth) / std::hypot(deviation, kHarmonics * truth);
  });
  double mean = 0.0;
  double square = 0.0;
  for (const double each : z) {
    mean += each / kRecords;
    square += each * each / kRecords;
  }
  // Three deviations of a mean, and of a mean square, of so many.
  EXPECT_LT(std::abs(mean), 3.0 / std::sqrt(kRecords));
  EXPECT_LT(square, 1.0 + 3.0 * std::sqrt(2.0 / kRecords));
}

INSTANTIATE_TEST_SUITE_P(AllChanges, SlowSignals, testing::ValuesIn(Changes()),
                         [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace howl::slow_signals_test
