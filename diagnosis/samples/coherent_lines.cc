#include "diagnosis/samples/coherent_lines.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "diagnosis/cuts/acoustic_cut.h"
#include "diagnosis/numerics/local_power.h"
#include "diagnosis/samples/mains.h"

namespace howl {
namespace {

constexpr Eigen::Index kFlank = 60;     // bins on each side that tell the surroundings
constexpr Eigen::Index kPeakReach = 3;  // bins that a line fills
constexpr Eigen::Index kShoulder = 10;  // a resonance fills these too, a line does not
constexpr double kMeanStrength = 20.0;
constexpr double kLeastStrength = 6.0;
constexpr double kShoulderRatio = 8.0;
constexpr double kHarmonicMargin_hz = 4.0;

double ShoulderPower(const Eigen::VectorXd& power, Eigen::Index k) {
  double sum = 0.0;
  double count = 0.0;
  for (Eigen::Index i = k - kShoulder; i <= k + kShoulder; ++i) {
    if (i < 0 || i >= power.size() || std::abs(i - k) <= kPeakReach + 1) continue;
    sum += power[i];
    count += 1.0;
  }
  return sum / std::max(count, 1.0);
}

bool NearHarmonic(const CutRecord& record, double frequency_hz) {
  const double f0 = record.at.cycle_frequency_hz;
  const double order = std::round(frequency_hz / f0);
  return order >= 1.0 &&
         std::abs(frequency_hz - order * f0) < kHarmonicMargin_hz * std::max(1.0, order * 0.6);
}

void FindIn(const std::vector<CutRecord>& records, const std::vector<Eigen::VectorXd>& power,
            std::vector<CoherentLine>* lines) {
  const Eigen::Index n = power[0].size();
  const double least = std::max<double>(3.0, 0.6 * static_cast<double>(records.size()));
  for (Eigen::Index k = kPeakReach; k < n - kPeakReach; ++k) {
    if (power[0][k] < 0.2 * power[0].segment(k - 2, 5).maxCoeff()) continue;
    double sum = 0.0;
    double present = 0.0;
    double counted = 0.0;
    for (std::size_t e = 0; e < records.size(); ++e) {
      if (k >= power[e].size() || NearHarmonic(records[e], records[e].frequency(k))) continue;
      counted += 1.0;
      const double peak = power[e][k];
      const double over = peak / LocalPower(power[e], k, kFlank, kPeakReach);
      sum += over;
      if (over > kLeastStrength && peak > kShoulderRatio * ShoulderPower(power[e], k))
        present += 1.0;
    }
    if (present < least || sum / counted < kMeanStrength) continue;
    const double f = records[0].frequency(k);
    const double reach = static_cast<double>(kPeakReach + 1) * records[0].bin_hz;
    auto near = std::find_if(lines->begin(), lines->end(), [&](const CoherentLine& line) {
      return std::abs(line.frequency_hz - f) <= reach;
    });
    const CoherentLine found{f, sum / counted};
    if (near == lines->end()) {
      lines->push_back(found);
    } else if (near->strength < found.strength) {
      *near = found;
    }
  }
}

// Lines are identified by frequency, because records of another length have another grid of bins.
bool OnOneGrid(const std::vector<CutRecord>& records) {
  return std::all_of(records.begin(), records.end(),
                     [&](const CutRecord& record) { return record.bin_hz == records[0].bin_hz; });
}

void SortByFrequency(std::vector<CoherentLine>* lines) {
  std::sort(lines->begin(), lines->end(), [](const CoherentLine& a, const CoherentLine& b) {
    return a.frequency_hz < b.frequency_hz;
  });
}

Eigen::Index NearestBin(const CutRecord& record, double frequency_hz) {
  return static_cast<Eigen::Index>(std::lround(frequency_hz / record.bin_hz)) - record.first;
}

}  // namespace

std::vector<CoherentLine> FindCoherentLines(const std::vector<CutRecord>& records) {
  std::vector<CoherentLine> lines;
  if (!OnOneGrid(records)) return lines;
  for (const bool pressure : {true, false}) {
    std::vector<Eigen::VectorXd> power;
    for (const CutRecord& record : records) {
      power.push_back(
          (pressure ? record.windowed_pressure : record.windowed_heat_release).cwiseAbs2());
    }
    FindIn(records, power, &lines);
  }
  SortByFrequency(&lines);
  return lines;
}

std::vector<CoherentLine> FindLinesLeftOver(const std::vector<CutRecord>& records,
                                            const EffectFit& fit) {
  std::vector<CoherentLine> lines;
  if (!OnOneGrid(records)) return lines;
  std::vector<Eigen::VectorXd> power;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const ExperimentFit& at = fit.experiments[e];
    power.push_back(at.acoustic_residual.cwiseAbs2().cwiseQuotient(at.acoustic_noise));
    for (Eigen::Index k = 0; k < power[e].size(); ++k) {
      if (records[e].masked[static_cast<std::size_t>(k)]) power[e][k] = 0.0;
    }
  }
  FindIn(records, power, &lines);
  SortByFrequency(&lines);
  return lines;
}

void MaskLines(const std::vector<CoherentLine>& lines, std::vector<CutRecord>* records) {
  for (CutRecord& record : *records) {
    for (const CoherentLine& line : lines) {
      // A strong line has flanks above the noise beyond its main lobe.
      const Eigen::Index reach = kPeakReach + (line.strength > 1e3 ? 5 : 1);
      const Eigen::Index centre = NearestBin(record, line.frequency_hz);
      for (Eigen::Index k = centre - reach; k <= centre + reach; ++k) {
        if (k >= 0 && k < record.acoustic_count) record.masked[static_cast<std::size_t>(k)] = 1;
      }
    }
  }
}

LineOrigin ExplainLines(const std::vector<CutRecord>& records, const EffectFit& base,
                        const std::vector<CoherentLine>& lines) {
  LineOrigin out;
  double strongest = 0.0;
  for (const CoherentLine& line : lines) {
    if (line.strength > strongest) {
      strongest = line.strength;
      out.frequency_hz = line.frequency_hz;
    }
  }
  for (const double mains : kMains_hz) {
    const bool all = std::all_of(lines.begin(), lines.end(), [&](const CoherentLine& line) {
      const double off = line.frequency_hz - mains * std::round(line.frequency_hz / mains);
      return std::abs(off) < 0.012 * mains;
    });
    if (all && !lines.empty() && !out.mains) {
      out.mains = true;
      out.mains_hz = mains;
    }
  }
  for (std::size_t e = 0; e < records.size(); ++e) {
    const CutRecord& record = records[e];
    const ExperimentFit& at = base.experiments[e];
    const Eigen::VectorXcd r = RecordedTransfer(record, *base.effect, {}, at.acoustics);
    for (const CoherentLine& line : lines) {
      const Eigen::Index k = NearestBin(record, line.frequency_hz);
      if (k < 0 || k >= record.acoustic_count) continue;
      const std::complex<double> e_a = at.acoustic_residual[k];
      const double v_a = at.acoustic_noise[k];
      const std::complex<double> gain = r[k + kTapReach];
      if (k >= record.flame_count) {
        const double all = std::norm(e_a) / v_a;
        out.source += all;
        out.heat_release_hum += all;
        out.pressure_hum += all;
        continue;
      }
      const std::complex<double> e_b = at.flame_residual[k];
      const double v_b = at.flame_noise[k];
      // The response of q to p at small amplitude, averaged over the cycle: the prediction around
      // it over p. The line itself is part of both.
      const std::complex<double> f =
          (record.windowed_heat_release[k] - e_b) / record.windowed_pressure[k];
      const auto regress = [&](std::complex<double> a, std::complex<double> b) {
        const std::complex<double> sum = std::conj(a) * e_a / v_a + std::conj(b) * e_b / v_b;
        return std::norm(sum) / (std::norm(a) / v_a + std::norm(b) / v_b);
      };
      out.heat_release_hum += regress(-gain, 1.0);
      out.pressure_hum += regress(1.0, -f);
      out.source += regress(1.0, 0.0);
      if (line.frequency_hz == out.frequency_hz) {
        const Eigen::Index cycle = NearestBin(record, record.at.cycle_frequency_hz);
        const bool q_hum =
            std::abs(e_b) / std::sqrt(v_b) > 3.0 && out.heat_release_hum > out.pressure_hum;
        const double own =
            q_hum ? std::abs(e_a / gain) / std::abs(record.windowed_heat_release[cycle])
                  : std::abs(e_a) / std::abs(record.windowed_pressure[cycle]);
        out.relative_amplitude += own / static_cast<double>(records.size());
      }
    }
  }
  return out;
}

}  // namespace howl
