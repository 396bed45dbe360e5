// Fits the spectra of the cuts' residuals by Whittle's likelihood, which minimises
// sum(log V_k + |E_k|^2 / V_k).
//
//   cut A   V = sigma_p^2 + |R|^2 sigma_q^2      white sensor noise on both channels
//   cut B   log V = Chebyshev series in frequency  combustion noise, whatever its colour
//
// Terms are capped at kNoiseCap times the variance, so that a coherent line or a misfit in a narrow
// band does not raise the noise elsewhere.
#ifndef HOWL_DIAGNOSIS_NOISE_NOISE_FIT_H_
#define HOWL_DIAGNOSIS_NOISE_NOISE_FIT_H_

#include <Eigen/Core>
#include <vector>

namespace howl {

inline constexpr double kNoiseCap = 12.0;
inline constexpr int kFlameNoiseTerms = 7;

Eigen::VectorXd AcousticNoise(const Eigen::VectorXcd& residual, const Eigen::VectorXd& gain_squared,
                              const std::vector<char>& masked);

Eigen::VectorXd FlameNoise(const Eigen::VectorXcd& residual, const std::vector<char>& masked);

// sum(log V + |E|^2 / V) over the bins that are not masked, per independent bin.
double WhittleCost(const Eigen::VectorXcd& residual, const Eigen::VectorXd& variance,
                   const std::vector<char>& masked);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_NOISE_NOISE_FIT_H_
