// Sigma of bins side by side (whittle.h), for sources compiled as complex_lanes.h has it.
#ifndef HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_LANES_H_
#define HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_LANES_H_

#include "estimation/record_fit/whittle/noise_of_bins.h"
#include "estimation/record_fit/whittle/whittle.h"
#include "model/numerics/complex_lanes.h"

namespace howl {

// Sigma = [aa, ab; conj(ab), bb] of the bins from i on, as many as V has lanes.
template <typename V>
struct CovarianceLanes {
  HOWL_IN_CLONES CovarianceLanes(const NoiseOfBins& noise, const LoopResiduals& at, Eigen::Index i)
      : r(ComplexLanes<V>::Load(at.r.data() + i)), f(ComplexLanes<V>::Load(at.f.data() + i)) {
    for (Eigen::Index j = 0; j < noise.count; ++j) {
      const V s = Lanes<V>::Load(at.spectra.col(j).data() + i);
      const DirectionProducts& of_source = noise.products[static_cast<std::size_t>(j)];
      for (std::size_t k = 0; k < kDirectionProducts; ++k) m[k] += s * of_source[k];
    }
    conjugate_r_f = ConjugateTimes(r, f);
    r_squared = SquaredMagnitude(r);
    f_squared = SquaredMagnitude(f);
    aa = m[0] + 2.0 * m[1] * r.re + m[2] * r_squared;
    ab = {m[6] + m[7] * f.re + m[8] * r.re + m[9] * conjugate_r_f.re,
          m[8] * r.im - m[7] * f.im - m[9] * conjugate_r_f.im};
    bb = m[3] + 2.0 * m[4] * f.re + m[5] * f_squared;
  }
  HOWL_IN_CLONES V Determinant() const { return aa * bb - SquaredMagnitude(ab); }

  V m[kDirectionProducts] = {};  // sum of S_j times the products
  ComplexLanes<V> r, f, conjugate_r_f;
  V r_squared, f_squared;
  V aa;
  ComplexLanes<V> ab;
  V bb;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_LANES_H_
