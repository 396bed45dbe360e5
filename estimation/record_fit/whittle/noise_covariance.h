// The 2 x 2 covariance Sigma = sum_j S_j u_j u_j^H of one bin's residuals, and products with it
// (whittle.h).
#ifndef HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_COVARIANCE_H_
#define HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_COVARIANCE_H_

#include <Eigen/Core>
#include <array>
#include <complex>
#include <vector>

#include "estimation/record_fit/whittle/whittle.h"
#include "model/numerics/complex_products.h"

namespace howl {

struct ComplexPair {
  std::complex<double> a, b;
};
// x^H y.
inline std::complex<double> Inner(const ComplexPair& x, const ComplexPair& y) {
  return ConjugateTimes(x.a, y.a) + ConjugateTimes(x.b, y.b);
}

// [aa, ab; conj(ab), bb]
struct HermitianPair {
  double aa = 0.0;
  std::complex<double> ab = 0.0;
  double bb = 0.0;

  double Determinant() const { return aa * bb - std::norm(ab); }
  HermitianPair Inverse() const {
    const double scale = 1.0 / Determinant();
    return {bb * scale, -ab * scale, aa * scale};
  }
  ComplexPair Apply(const ComplexPair& x) const {
    return {aa * x.a + Times(ab, x.b), ConjugateTimes(ab, x.a) + bb * x.b};
  }
};

// Of one bin, source after source.
using NoiseDirections = std::array<ComplexPair, kMostNoiseTerms>;

inline NoiseDirections DirectionsOf(const std::vector<NoiseTerm>& noise, const LoopResiduals& at,
                                    Eigen::Index i) {
  NoiseDirections out;
  for (std::size_t j = 0; j < noise.size(); ++j) {
    const NoiseDirection u = DirectionOf(noise[j].source, at.r[i], at.f[i], at.background_ratio);
    out[j] = {u.acoustic, u.flame};
  }
  return out;
}

inline HermitianPair CovarianceOf(const NoiseDirections& direction, const LoopResiduals& at,
                                  Eigen::Index i) {
  HermitianPair out;
  const auto sources = static_cast<std::size_t>(at.spectra.cols());
  for (std::size_t j = 0; j < sources; ++j) {
    const ComplexPair& u = direction[j];
    const double s = at.spectra(i, static_cast<Eigen::Index>(j));
    out.aa += s * std::norm(u.a);
    out.bb += s * std::norm(u.b);
    out.ab += s * ConjugateTimes(u.b, u.a);
  }
  return out;
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_COVARIANCE_H_
