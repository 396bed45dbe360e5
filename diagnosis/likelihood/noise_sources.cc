#include "diagnosis/likelihood/noise_sources.h"

namespace howl {

std::string_view NoiseSourceName(NoiseSource source) {
  switch (source) {
    case NoiseSource::kCombustion:
      return "combustion_noise";
    case NoiseSource::kPressureSensor:
      return "p_sensor_noise";
    case NoiseSource::kHeatReleaseSensor:
      return "q_sensor_noise";
    case NoiseSource::kDuct:
      return "duct_noise";
  }
  return "";
}

NoiseDirection DirectionOf(NoiseSource source, std::complex<double> r, std::complex<double> f) {
  switch (source) {
    case NoiseSource::kCombustion:
      return {0.0, 1.0};
    case NoiseSource::kPressureSensor:
      return {1.0, -f};
    case NoiseSource::kHeatReleaseSensor:
      return {-r, 1.0};
    case NoiseSource::kDuct:
      return {r, 0.0};
  }
  return {};
}

NoiseTurn TurnOf(NoiseSource source) {
  switch (source) {
    case NoiseSource::kCombustion:
      return {};
    case NoiseSource::kPressureSensor:
      return {0.0, -1.0};
    case NoiseSource::kHeatReleaseSensor:
      return {-1.0, 0.0};
    case NoiseSource::kDuct:
      return {1.0, 0.0};
  }
  return {};
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

}  // namespace howl
