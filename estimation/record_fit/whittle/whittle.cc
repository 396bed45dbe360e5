#include "estimation/record_fit/whittle/whittle.h"

#include <complex>

#include "estimation/record_fit/whittle/noise_covariance.h"
#include "estimation/record_fit/whittle/whittle_weights.h"

namespace howl {
namespace {

using C = std::complex<double>;

Eigen::VectorXd GatherGradient(const std::vector<NoiseTerm>& noise, const WhittleWeights& weights,
                               const LoopDerivatives& d) {
  const Eigen::Index acoustic = d.r.cols();
  const Eigen::Index flame = d.f.cols();
  Eigen::VectorXd out(WhittleParameters(noise, d));
  out.head(acoustic) =
      (d.r.transpose() * weights.r + d.acoustic.transpose() * weights.acoustic).real();
  out.segment(acoustic, flame) =
      (d.f.transpose() * weights.f + d.flame.transpose() * weights.flame).real();
  Eigen::Index row = acoustic + flame;
  for (std::size_t j = 0; j < d.log_spectra.size(); ++j) {
    const Eigen::MatrixXd& basis = d.log_spectra[j];
    out.segment(row, basis.cols()) =
        basis.transpose() * weights.log_spectra.col(static_cast<Eigen::Index>(j));
    row += basis.cols();
  }
  if (HasBackground(noise)) out[row] = weights.ratio;
  return out;
}

}  // namespace

Eigen::Index WhittleParameters(const std::vector<NoiseTerm>& noise,
                               const LoopDerivatives& derivatives) {
  Eigen::Index out = derivatives.r.cols() + derivatives.f.cols();
  for (const Eigen::MatrixXd& basis : derivatives.log_spectra) out += basis.cols();
  return HasBackground(noise) ? out + 1 : out;
}

Eigen::Matrix2cd NoiseCovariance(const std::vector<NoiseTerm>& noise, const LoopResiduals& at,
                                 Eigen::Index bin) {
  const HermitianPair sigma = CovarianceOf(DirectionsOf(noise, at, bin), at, bin);
  Eigen::Matrix2cd out;
  out << sigma.aa, sigma.ab, std::conj(sigma.ab), sigma.bb;
  return out;
}

Eigen::VectorXd WhittleGradient(const std::vector<NoiseTerm>& noise, const Eigen::VectorXd& share,
                                const LoopResiduals& at, const LoopDerivatives& derivatives) {
  WhittleWeights weights;
  WeighBins(noise, share, at, &weights);
  return GatherGradient(noise, weights, derivatives);
}

}  // namespace howl
