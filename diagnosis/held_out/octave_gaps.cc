#include "diagnosis/held_out/octave_gaps.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace howl {
namespace {

struct Sum {
  double low_hz = 0.0;
  double high_hz = 0.0;
  double excess = 0.0;
  double bands = 0.0;
};

int OctaveOf(const BandErrors& band, double cycle_hz) {
  return static_cast<int>(std::lround(std::log2(0.5 * (band.low_hz + band.high_hz) / cycle_hz)));
}

void Add(const BandErrors& band, Sum* sum) {
  if (sum->bands == 0.0) sum->low_hz = band.low_hz;
  sum->low_hz = std::min(sum->low_hz, band.low_hz);
  sum->high_hz = std::max(sum->high_hz, band.high_hz);
  sum->excess += band.error / band.ceiling - 1.0;
  sum->bands += 1.0;
}

}  // namespace

std::vector<OctaveGap> GapsByOctave(const std::vector<std::string>& names,
                                    const std::vector<double>& cycle_hz,
                                    const HeldOutScore& score) {
  std::vector<OctaveGap> out;
  std::vector<double> excess;
  double total = 0.0;
  for (std::size_t e = 0; e < names.size(); ++e) {
    for (const bool heat_release : {false, true}) {
      std::map<int, Sum> octaves;
      for (const std::vector<BandErrors>& half : score.errors[e]) {
        // Bands of p, then as many of q.
        const std::size_t count = half.size() / 2;
        const std::size_t first = heat_release ? count : 0;
        for (std::size_t i = first; i < first + count; ++i) {
          Add(half[i], &octaves[OctaveOf(half[i], cycle_hz[e])]);
        }
      }
      for (const auto& [octave, sum] : octaves) {
        const double square = sum.excess / sum.bands;
        out.push_back({names[e], heat_release ? LoopBlock::kFlame : LoopBlock::kAcoustics, octave,
                       sum.low_hz, sum.high_hz,
                       std::copysign(std::sqrt(std::abs(square)), square)});
        excess.push_back(sum.excess);
        total += sum.excess;
      }
    }
  }
  for (std::size_t i = 0; i < out.size(); ++i) out[i].share = excess[i] / total;
  return out;
}

}  // namespace howl
