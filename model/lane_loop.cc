#include "model/lane_loop.h"

#include <cmath>

#include "model/fast_tanh.h"

// One copy for each vector width; the machine takes the widest that it has. All give the same
// bits: this file is compiled without fused products (see CMakeLists.txt).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define HOWL_VECTOR_CLONES \
  __attribute__((target_clones("arch=skylake-avx512", "arch=haswell", "default")))
#else
#define HOWL_VECTOR_CLONES
#endif
#define HOWL_INLINE [[gnu::always_inline]] inline

namespace howl::internal {
namespace {

template <int W>
HOWL_INLINE void InterpolateLanes(const LaneBlock<W>& block, int count, double* __restrict v) {
  const double* __restrict x = block.window.data();
  const auto& w = block.delay_weights;
  for (int i = 0; i < count; ++i) {
    for (int l = 0; l < W; ++l) {
      const double* at = x + i * W + l;
      double sum = w[0][l] * at[0];
      sum += w[1][l] * at[W];
      sum += w[2][l] * at[2 * W];
      sum += w[3][l] * at[3 * W];
      sum += w[4][l] * at[4 * W];
      sum += w[5][l] * at[5 * W];
      v[i * W + l] = sum;
    }
  }
}

template <FlameShape kShape>
HOWL_INLINE double Sigma(double x) {
  if constexpr (kShape == FlameShape::kTanh) {
    return FastTanh(x);
  } else {
    return NormalisedFlame<kShape>(x);
  }
}

template <int W, FlameShape kShape>
HOWL_INLINE void ApplyShape(const LaneBlock<W>& block, int count, double* __restrict v) {
  const auto& gain = block.flame_gain;
  const auto& offset = block.flame_offset;
  const auto& saturation = block.saturation;
  for (int i = 0; i < count; ++i) {
    for (int l = 0; l < W; ++l) {
      double& value = v[i * W + l];
      value = saturation[l] * Sigma<kShape>(gain[l] * (value - offset[l]));
    }
  }
}

template <int W>
HOWL_INLINE void ApplyFlameLanes(const LaneBlock<W>& block, int count, double* v) {
  switch (block.shape) {
    case FlameShape::kTanh:
      return ApplyShape<W, FlameShape::kTanh>(block, count, v);
    case FlameShape::kArctan:
      return ApplyShape<W, FlameShape::kArctan>(block, count, v);
    case FlameShape::kCubic:
      return ApplyShape<W, FlameShape::kCubic>(block, count, v);
    case FlameShape::kPiecewiseLinear:
      return ApplyShape<W, FlameShape::kPiecewiseLinear>(block, count, v);
    case FlameShape::kAlgebraic:
      return ApplyShape<W, FlameShape::kAlgebraic>(block, count, v);
    case FlameShape::kLinear:
      return ApplyShape<W, FlameShape::kLinear>(block, count, v);
  }
}

template <int W>
HOWL_INLINE void Force(const std::array<std::array<double, W>, kOrder>& w, int count,
                       const double* __restrict q, double* __restrict out) {
  for (int i = 0; i < count; ++i) {
    for (int l = 0; l < W; ++l) {
      const double* at = q + i * W + l;
      double sum = w[0][l] * at[0];
      sum += w[1][l] * at[W];
      sum += w[2][l] * at[2 * W];
      sum += w[3][l] * at[3 * W];
      sum += w[4][l] * at[4 * W];
      sum += w[5][l] * at[5 * W];
      out[i * W + l] = sum;
    }
  }
}

template <int W>
HOWL_INLINE void PropagateLanes(LaneBlock<W>* block, int count, const double* __restrict heat,
                                double* __restrict pressure, double* __restrict rate) {
  const int modes = block->modes;
  for (int k = 0; k < modes; ++k) {
    double* __restrict path_y = block->path_y[k].data();
    double* __restrict path_p = block->path_p[k].data();
    Force<W>(block->weight_y[k], count, heat, path_y);
    Force<W>(block->weight_p[k], count, heat, path_p);
  }
  // Two modes at a time: each waits for its own last step alone.
  for (int k = 0; k < modes; k += 2) {
    const int pair = k + 1 < modes ? k + 1 : k;
    double* __restrict ya = block->path_y[k].data();
    double* __restrict pa = block->path_p[k].data();
    double* __restrict yb = block->path_y[pair].data();
    double* __restrict pb = block->path_p[pair].data();
    const auto ea = block->exponential[k];
    const auto eb = block->exponential[pair];
    auto sya = block->y[k];
    auto spa = block->p[k];
    auto syb = block->y[pair];
    auto spb = block->p[pair];
    if (pair != k) {
      for (int i = 0; i < count; ++i) {
        for (int l = 0; l < W; ++l) {
          const double y = (ya[i * W + l] + ea[0][l] * sya[l]) + ea[1][l] * spa[l];
          const double p = (pa[i * W + l] + ea[2][l] * sya[l]) + ea[3][l] * spa[l];
          sya[l] = y;
          spa[l] = p;
          ya[i * W + l] = y;
          pa[i * W + l] = p;
        }
        for (int l = 0; l < W; ++l) {
          const double y = (yb[i * W + l] + eb[0][l] * syb[l]) + eb[1][l] * spb[l];
          const double p = (pb[i * W + l] + eb[2][l] * syb[l]) + eb[3][l] * spb[l];
          syb[l] = y;
          spb[l] = p;
          yb[i * W + l] = y;
          pb[i * W + l] = p;
        }
      }
      block->y[pair] = syb;
      block->p[pair] = spb;
    } else {
      for (int i = 0; i < count; ++i) {
        for (int l = 0; l < W; ++l) {
          const double y = (ya[i * W + l] + ea[0][l] * sya[l]) + ea[1][l] * spa[l];
          const double p = (pa[i * W + l] + ea[2][l] * sya[l]) + ea[3][l] * spa[l];
          sya[l] = y;
          spa[l] = p;
          ya[i * W + l] = y;
          pa[i * W + l] = p;
        }
      }
    }
    block->y[k] = sya;
    block->p[k] = spa;
  }
  const double* __restrict q = heat + (kBehind + 1) * W;
  for (int i = 0; i < count; ++i) {
    for (int l = 0; l < W; ++l) {
      pressure[i * W + l] = block->path_p[0][i * W + l];
      rate[i * W + l] =
          (block->direct[l] * q[i * W + l] - block->omega[0][l] * block->path_y[0][i * W + l]) -
          block->damping[0][l] * block->path_p[0][i * W + l];
    }
  }
  for (int k = 1; k < modes; ++k) {
    const double* __restrict path_y = block->path_y[k].data();
    const double* __restrict path_p = block->path_p[k].data();
    for (int i = 0; i < count; ++i) {
      for (int l = 0; l < W; ++l) {
        pressure[i * W + l] += path_p[i * W + l];
        rate[i * W + l] = (rate[i * W + l] - block->omega[k][l] * path_y[i * W + l]) -
                          block->damping[k][l] * path_p[i * W + l];
      }
    }
  }
}

}  // namespace

DelaySteps SplitDelay(double tau_s, double step_s) {
  const double delay = tau_s / step_s;
  const double steps = std::ceil(delay);
  return {static_cast<int>(steps), LagrangeWeights<kOrder>(steps - delay)};
}

template <int W>
void LaneBlock<W>::Set(int lane, const LaneCoefficients& c) {
  const auto l = static_cast<std::size_t>(lane);
  for (std::size_t k = 0; k < kMaxModes; ++k) {
    const Matrix2& e = c.steps[k].exponential;
    exponential[k][0][l] = e.a;
    exponential[k][1][l] = e.b;
    exponential[k][2][l] = e.c;
    exponential[k][3][l] = e.d;
    for (std::size_t j = 0; j < kOrder; ++j) {
      weight_y[k][j][l] = c.steps[k].weight_y[j];
      weight_p[k][j][l] = c.steps[k].weight_p[j];
    }
    omega[k][l] = c.omega_rad_s[k];
    damping[k][l] = c.damping_rad_s[k];
  }
  for (std::size_t j = 0; j < kOrder; ++j) delay_weights[j][l] = c.delay_weights[j];
  direct[l] = c.direct;
  flame_gain[l] = c.flame_gain;
  flame_offset[l] = c.flame_offset;
  saturation[l] = c.saturation;
}

template struct LaneBlock<1>;
template struct LaneBlock<8>;

HOWL_VECTOR_CLONES void Interpolate(const LaneBlock<1>& block, int count, double* v) {
  InterpolateLanes<1>(block, count, v);
}
HOWL_VECTOR_CLONES void Interpolate(const LaneBlock<8>& block, int count, double* v) {
  InterpolateLanes<8>(block, count, v);
}
HOWL_VECTOR_CLONES void ApplyFlame(const LaneBlock<1>& block, int count, double* v) {
  ApplyFlameLanes<1>(block, count, v);
}
HOWL_VECTOR_CLONES void ApplyFlame(const LaneBlock<8>& block, int count, double* v) {
  ApplyFlameLanes<8>(block, count, v);
}
HOWL_VECTOR_CLONES void Propagate(LaneBlock<1>* block, int count, const double* heat,
                                  double* pressure, double* rate) {
  PropagateLanes<1>(block, count, heat, pressure, rate);
}
HOWL_VECTOR_CLONES void Propagate(LaneBlock<8>* block, int count, const double* heat,
                                  double* pressure, double* rate) {
  PropagateLanes<8>(block, count, heat, pressure, rate);
}

}  // namespace howl::internal
