#include "estimation/analysis/oscillations/notch.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "estimation/analysis/spectra/spectrum.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

constexpr double kBlockWidthsApart = 3.0;
// Of f_o in a block: the real tone's image, at -f_o, lies four widths off.
constexpr double kFewestPeriodsInBlock = 2.0;
constexpr double kFewestBlocks = 8.0;

}  // namespace

std::optional<Notch> NotchBeside(double other_hz, double cycle_hz, double duration_s) {
  const double apart = std::abs(other_hz - cycle_hz);
  if (!(apart > 0.0) || !(other_hz > 0.0)) return std::nullopt;
  const double block_s = std::max(kBlockWidthsApart / apart, kFewestPeriodsInBlock / other_hz);
  if (block_s * kFewestBlocks > duration_s) return std::nullopt;
  return Notch{other_hz, block_s};
}

std::vector<double> OscillationAt(std::span<const double> samples, double sampling_hz,
                                  const Notch& notch) {
  const std::vector<double> x = RemoveMean(samples);
  const int length = std::max(2 * static_cast<int>(0.5 * notch.block_s * sampling_hz), 4);
  const Blocks blocks = Demodulate(x, sampling_hz, notch.frequency_hz, length);
  const std::vector<double> window = HannWindow(length);
  std::vector<std::complex<double>> sum(x.size());
  std::vector<double> weight(x.size());
  const std::size_t hop = static_cast<std::size_t>(length) / 2;
  for (std::size_t b = 0; b < blocks.amplitude.size(); ++b) {
    for (std::size_t t = 0; t < window.size(); ++t) {
      sum[b * hop + t] += window[t] * blocks.amplitude[b];
      weight[b * hop + t] += window[t];
    }
  }
  // The last samples belong to no whole block: the last block's amplitude holds there.
  const std::size_t covered = (blocks.amplitude.size() - 1) * hop + window.size();
  std::vector<double> oscillation(x.size());
  const double step = kRadPerSPerHz * notch.frequency_hz / sampling_hz;
  for (std::size_t t = 0; t < x.size(); ++t) {
    const std::complex<double> amplitude =
        t < covered ? sum[t] / weight[t] : blocks.amplitude.back();
    oscillation[t] = (amplitude * std::polar(1.0, step * static_cast<double>(t))).real();
  }
  return oscillation;
}

Record WithoutOscillations(const Record& record, std::span<const Notch> notches) {
  Record rest = record;
  for (const Notch& notch : notches) {
    for (std::vector<double>* channel : {&rest.pressure, &rest.heat_release}) {
      if (channel->empty()) continue;
      const std::vector<double> out = OscillationAt(*channel, record.sampling_hz, notch);
      std::ranges::transform(*channel, out, channel->begin(), std::minus<>());
    }
  }
  return rest;
}

}  // namespace howl
