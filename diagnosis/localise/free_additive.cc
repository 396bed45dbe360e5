#include "diagnosis/localise/free_additive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace howl {
namespace {

constexpr double kAdditiveBandOfCycle = 0.4;  // width, of the cycle's frequency
constexpr double kAdditiveBandShare = 0.1;    // of the largest band's gain
constexpr std::array kNoiseFactors = {1.0, 0.5, 0.2, 0.08, 0.03};
constexpr int kPowers = 14;  // factors of three from a third of the noise

using Number = std::complex<double>;

struct Bin {
  double a;  // |E_A|^2 / V_A
  double b;  // |E_B|^2 / V_B
  // For each place: |u_A|^2 / V_A, |u_B|^2 / V_B, and conj(u) E / V of both parts.
  struct Direction {
    double norm_a;
    double norm_b;
    Number along_a;
    Number along_b;
  };
  std::array<Direction, 3> direction;
};

// Minus the log-likelihood's terms that change, with noise factor `a` in V_A and power `s`.
double Cost(const std::vector<Bin>& bins, std::size_t place, double a, double s) {
  double sum = 0.0;
  for (const Bin& bin : bins) {
    const Bin::Direction& u = bin.direction[place];
    const double norm = u.norm_a / a + u.norm_b;
    const Number along = u.along_a / a + u.along_b;
    sum += std::log(a) + bin.a / a + bin.b + std::log1p(s * norm) -
           s * std::norm(along) / (1.0 + s * norm);
  }
  return sum;
}

double BandGain(const std::vector<Bin>& bins, std::size_t place) {
  double mean = 0.0;
  for (const Bin& bin : bins)
    mean += bin.direction[place].norm_a / static_cast<double>(bins.size());
  const double now = Cost(bins, place, 1.0, 0.0);
  double least = now;
  for (const double a : kNoiseFactors) {
    double s = 1.0 / (3.0 * mean);
    for (int i = 0; i < kPowers; ++i, s *= 3.0) least = std::min(least, Cost(bins, place, a, s));
  }
  return now - least;
}

}  // namespace

AdditiveGain FitFreeAdditive(const std::vector<CutRecord>& records, const EffectFit& base) {
  const double width = kAdditiveBandOfCycle * records[0].at.cycle_frequency_hz;
  const double low = records[0].frequency(0);
  std::vector<std::vector<Bin>> bands;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const CutRecord& record = records[e];
    const ExperimentFit& at = base.experiments[e];
    const Eigen::VectorXcd r = RecordedTransfer(record, *base.effect, {}, at.acoustics);
    for (Eigen::Index k = 0; k < record.flame_count; ++k) {
      if (record.masked[static_cast<std::size_t>(k)]) continue;
      const auto band = static_cast<std::size_t>(std::max(0.0, record.frequency(k) - low) / width);
      if (band >= bands.size()) bands.resize(band + 1);
      const double v_a = at.acoustic_noise[k];
      const double v_b = at.flame_noise[k];
      Number e_a = at.acoustic_residual[k];
      Number e_b = at.flame_residual[k];
      // q from p as the base predicts it here.
      const Number f = (record.windowed_heat_release[k] - e_b) / record.windowed_pressure[k];
      Bin bin{std::norm(e_a) / v_a, std::norm(e_b) / v_b, {}};
      const std::array<std::array<Number, 2>, 3> u = {
          {{1.0, 0.0}, {1.0, -f}, {-r[k + kTapReach], 1.0}}};
      for (std::size_t i = 0; i < u.size(); ++i) {
        bin.direction[i] = {std::norm(u[i][0]) / v_a, std::norm(u[i][1]) / v_b,
                            std::conj(u[i][0]) * e_a / v_a, std::conj(u[i][1]) * e_b / v_b};
      }
      bands[band].push_back(bin);
    }
  }
  AdditiveGain out;
  out.parameters = 2.0 * static_cast<double>(bands.size());
  std::vector<double> best;
  for (const std::vector<Bin>& bins : bands) {
    std::array<double, 3> gain{};
    for (std::size_t i = 0; i < gain.size() && !bins.empty(); ++i) {
      gain[i] = BandGain(bins, i) / kBinCorrelation;
    }
    out.source += gain[0];
    out.pressure += gain[1];
    out.heat_release += gain[2];
    best.push_back(*std::max_element(gain.begin(), gain.end()));
  }
  const double most = *std::max_element(best.begin(), best.end());
  for (std::size_t b = 0; b < best.size(); ++b) {
    if (best[b] < kAdditiveBandShare * most) continue;
    const double from = low + static_cast<double>(b) * width;
    if (out.high_hz == 0.0) out.low_hz = from;
    out.high_hz = from + width;
  }
  return out;
}

}  // namespace howl
