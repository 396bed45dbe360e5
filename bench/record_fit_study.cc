// Loops of three and four modes with complex residues and a delay of their own, identified from
// records of their limit cycles at five levels of noise: bias and coverage of each parameter.
//
//   [NOISE=0.10,0.40] record_fit_study [RECORDS] [SECONDS] [MODES ...]
//
// NOISE: of the levels of combustion noise, those asked for; all where not given.
// One row for each number of modes and level: combustion noise (of q at saturation), sensors' noise
// (of each signal), the share of all 95 % intervals that contain the truth, the largest bias of a
// parameter in its standard deviations, the root mean square of all errors in theirs, the parameter
// with the worst coverage, the median standard deviations of the first mode's damping and of the
// delay in per cent, and in how many records the true loop's maximum was missed. Below it each
// parameter's share, mean error and root mean square.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "bench/asked.h"
#include "estimation/analysis/spectra/statistics.h"
#include "estimation/kept_memory.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl {
namespace {

struct Tally {
  int inside = 0;
  int all = 0;
  double bias = 0.0;
  double square = 0.0;
};

void Row(int modes, double noise, double sensor_noise, int records, double seconds,
         std::uint64_t seed) {
  ModalLoop loop = DuctOfModes(modes);
  loop.noise = noise;
  loop.sensor_noise = sensor_noise;
  std::map<std::string, Tally> tallies;
  Tally total;
  std::vector<double> damping;
  std::vector<double> delay;
  int missed = 0;
  const auto before = std::chrono::steady_clock::now();
  for (int i = 0; i < records; ++i) {
    const Record record = SimulateModalLoop(loop, seconds, seed + static_cast<std::uint64_t>(i));
    const IdentifiedLoop found = Identify(loop, record, 8);
    if (found.from_truth.log_posterior > found.fit.log_posterior + 1.0) ++missed;
    damping.push_back(100.0 * found.parameters[static_cast<std::size_t>(modes)].std);
    delay.push_back(100.0 * found.parameters.back().std);
    for (const IdentifiedParameter& p : found.parameters) {
      for (Tally* tally : {&total, &tallies[p.name]}) {
        ++tally->all;
        if (std::abs(p.Z()) < 1.96) ++tally->inside;
        tally->bias += p.Z();
        tally->square += p.Z() * p.Z();
      }
    }
  }
  const double took_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  std::string worst;
  double least = 2.0;
  double bias = 0.0;
  for (const auto& [name, tally] : tallies) {
    const double share = static_cast<double>(tally.inside) / tally.all;
    bias = std::max(bias, std::abs(tally.bias / tally.all));
    if (share < least) worst = name;
    least = std::min(least, share);
  }
  std::printf(
      "%d modes, noise %.2f, sensors %.3f: inside %.3f (%d of %d), bias %.2f, rms z %.2f, worst "
      "%s %.2f, std xi_1 %.2f %%, tau %.3f %%, missed %d of %d, %.1f s a record\n",
      modes, noise, sensor_noise, static_cast<double>(total.inside) / total.all, total.inside,
      total.all, bias, std::sqrt(total.square / total.all), worst.c_str(), least, Median(damping),
      Median(delay), missed, records, took_s / records);
  for (const auto& [name, tally] : tallies) {
    std::printf("    %-12s %.3f %6.2f %5.2f\n", name.c_str(),
                static_cast<double>(tally.inside) / tally.all, tally.bias / tally.all,
                std::sqrt(tally.square / tally.all));
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace howl

int main(int argc, char** argv) {
  howl::KeepFreedMemory();
  const int records = argc > 1 ? std::atoi(argv[1]) : 40;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 4.0;
  std::vector<int> numbers;
  for (int i = 3; i < argc; ++i) numbers.push_back(std::atoi(argv[i]));
  if (numbers.empty()) numbers = {3, 4};
  for (const int modes : numbers) {
    std::uint64_t seed = 1000;  // the records of each row are others
    for (const std::string noise : {"0.02", "0.05", "0.10", "0.20", "0.40"}) {
      if (howl::Asked("NOISE", noise)) {
        howl::Row(modes, std::stod(noise), 0.05 * std::stod(noise), records, seconds, seed);
      }
      seed += static_cast<std::uint64_t>(records);
    }
  }
  return 0;
}
