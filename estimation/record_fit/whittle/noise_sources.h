// Where a record's noise comes from. Each source has a smooth spectrum S_j(f) and a direction
// u_j(f) in the two residuals E_A = P - R Q and E_B = Q - F P of the loop's two cuts:
//
//   combustion  (0, 1)      sensor of p  (1, -F)      sensor of q  (-R, 1)
//   duct        (R, 0): a source other than the flame, which q does not show
//   background  (beta - R, 1 - beta F): both channels show it, p beta times as much as q, as they
//               do what the electronics or the building's mains add
//   hum of p, of q   as their sensors, at multiples of the mains' frequency alone (noise_shape.h):
//               a level, and what each multiple has over it; or one coefficient, at one frequency
//   tone        as the duct's, at one frequency alone
//   gain        as combustion's, beside the cycle's lines (noise_shape.h): the flame's gain
//               fluctuates
//
//   ln S_j(f) = sum over k of c_jk T_k(x),   T_k Chebyshev's polynomials, x = -1 .. 1 in log f
//
// but for hum's. One coefficient: white noise. Spectra are in units of |P|^2 or |Q|^2 under the
// taper.
#ifndef HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_SOURCES_H_
#define HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_SOURCES_H_

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace howl {

enum class LoopNoise : std::uint8_t {
  kCombustion,
  kPressureSensor,
  kHeatReleaseSensor,
  kDuct,
  kBackground,
  kPressureHum,
  kHeatReleaseHum,
  kTone,
  kFlameGain
};

inline constexpr std::size_t kMostNoiseTerms = 9;  // one of each

std::string_view LoopNoiseName(LoopNoise source);

struct NoiseTerm {
  LoopNoise source = LoopNoise::kCombustion;
  Eigen::Index coefficients = 1;
  double line_hz = 0.0;        // of hum the first of its lines, of a tone its frequency
  double memory_cycles = 0.0;  // of a gain: how long it stays what it is
  bool before_curve = false;   // of a gain: of what drives the flame's curve, not of its answer
};

inline bool IsHum(LoopNoise source) {
  return source == LoopNoise::kPressureHum || source == LoopNoise::kHeatReleaseHum;
}
// Whether it has one line.
inline bool HasOneLine(const NoiseTerm& term) {
  return term.source == LoopNoise::kTone || (IsHum(term.source) && term.coefficients == 1);
}
// Whether it is no noise, but oscillations.
inline bool HasLines(LoopNoise source) { return IsHum(source) || source == LoopNoise::kTone; }
// Whether its spectrum is in units of |P|^2.
inline bool IsOfPressure(LoopNoise source) {
  return source == LoopNoise::kPressureSensor || source == LoopNoise::kPressureHum;
}
bool HasBackground(const std::vector<NoiseTerm>& noise);

// u_j at one bin. background_ratio: beta.
struct NoiseDirection {
  std::complex<double> acoustic;
  std::complex<double> flame;
};
inline NoiseDirection DirectionOf(LoopNoise source, std::complex<double> r, std::complex<double> f,
                                  double background_ratio) {
  switch (source) {
    case LoopNoise::kCombustion:
    case LoopNoise::kFlameGain:
      return {0.0, 1.0};
    case LoopNoise::kPressureSensor:
    case LoopNoise::kPressureHum:
      return {1.0, -f};
    case LoopNoise::kHeatReleaseSensor:
    case LoopNoise::kHeatReleaseHum:
      return {-r, 1.0};
    case LoopNoise::kDuct:
    case LoopNoise::kTone:
      return {r, 0.0};
    case LoopNoise::kBackground:
      return {background_ratio - r, 1.0 - background_ratio * f};
  }
  return {};
}

// How u_j moves: d u_j = (by_r dR, by_f dF).
struct NoiseTurn {
  double by_r = 0.0;
  double by_f = 0.0;
};
inline NoiseTurn TurnOf(LoopNoise source, double background_ratio) {
  switch (source) {
    case LoopNoise::kCombustion:
    case LoopNoise::kFlameGain:
      return {};
    case LoopNoise::kPressureSensor:
    case LoopNoise::kPressureHum:
      return {0.0, -1.0};
    case LoopNoise::kHeatReleaseSensor:
    case LoopNoise::kHeatReleaseHum:
      return {-1.0, 0.0};
    case LoopNoise::kDuct:
    case LoopNoise::kTone:
      return {1.0, 0.0};
    case LoopNoise::kBackground:
      return {-1.0, -background_ratio};
  }
  return {};
}

// T_0 .. T_(terms - 1) at each x: rows are bins.
Eigen::MatrixXd ChebyshevColumns(const Eigen::VectorXd& x, Eigen::Index terms);

// S_j at each x.
Eigen::VectorXd LoopNoiseSpectrum(const Eigen::VectorXd& x, const Eigen::VectorXd& coefficients);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_SOURCES_H_
