#include "estimation/record_fit/whittle/whittle_weights.h"

#include "estimation/record_fit/whittle/noise_lanes.h"

namespace howl {
namespace {

// Of the bins from i on, as many as V has lanes; adds to `ratio`.
template <typename V>
HOWL_IN_CLONES void WeighLanes(const NoiseOfBins& noise, const double* share,
                               const LoopResiduals& at, Eigen::Index i, WhittleWeights* out,
                               V* ratio) {
  using C = ComplexLanes<V>;
  const CovarianceLanes<V> sigma(noise, at, i);
  const auto& m = sigma.m;
  const C& r = sigma.r;
  const C& f = sigma.f;
  const V scale = 1.0 / sigma.Determinant();
  const V w_aa = sigma.bb * scale;
  const C w_ab = {-sigma.ab.re * scale, -sigma.ab.im * scale};
  const V w_bb = sigma.aa * scale;
  const C acoustic = C::Load(at.acoustic.data() + i);
  const C flame = C::Load(at.flame.data() + i);
  const C we_a = w_aa * acoustic + w_ab * flame;
  const C we_b = ConjugateTimes(w_ab, acoustic) + w_bb * flame;
  const V g_aa = SquaredMagnitude(we_a) - w_aa;
  const C g_ab = ConjugateTimes(we_b, we_a) - w_ab;
  const V g_bb = SquaredMagnitude(we_b) - w_bb;
  const V bin = Lanes<V>::Load(share + i);
  const V twice = 2.0 * bin;
  // What all sources' turns add, by R and by F, is sum of S_j a1 u_j and of S_j b1 u_j.
  const C by_r_b = {m[8] + m[9] * f.re, m[9] * f.im};
  const C by_r = g_aa * C{m[1] + m[2] * r.re, m[2] * r.im} + g_ab * by_r_b;
  const C by_f_a = {m[7] + m[9] * r.re, m[9] * r.im};
  const C by_f = ConjugateTimes(g_ab, by_f_a) + g_bb * C{m[4] + m[5] * f.re, m[5] * f.im};
  Store(twice * Conjugate(by_r), out->r.data() + i);
  Store(twice * Conjugate(by_f), out->f.data() + i);
  Store(-twice * Conjugate(we_a), out->acoustic.data() + i);
  Store(-twice * Conjugate(we_b), out->flame.data() + i);
  const V of_g[kDirectionProducts] = {g_aa,
                                      2.0 * g_aa * r.re,
                                      g_aa * sigma.r_squared,
                                      g_bb,
                                      2.0 * g_bb * f.re,
                                      g_bb * sigma.f_squared,
                                      2.0 * g_ab.re,
                                      2.0 * (f * g_ab).re,
                                      2.0 * ConjugateTimes(r, g_ab).re,
                                      2.0 * (sigma.conjugate_r_f * g_ab).re};
  for (Eigen::Index j = 0; j < noise.count; ++j) {
    const DirectionProducts& of_source = noise.products[static_cast<std::size_t>(j)];
    V sum = of_source[0] * of_g[0];
    for (std::size_t k = 1; k < kDirectionProducts; ++k) sum += of_source[k] * of_g[k];
    const V s = Lanes<V>::Load(at.spectra.col(j).data() + i);
    Lanes<V>::Store(bin * s * sum, out->log_spectra.col(j).data() + i);
  }
  if (noise.background < 0) return;
  // The background's u, and du by its ratio, (1, -F).
  const double beta = noise.ratio;
  const C u_a = {beta - r.re, -r.im};
  const C u_b = {1.0 - beta * f.re, -beta * f.im};
  const C turned_a = C{g_aa, V{}} - g_ab * f;
  const C turned_b = C{g_ab.re, -g_ab.im} - g_bb * f;
  const V s = Lanes<V>::Load(at.spectra.col(noise.background).data() + i);
  *ratio += twice * s * (ConjugateTimes(u_a, turned_a).re + ConjugateTimes(u_b, turned_b).re);
}

// All bins, eight at a time: the same operations for each, whatever the machine's vectors.
HOWL_VECTOR_CLONES double WeighAll(const NoiseOfBins& noise, const double* share, Eigen::Index bins,
                                   const LoopResiduals& at, WhittleWeights* out) {
  EightLanes ratio = {};
  Eigen::Index i = 0;
  for (; i + kLanes <= bins; i += kLanes) WeighLanes(noise, share, at, i, out, &ratio);
  double rest = 0.0;
  for (; i < bins; ++i) WeighLanes(noise, share, at, i, out, &rest);
  for (Eigen::Index k = 0; k < kLanes; ++k) rest += ratio[k];
  return rest;
}

}  // namespace

void WeighBins(const std::vector<NoiseTerm>& noise, const Eigen::VectorXd& share,
               const LoopResiduals& at, WhittleWeights* out) {
  const Eigen::Index bins = share.size();
  out->r.resize(bins);
  out->f.resize(bins);
  out->acoustic.resize(bins);
  out->flame.resize(bins);
  out->log_spectra.resize(bins, static_cast<Eigen::Index>(noise.size()));
  out->ratio = WeighAll({noise, at.background_ratio}, share.data(), bins, at, out);
}

}  // namespace howl
