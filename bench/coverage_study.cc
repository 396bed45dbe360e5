// The coverage table: for each kind of synthetic record, the bias, the root mean square error and
// the mean reported standard deviation of every quantity, and the share of its 95 % intervals that
// hold the truth. Gain, tau and slope are relative to the truth; frequencies in Hz, phase in
// degrees.
//
//   coverage_study [RECORDS_PER_ROW] [SEED]
#include <cstdio>
#include <cstdlib>

#include "tests/estimation/analysis/coverage_rows.h"

int main(int argc, char** argv) {
  using namespace howl::fixtures;
  const int records = argc > 1 ? std::atoi(argv[1]) : 50;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  std::array<Tally, kQuantities> all;
  std::printf("%-26s %-10s %6s %11s %11s %11s %9s\n", "row", "quantity", "n", "bias", "rms error",
              "mean std", "coverage");
  std::uint64_t row_seed = seed * 1000003;
  for (const CoverageRow& row : CoverageRows()) {
    const RowResult result = RunCoverageRow(row, records, row_seed += 100000);
    for (int k = 0; k < kQuantities; ++k) {
      const Tally& t = result.tally[static_cast<std::size_t>(k)];
      if (t.count == 0) continue;
      std::printf("%-26s %-10s %6d %11.3e %11.3e %11.3e %8.1f%%\n", row.name.c_str(),
                  kQuantityNames[static_cast<std::size_t>(k)], t.count, t.Bias(), t.Rms(),
                  t.MeanStd(), 100.0 * t.Coverage());
      Tally& sum = all[static_cast<std::size_t>(k)];
      sum.count += t.count;
      sum.covered += t.covered;
    }
    std::printf(
        "%-26s phase rms: paper's method %.4f, default %.4f deg; missed: %d cycles, %d lines\n",
        row.name.c_str(), result.paper_phase_rms_deg, result.tally[kPhase].Rms(),
        result.cycles_missed, result.lines_missed);
  }
  for (int k = 0; k < kQuantities; ++k) {
    const Tally& t = all[static_cast<std::size_t>(k)];
    std::printf("%-26s %-10s %6d %46.1f%%\n", "all", kQuantityNames[static_cast<std::size_t>(k)],
                t.count, 100.0 * t.Coverage());
  }
}
