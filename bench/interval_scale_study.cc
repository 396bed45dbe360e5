// What intervals hold the truth, as the likelihood has them and as the halves of the records widen
// them (estimation/joint_records/interval_scale.h):
//
//   interval_scale_study [RIGS] [SECONDS]
//
// Ducts of four operating points, with loop gains of 0.8 to 1.8 (tests/estimation/record_fit/
// modal_loop.h), fitted as `howl fit` does with two modes: a row for the right model, and one for
// each effect that the rig has and the model has not. Of the loop of small oscillations about rest
// and of the delay: the errors' root mean square in plain deviations, how many of the plain 95 %
// intervals hold the truth, the mean factor by which they are widened, and how many then hold it.
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "bench/seconds.h"
#include "estimation/analysis/spectra/half_width.h"
#include "estimation/joint_records/choose_loop.h"
#include "estimation/joint_records/half_fits.h"
#include "estimation/joint_records/interval_scale.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl {
namespace {

constexpr std::array<double, 4> kGains = {0.8, 1.2, 1.5, 1.8};

struct Case {
  const char* name;
  std::function<void(ModalLoop*)> change;
  ModalInstruments instruments;
};

std::vector<Case> Cases() {
  return {{"the model's own", {}, {}},
          {"a third mode", [](ModalLoop* loop) { loop->modes = DuctOfModes(3).modes; }, {}},
          {"a lag of the flame, 500 Hz", [](ModalLoop* loop) { loop->lag_hz = 500.0; }, {}},
          {"a second path, 0.2, 1 ms later",
           [](ModalLoop* loop) {
             loop->share = 0.2;
             loop->later_s = 1e-3;
           },
           {}},
          {"a low-pass of q, 500 Hz", {}, [](Record* record) { LowPass(500.0, record); }},
          {"a delay that is 4 % longer in the second half",
           [](ModalLoop* loop) { loop->drift = 0.04; },
           {}}};
}

ModalLoop LoopAt(double gain, const std::function<void(ModalLoop*)>& change) {
  ModalLoop loop = DuctOfModes(2);
  if (change) change(&loop);
  loop.tau_s *= 1.0 + 0.03 * (gain - 1.3);
  loop.slope = gain / loop.Open(CycleFrequency(loop, 150.0, 300.0)).real();
  return loop;
}

struct Tally {
  const char* name;
  const char* quantity;
  int plain = 0;
  int widened = 0;
  int all = 0;
  double factor = 0.0;
  double square = 0.0;  // of the errors, in plain deviations

  void Add(const Estimate& estimate, double truth, double by) {
    const double error = std::abs(estimate.value - truth);
    plain += error < HalfWidth95(estimate) ? 1 : 0;
    widened += error < by * HalfWidth95(estimate) ? 1 : 0;
    factor += by;
    square += std::pow(error / estimate.std, 2);
    ++all;
  }
};

void Row(const Case& of, int rigs, double duration_s) {
  std::array<Tally, 4> tallies = {{{"growth rate", "small_signal.growth_rate_1_s"},
                                   {"loop gain", "small_signal.loop_gain"},
                                   {"frequency", "small_signal.frequency_hz"},
                                   {"delay", "tau_s"}}};
  const double begun = Seconds();
  for (int rig = 0; rig < rigs; ++rig) {
    std::vector<ModalLoop> loops;
    std::vector<LoopRecord> records;
    for (const double gain : kGains) {
      loops.push_back(LoopAt(gain, of.change));
      const auto seed = static_cast<std::uint64_t>(1000 * rig) + loops.size();
      records.push_back({"", gain, CycleFrequency(loops.back(), 150.0, 300.0),
                         SimulateModalLoop(loops.back(), duration_s, seed, of.instruments)});
    }
    const ChosenLoop loop = FitLoop(records, RecordLoopSpec{}, {});
    std::vector<FittedLoop> wholes;
    for (std::size_t e = 0; e < records.size(); ++e) {
      wholes.push_back(FittedLoopOf(loop.points[e].record, loop.fit.structure, loop.fit.points[e]));
    }
    const std::vector<IntervalScale> scales =
        ScalesOf(wholes, LoopsOfHalves(records, loop.points, loop.fit.structure, loop.halves));
    for (std::size_t e = 0; e < records.size(); ++e) {
      const FittedLoop& fitted = wholes[e];
      const std::complex<double> root = RestRoot(loops[e], records[e].cycle_hz);
      const double frequency_hz = root.imag() / (2.0 * std::numbers::pi);
      const SmallSignalLoop& small = fitted.small_signal;
      const std::array<std::pair<Estimate, double>, 4> all = {
          {{small.growth_rate_1_s, root.real()},
           {small.loop_gain, loops[e].slope * std::abs(loops[e].Open(frequency_hz))},
           {small.frequency_hz, frequency_hz},
           {fitted.tau_s, loops[e].tau_s}}};
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto scale = std::ranges::find(scales, tallies[i].quantity, &IntervalScale::quantity);
        if (scale == scales.end()) continue;
        tallies[i].Add(all[i].first, all[i].second, scale->Factor());
      }
    }
  }
  std::printf("| %s |", of.name);
  for (const Tally& tally : tallies) {
    const double count = std::max(tally.all, 1);
    std::printf(" %.1f, %d, %.1f, %d of %d |", std::sqrt(tally.square / count), tally.plain,
                tally.factor / count, tally.widened, tally.all);
  }
  std::printf(" %.0f s a rig\n", (Seconds() - begun) / rigs);
  std::fflush(stdout);
}

int Run(int argc, char** argv) {
  const int rigs = argc > 1 ? std::atoi(argv[1]) : 10;
  const double duration_s = argc > 2 ? std::atof(argv[2]) : 2.0;
  std::printf(
      "| what the rig has | growth rate: rms error, held, factor, held |  loop gain | frequency | "
      "delay |\n|---|---|---|---|---|\n");
  for (const Case& each : Cases()) Row(each, rigs, duration_s);
  return 0;
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) { return howl::Run(argc, argv); }
