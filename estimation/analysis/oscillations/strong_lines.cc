#include "estimation/analysis/oscillations/strong_lines.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "estimation/analysis/cycle/characteristics.h"

namespace howl {
namespace {

// The slowest oscillation searched: an eleventh of the lowest cycle, 1.8 Hz where that is 20 Hz,
// but no slower than the record has periods for.
constexpr double kSlowestShare = 1.0 / 11.0;
constexpr double kFarBelow = 1.0 / 8.0;  // of the cycle: in a block of eight periods it has one
constexpr int kMostSum = 4;  // of |a| + |b|: what carries a twentieth is of no higher order

}  // namespace

double Variance(std::span<const double> samples) {
  double sum = 0.0, squares = 0.0;
  for (const double x : RemoveMean(samples)) {
    sum += 1.0;
    squares += x * x;
  }
  return sum > 0.0 ? squares / sum : 0.0;
}

std::vector<OscillationLine> StrongLines(const Record& record, const CrossSpectrum& spectrum,
                                         double least_share) {
  const double duration_s = static_cast<double>(record.pressure.size()) / record.sampling_hz;
  const double slowest_hz = std::max(kSlowestShare * LowestSearched(record.sampling_hz, duration_s),
                                     kFewestPeriods / duration_s);
  const double enough = 2.0 * kBlackmanHarrisMainLobeBins * record.sampling_hz / slowest_hz;
  const int segment = static_cast<int>(
      std::min<double>(std::bit_ceil(static_cast<unsigned>(enough)), spectrum.segment));
  const CrossSpectrum coarse =
      segment == spectrum.segment
          ? spectrum
          : WelchSpectrum(RemoveMean(record.pressure), RemoveMean(record.heat_release),
                          record.sampling_hz, segment);
  const double p_power = Variance(record.pressure);
  const double q_power = Variance(record.heat_release);
  std::vector<OscillationLine> strong;
  for (const SpectralLine& line :
       FindLines(record, coarse, 0.0, {.min_frequency_hz = slowest_hz})) {
    OscillationLine one;
    one.frequency_hz = line.frequency_hz.value;
    const double std = std::isfinite(line.frequency_hz.std) ? line.frequency_hz.std : 0.0;
    one.tolerance_hz = std::max({1.5 * coarse.bin_hz, 3.0 * std, 0.5 * line.width_hz});
    const auto share = [](double amplitude, double power) {
      return power > 0.0 ? 0.5 * amplitude * amplitude / power : 0.0;
    };
    one.p_share = share(line.p_amplitude, p_power);
    one.q_share = share(line.q_amplitude, q_power);
    if (one.frequency_hz > 0.0 && one.Share() >= least_share) strong.push_back(one);
  }
  std::ranges::stable_sort(strong, std::greater<>(), &OscillationLine::Share);
  return strong;
}

bool IsCombination(const OscillationLine& line, std::span<const OscillationLine> stronger) {
  const auto is_at = [&](double hz, double tolerance_hz) {
    return std::abs(line.frequency_hz - std::abs(hz)) <= std::max(tolerance_hz, line.tolerance_hz);
  };
  for (std::size_t i = 0; i < stronger.size(); ++i) {
    const OscillationLine& one = stronger[i];
    for (int a = 1; a <= kMostSum; ++a) {
      if (is_at(a * one.frequency_hz, one.tolerance_hz)) return true;
    }
    for (std::size_t j = 0; j < i; ++j) {
      const OscillationLine& other = stronger[j];
      const double tolerance = std::max(one.tolerance_hz, other.tolerance_hz);
      for (int a = 1; a < kMostSum; ++a) {
        for (int b = 1; a + b <= kMostSum; ++b) {
          if (is_at(a * one.frequency_hz + b * other.frequency_hz, tolerance)) return true;
          if (is_at(a * one.frequency_hz - b * other.frequency_hz, tolerance)) return true;
        }
      }
    }
  }
  return false;
}

std::optional<SlowOscillation> SlowBeside(const Record& record,
                                          std::span<const OscillationLine> lines, double cycle_hz) {
  for (const OscillationLine& line : lines) {
    if (line.frequency_hz > kFarBelow * cycle_hz) continue;
    const bool by_q = line.q_share > line.p_share;
    return SlowOscillation{line.frequency_hz,
                           RemoveMean(by_q ? record.heat_release : record.pressure)};
  }
  return std::nullopt;
}

}  // namespace howl
