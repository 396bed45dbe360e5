#include "estimation/record_fit/whittle/information_weights.h"

#include <array>
#include <complex>

#include "estimation/record_fit/whittle/noise_covariance.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

// M of a parameter that moves R is dR e_A x^T and its conjugate transpose, that of one that moves F
// dF e_B y^T: x and y are the rows. Without the noise's part they are -B Sigma.
struct Movement {
  ComplexPair row;     // x
  ComplexPair b;       // B = dR e_A b^T
  ComplexPair turned;  // x^T Sigma^-1
};

}  // namespace

void WeighInformation(const std::vector<NoiseTerm>& noise, const LoopResiduals& at, double share,
                      Eigen::Index i, Eigen::Index in_chunk, InformationWeights* out) {
  const C r = at.r[i];
  const C f = at.f[i];
  const NoiseDirections direction = DirectionsOf(noise, at, i);
  const HermitianPair sigma = CovarianceOf(direction, at, i);
  const HermitianPair w = sigma.Inverse();
  const C closed = Reciprocal(1.0 - Times(r, f));
  Movement by_r{{}, {-Times(closed, f), -closed}, {}};
  Movement by_f{{}, {-closed, -Times(closed, r)}, {}};
  for (Movement* m : {&by_r, &by_f}) {
    const ComplexPair moved = sigma.Before(m->b);
    m->row = {-moved.a, -moved.b};
  }
  std::array<ComplexPair, kMostNoiseTerms> wu;
  const auto sources = static_cast<Eigen::Index>(noise.size());
  const ComplexPair ratio_turn{1.0, -f};  // du of the background, by its ratio
  for (Eigen::Index j = 0; j < sources; ++j) {
    const auto at_j = static_cast<std::size_t>(j);
    const LoopNoise source = noise[at_j].source;
    const double s = at.spectra(i, j);
    const ComplexPair& u = direction[at_j];
    wu[at_j] = w.Apply(u);
    const NoiseTurn turn = TurnOf(source, at.background_ratio);
    by_r.row.a += s * turn.by_r * std::conj(u.a);
    by_r.row.b += s * turn.by_r * std::conj(u.b);
    by_f.row.a += s * turn.by_f * std::conj(u.a);
    by_f.row.b += s * turn.by_f * std::conj(u.b);
  }
  by_r.turned = w.Before(by_r.row);
  by_f.turned = w.Before(by_f.row);
  // tr(W X W Y) and tr(W X W Y^H), of which the second loses what the means would tell.
  const auto beta = [&](const Movement& x, const Movement& y, C w_yx) {
    return Times(w_yx, Dot(x.turned, Conjugate(y.row)) - Dot(sigma.Before(x.b), Conjugate(y.b)));
  };
  const double two = 2.0 * share;
  out->rr.alpha[in_chunk] = two * Times(by_r.turned.a, by_r.turned.a);
  out->rr.beta[in_chunk] = two * beta(by_r, by_r, w.aa);
  out->rf.alpha[in_chunk] = two * Times(by_f.turned.a, by_r.turned.b);
  out->rf.beta[in_chunk] = two * beta(by_r, by_f, std::conj(w.ab));
  out->ff.alpha[in_chunk] = two * Times(by_f.turned.b, by_f.turned.b);
  out->ff.beta[in_chunk] = two * beta(by_f, by_f, w.bb);
  out->aa[in_chunk] = two * w.aa;
  out->ab[in_chunk] = two * std::conj(w.ab);
  out->bb[in_chunk] = two * w.bb;
  for (Eigen::Index j = 0; j < sources; ++j) {
    const auto at_j = static_cast<std::size_t>(j);
    const double s = two * at.spectra(i, j);
    out->r_spectra(in_chunk, j) = s * ConjugateTimes(wu[at_j].a, Dot(by_r.turned, direction[at_j]));
    out->f_spectra(in_chunk, j) = s * ConjugateTimes(wu[at_j].b, Dot(by_f.turned, direction[at_j]));
    for (Eigen::Index k = 0; k < sources; ++k) {
      const ComplexPair& u = direction[static_cast<std::size_t>(k)];
      out->spectra_spectra(in_chunk, j * sources + k) =
          share * at.spectra(i, j) * at.spectra(i, k) * std::norm(Inner(u, wu[at_j]));
    }
  }
  for (Eigen::Index j = 0; j < sources; ++j) {
    const auto at_j = static_cast<std::size_t>(j);
    if (noise[at_j].source != LoopNoise::kBackground) continue;
    // M of the ratio is d (S u)^H and its conjugate transpose, d the background's turn.
    const double s = at.spectra(i, j);
    const ComplexPair& u = direction[at_j];
    const ComplexPair wd = w.Apply(ratio_turn);
    const auto with = [&](const ComplexPair& turned, C wd_left, C wu_left) {
      return two * s *
             (ConjugateTimes(wu_left, Dot(turned, ratio_turn)) +
              ConjugateTimes(wd_left, Dot(turned, u)));
    };
    out->r_ratio[in_chunk] = with(by_r.turned, wd.a, wu[at_j].a);
    out->f_ratio[in_chunk] = with(by_f.turned, wd.b, wu[at_j].b);
    const C mixed = Inner(u, wd);
    out->ratio_ratio +=
        two * s * s *
        (Times(mixed, mixed).real() + Inner(u, wu[at_j]).real() * Inner(ratio_turn, wd).real());
    for (Eigen::Index k = 0; k < sources; ++k) {
      const auto at_k = static_cast<std::size_t>(k);
      const ComplexPair& of_k = direction[at_k];
      out->spectra_ratio(in_chunk, k) =
          two * at.spectra(i, k) * s * Times(Inner(of_k, wd), Inner(u, wu[at_k])).real();
    }
  }
}

}  // namespace howl
