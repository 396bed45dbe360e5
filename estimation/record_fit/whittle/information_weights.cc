#include "estimation/record_fit/whittle/information_weights.h"

#include "estimation/record_fit/whittle/noise_lanes.h"

namespace howl {
namespace {

template <typename V>
struct PairLanes {
  ComplexLanes<V> a, b;
};

// x^T y, without a conjugate.
template <typename V>
HOWL_IN_CLONES ComplexLanes<V> Dot(const PairLanes<V>& x, const PairLanes<V>& y) {
  return x.a * y.a + x.b * y.b;
}

// x^H y.
template <typename V>
HOWL_IN_CLONES ComplexLanes<V> Inner(const PairLanes<V>& x, const PairLanes<V>& y) {
  return ConjugateTimes(x.a, y.a) + ConjugateTimes(x.b, y.b);
}

template <typename V>
HOWL_IN_CLONES PairLanes<V> Conjugate(const PairLanes<V>& x) {
  return {Conjugate(x.a), Conjugate(x.b)};
}

// [aa, ab; conj(ab), bb]
template <typename V>
struct HermitianLanes {
  V aa;
  ComplexLanes<V> ab;
  V bb;

  HOWL_IN_CLONES PairLanes<V> Apply(const PairLanes<V>& x) const {
    return {aa * x.a + ab * x.b, ConjugateTimes(ab, x.a) + bb * x.b};
  }
  // x^T times this.
  HOWL_IN_CLONES PairLanes<V> Before(const PairLanes<V>& x) const {
    return {aa * x.a + ConjugateTimes(ab, x.b), ab * x.a + bb * x.b};
  }
};

// M of a parameter that moves R is dR e_A x^T and its conjugate transpose, that of one that moves F
// dF e_B y^T: x and y are the rows. Without the noise's part they are -B Sigma.
template <typename V>
struct MovementLanes {
  PairLanes<V> b;        // B = dR e_A b^T
  PairLanes<V> b_sigma;  // b^T Sigma
  PairLanes<V> row;      // x
  PairLanes<V> turned;   // x^T Sigma^-1
};

// Of the bins from i on, which are those from `to` on in their chunk, as many as V has lanes; adds
// to `ratio_ratio`.
template <typename V>
HOWL_IN_CLONES void WeighLanes(const NoiseOfBins& noise, const LoopResiduals& at,
                               const double* share, Eigen::Index i, Eigen::Index to,
                               InformationWeights* out, V* ratio_ratio) {
  using C = ComplexLanes<V>;
  using Pair = PairLanes<V>;
  const CovarianceLanes<V> covariance(noise, at, i);
  const C& r = covariance.r;
  const C& f = covariance.f;
  const HermitianLanes<V> sigma{covariance.aa, covariance.ab, covariance.bb};
  const V scale = 1.0 / covariance.Determinant();
  const V less = -scale;
  const HermitianLanes<V> w{sigma.bb * scale, less * sigma.ab, sigma.aa * scale};
  const C open = r * f;
  const C minus = Reciprocal(C{open.re - 1.0, open.im});  // -1 / (1 - R F)
  MovementLanes<V> by_r;
  MovementLanes<V> by_f;
  by_r.b = {minus * f, minus};
  by_f.b = {minus, minus * r};
  for (MovementLanes<V>* m : {&by_r, &by_f}) {
    m->b_sigma = sigma.Before(m->b);
    m->row = {C{-m->b_sigma.a.re, -m->b_sigma.a.im}, C{-m->b_sigma.b.re, -m->b_sigma.b.im}};
  }
  V spectrum[kMostNoiseTerms];
  Pair direction[kMostNoiseTerms];
  Pair wu[kMostNoiseTerms];
  for (Eigen::Index j = 0; j < noise.count; ++j) {
    const DirectionTerms& of = noise.terms[static_cast<std::size_t>(j)];
    const V s = Lanes<V>::Load(at.spectra.col(j).data() + i);
    const Pair u{{of.a0 + of.a1 * r.re, of.a1 * r.im}, {of.b0 + of.b1 * f.re, of.b1 * f.im}};
    spectrum[j] = s;
    direction[j] = u;
    wu[j] = w.Apply(u);
    const V turn_r = s * of.a1;
    const V turn_f = s * of.b1;
    by_r.row = {by_r.row.a + turn_r * Conjugate(u.a), by_r.row.b + turn_r * Conjugate(u.b)};
    by_f.row = {by_f.row.a + turn_f * Conjugate(u.a), by_f.row.b + turn_f * Conjugate(u.b)};
  }
  by_r.turned = w.Before(by_r.row);
  by_f.turned = w.Before(by_f.row);
  const V bin = Lanes<V>::Load(share + i);
  const V two = 2.0 * bin;
  // tr(W X W Y) and tr(W X W Y^H), of which the second loses what the means would tell.
  Store(two * (by_r.turned.a * by_r.turned.a), out->rr.alpha.data() + to);
  Store(two * (by_f.turned.a * by_r.turned.b), out->rf.alpha.data() + to);
  Store(two * (by_f.turned.b * by_f.turned.b), out->ff.alpha.data() + to);
  const C rr = Dot(by_r.turned, Conjugate(by_r.row)) - Dot(by_r.b_sigma, Conjugate(by_r.b));
  const C rf = Dot(by_r.turned, Conjugate(by_f.row)) - Dot(by_r.b_sigma, Conjugate(by_f.b));
  const C ff = Dot(by_f.turned, Conjugate(by_f.row)) - Dot(by_f.b_sigma, Conjugate(by_f.b));
  const V two_aa = two * w.aa;
  const V two_bb = two * w.bb;
  const C two_ab = two * Conjugate(w.ab);
  Store(two_aa * rr, out->rr.beta.data() + to);
  Store(two_ab * rf, out->rf.beta.data() + to);
  Store(two_bb * ff, out->ff.beta.data() + to);
  Store(C{two_aa, V{}}, out->aa.data() + to);
  Store(two_ab, out->ab.data() + to);
  Store(C{two_bb, V{}}, out->bb.data() + to);
  for (Eigen::Index j = 0; j < noise.count; ++j) {
    const V s = two * spectrum[j];
    Store(s * ConjugateTimes(wu[j].a, Dot(by_r.turned, direction[j])),
          out->r_spectra.col(j).data() + to);
    Store(s * ConjugateTimes(wu[j].b, Dot(by_f.turned, direction[j])),
          out->f_spectra.col(j).data() + to);
    for (Eigen::Index k = j; k < noise.count; ++k) {
      const V both = bin * spectrum[j] * spectrum[k];
      Lanes<V>::Store(both * SquaredMagnitude(Inner(direction[k], wu[j])),
                      out->spectra_spectra.col(j * noise.count + k).data() + to);
    }
  }
  if (noise.background < 0) return;
  // M of the ratio is d (S u)^H and its conjugate transpose, d the background's turn (1, -F).
  const V s = spectrum[noise.background];
  const Pair& u = direction[noise.background];
  const Pair& of_u = wu[noise.background];
  const Pair turn{{V{} + 1.0, V{}}, {-f.re, -f.im}};
  const Pair of_turn = w.Apply(turn);
  const V weight = two * s;
  Store(weight * (ConjugateTimes(of_u.a, Dot(by_r.turned, turn)) +
                  ConjugateTimes(of_turn.a, Dot(by_r.turned, u))),
        out->r_ratio.data() + to);
  Store(weight * (ConjugateTimes(of_u.b, Dot(by_f.turned, turn)) +
                  ConjugateTimes(of_turn.b, Dot(by_f.turned, u))),
        out->f_ratio.data() + to);
  const C mixed = Inner(u, of_turn);
  *ratio_ratio += weight * s * ((mixed * mixed).re + Inner(u, of_u).re * Inner(turn, of_turn).re);
  for (Eigen::Index k = 0; k < noise.count; ++k) {
    const C both = Inner(direction[k], of_turn) * Inner(u, wu[k]);
    Lanes<V>::Store(weight * spectrum[k] * both.re, out->spectra_ratio.col(k).data() + to);
  }
}

HOWL_VECTOR_CLONES double WeighChunk(const NoiseOfBins& noise, const LoopResiduals& at,
                                     const double* share, Eigen::Index first, Eigen::Index bins,
                                     InformationWeights* out) {
  EightLanes ratio = {};
  Eigen::Index i = 0;
  for (; i + kLanes <= bins; i += kLanes) WeighLanes(noise, at, share, first + i, i, out, &ratio);
  double rest = 0.0;
  for (; i < bins; ++i) WeighLanes(noise, at, share, first + i, i, out, &rest);
  for (Eigen::Index k = 0; k < kLanes; ++k) rest += ratio[k];
  return rest;
}

}  // namespace

void WeighInformation(const NoiseOfBins& noise, const LoopResiduals& at, const double* share,
                      Eigen::Index first, Eigen::Index bins, InformationWeights* out) {
  out->ratio_ratio += WeighChunk(noise, at, share, first, bins, out);
}

}  // namespace howl
