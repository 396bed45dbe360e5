#include "estimation/record_fit/whittle/whittle_weights.h"

#include <array>
#include <complex>

#include "estimation/record_fit/whittle/noise_covariance.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

// A source's direction is u = (a0 + a1 R, b0 + b1 F), with a1 and b1 as it turns. Sigma, and any
// u^H G u, are linear in the products of two of these numbers, which are the same at all bins:
// a0^2, a0 a1, a1^2, b0^2, b0 b1, b1^2, a0 b0, a0 b1, a1 b0, a1 b1.
using Products = std::array<double, 10>;

Products ProductsOf(LoopNoise source, double background_ratio) {
  const NoiseDirection still = DirectionOf(source, 0.0, 0.0, background_ratio);
  const NoiseTurn turn = TurnOf(source, background_ratio);
  const double a0 = still.acoustic.real();
  const double b0 = still.flame.real();
  const double a1 = turn.by_r;
  const double b1 = turn.by_f;
  return {a0 * a0, a0 * a1, a1 * a1, b0 * b0, b0 * b1, b1 * b1, a0 * b0, a0 * b1, a1 * b0, a1 * b1};
}

double Dot(const Products& x, const Products& y) {
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) sum += x[k] * y[k];
  return sum;
}

}  // namespace

void WeighBins(const std::vector<NoiseTerm>& noise, const Eigen::VectorXd& share,
               const LoopResiduals& at, WhittleWeights* out) {
  const Eigen::Index bins = share.size();
  const auto sources = static_cast<Eigen::Index>(noise.size());
  out->r.resize(bins);
  out->f.resize(bins);
  out->acoustic.resize(bins);
  out->flame.resize(bins);
  out->log_spectra.resize(bins, sources);
  out->ratio = 0.0;
  std::array<Products, kMostNoiseTerms> products;
  Eigen::Index background = -1;
  for (Eigen::Index j = 0; j < sources; ++j) {
    const LoopNoise source = noise[static_cast<std::size_t>(j)].source;
    products[static_cast<std::size_t>(j)] = ProductsOf(source, at.background_ratio);
    if (source == LoopNoise::kBackground) background = j;
  }
  for (Eigen::Index i = 0; i < bins; ++i) {
    Products m = {};
    for (Eigen::Index j = 0; j < sources; ++j) {
      const double s = at.spectra(i, j);
      const Products& of_source = products[static_cast<std::size_t>(j)];
      for (std::size_t k = 0; k < m.size(); ++k) m[k] += s * of_source[k];
    }
    const C r = at.r[i];
    const C f = at.f[i];
    const C conjugate_r_f = ConjugateTimes(r, f);
    const double r_squared = std::norm(r);
    const double f_squared = std::norm(f);
    const HermitianPair sigma{
        m[0] + 2.0 * m[1] * r.real() + m[2] * r_squared,
        m[6] + m[7] * std::conj(f) + m[8] * r + m[9] * std::conj(conjugate_r_f),
        m[3] + 2.0 * m[4] * f.real() + m[5] * f_squared};
    const HermitianPair w = sigma.Inverse();
    const ComplexPair we = w.Apply({at.acoustic[i], at.flame[i]});
    const HermitianPair g{std::norm(we.a) - w.aa, ConjugateTimes(we.b, we.a) - w.ab,
                          std::norm(we.b) - w.bb};
    const double twice = 2.0 * share[i];
    // What all sources' turns add, by R and by F, is sum of S_j a1 u_j and of S_j b1 u_j.
    out->r[i] = twice * std::conj(g.Apply({m[1] + m[2] * r, m[8] + m[9] * f}).a);
    out->f[i] = twice * std::conj(g.Apply({m[7] + m[9] * r, m[4] + m[5] * f}).b);
    out->acoustic[i] = -twice * std::conj(we.a);
    out->flame[i] = -twice * std::conj(we.b);
    const Products of_g = {g.aa,
                           2.0 * g.aa * r.real(),
                           g.aa * r_squared,
                           g.bb,
                           2.0 * g.bb * f.real(),
                           g.bb * f_squared,
                           2.0 * g.ab.real(),
                           2.0 * Times(f, g.ab).real(),
                           2.0 * ConjugateTimes(r, g.ab).real(),
                           2.0 * Times(conjugate_r_f, g.ab).real()};
    for (Eigen::Index j = 0; j < sources; ++j) {
      out->log_spectra(i, j) =
          share[i] * at.spectra(i, j) * Dot(products[static_cast<std::size_t>(j)], of_g);
    }
    if (background < 0) continue;
    const ComplexPair turn{1.0, -f};  // du of the background, by its ratio
    const ComplexPair u{at.background_ratio - r, 1.0 - at.background_ratio * f};
    out->ratio += twice * at.spectra(i, background) * Inner(u, g.Apply(turn)).real();
  }
}

}  // namespace howl
