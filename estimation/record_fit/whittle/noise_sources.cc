#include "estimation/record_fit/whittle/noise_sources.h"

#include <algorithm>

namespace howl {

std::string_view LoopNoiseName(LoopNoise source) {
  switch (source) {
    case LoopNoise::kCombustion:
      return "combustion_noise";
    case LoopNoise::kPressureSensor:
      return "p_sensor_noise";
    case LoopNoise::kHeatReleaseSensor:
      return "q_sensor_noise";
    case LoopNoise::kDuct:
      return "duct_noise";
    case LoopNoise::kBackground:
      return "background";
    case LoopNoise::kPressureHum:
      return "p_hum";
    case LoopNoise::kHeatReleaseHum:
      return "q_hum";
    case LoopNoise::kTone:
      return "tone";
    case LoopNoise::kFlameGain:
      return "flame_gain";
  }
  return "";
}

bool HasBackground(const std::vector<NoiseTerm>& noise) {
  return std::ranges::any_of(
      noise, [](const NoiseTerm& term) { return term.source == LoopNoise::kBackground; });
}

Eigen::MatrixXd ChebyshevColumns(const Eigen::VectorXd& x, Eigen::Index terms) {
  Eigen::MatrixXd out(x.size(), terms);
  out.col(0).setOnes();
  if (terms > 1) out.col(1) = x;
  for (Eigen::Index k = 2; k < terms; ++k) {
    out.col(k) = 2.0 * x.cwiseProduct(out.col(k - 1)) - out.col(k - 2);
  }
  return out;
}

Eigen::VectorXd LoopNoiseSpectrum(const Eigen::VectorXd& x, const Eigen::VectorXd& coefficients) {
  return (ChebyshevColumns(x, coefficients.size()) * coefficients).array().exp();
}

}  // namespace howl
