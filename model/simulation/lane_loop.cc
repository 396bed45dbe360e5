#include "model/simulation/lane_loop.h"

#include <cmath>

#include "model/numerics/fast_tanh.h"
#include "model/numerics/vector_clones.h"

namespace howl::internal {
namespace {

// A row of W lanes as one value. Vectors of the compiler's kind: each operation acts on each lane
// by itself, on any machine.
template <int W>
struct Row;
template <>
struct Row<1> {
  using Type = double;
};
template <>
struct Row<8> {
  typedef double Type __attribute__((vector_size(64), aligned(8), may_alias));
};
template <int W>
using RowOf = typename Row<W>::Type;

template <int W>
HOWL_IN_CLONES const RowOf<W>* Rows(const double* p) {
  return reinterpret_cast<const RowOf<W>*>(p);
}
template <int W>
HOWL_IN_CLONES RowOf<W>* Rows(double* p) {
  return reinterpret_cast<RowOf<W>*>(p);
}

// out_i = sum_j w_j x_(i + j)
template <int W>
HOWL_IN_CLONES void SlidingSum(
    const std::array<std::array<double, static_cast<std::size_t>(W)>, kOrder>& weights, int count,
    const double* x, double* out) {
  using V = RowOf<W>;
  const V* __restrict from = Rows<W>(x);
  V* __restrict to = Rows<W>(out);
  const V* w = Rows<W>(weights[0].data());
  const V w0 = w[0];
  const V w1 = w[1];
  const V w2 = w[2];
  const V w3 = w[3];
  const V w4 = w[4];
  const V w5 = w[5];
  for (int i = 0; i < count; ++i) {
    V sum = w0 * from[i];
    sum += w1 * from[i + 1];
    sum += w2 * from[i + 2];
    sum += w3 * from[i + 3];
    sum += w4 * from[i + 4];
    sum += w5 * from[i + 5];
    to[i] = sum;
  }
}

template <FlameShape kShape>
HOWL_IN_CLONES double Sigma(double x) {
  if constexpr (kShape == FlameShape::kTanh) {
    return FastTanh(x);
  } else {
    return NormalisedFlame<kShape>(x);
  }
}

template <int W, FlameShape kShape>
HOWL_IN_CLONES void ApplyShape(const LaneBlock<W>& block, int count, double* __restrict v) {
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
HOWL_IN_CLONES void ApplyFlameLanes(const LaneBlock<W>& block, int count, double* v) {
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
    case FlameShape::kSquareRoot:
      return ApplyShape<W, FlameShape::kSquareRoot>(block, count, v);
    case FlameShape::kLinear:
      return ApplyShape<W, FlameShape::kLinear>(block, count, v);
  }
}

template <int W>
HOWL_IN_CLONES void PropagateLanes(LaneBlock<W>* block, int count, const double* heat,
                                   double* pressure, double* rate) {
  using V = RowOf<W>;
  const int modes = block->modes;
  for (int k = 0; k < modes; ++k) {
    SlidingSum<W>(block->weight_y[k], count, heat, block->path_y[k].data());
    SlidingSum<W>(block->weight_p[k], count, heat, block->path_p[k].data());
  }
  // Two modes at a time, so that neither waits idly for its own last step.
  for (int k = 0; k < modes; k += 2) {
    const int other = k + 1 < modes ? k + 1 : k;
    V* __restrict ya = Rows<W>(block->path_y[k].data());
    V* __restrict pa = Rows<W>(block->path_p[k].data());
    const V* ea = Rows<W>(block->exponential[k][0].data());
    const V a0 = ea[0];
    const V a1 = ea[1];
    const V a2 = ea[2];
    const V a3 = ea[3];
    V y = *Rows<W>(block->y[k].data());
    V p = *Rows<W>(block->p[k].data());
    if (other == k) {
      for (int i = 0; i < count; ++i) {
        const V next = (ya[i] + a0 * y) + a1 * p;
        p = (pa[i] + a2 * y) + a3 * p;
        y = next;
        ya[i] = y;
        pa[i] = p;
      }
    } else {
      V* __restrict yb = Rows<W>(block->path_y[other].data());
      V* __restrict pb = Rows<W>(block->path_p[other].data());
      const V* eb = Rows<W>(block->exponential[other][0].data());
      const V b0 = eb[0];
      const V b1 = eb[1];
      const V b2 = eb[2];
      const V b3 = eb[3];
      V z = *Rows<W>(block->y[other].data());
      V r = *Rows<W>(block->p[other].data());
      for (int i = 0; i < count; ++i) {
        const V next_a = (ya[i] + a0 * y) + a1 * p;
        const V next_b = (yb[i] + b0 * z) + b1 * r;
        p = (pa[i] + a2 * y) + a3 * p;
        r = (pb[i] + b2 * z) + b3 * r;
        y = next_a;
        z = next_b;
        ya[i] = y;
        pa[i] = p;
        yb[i] = z;
        pb[i] = r;
      }
      *Rows<W>(block->y[other].data()) = z;
      *Rows<W>(block->p[other].data()) = r;
    }
    *Rows<W>(block->y[k].data()) = y;
    *Rows<W>(block->p[k].data()) = p;
  }
  const V* __restrict q = Rows<W>(heat) + kBehind + 1;
  V* __restrict out_p = Rows<W>(pressure);
  V* __restrict out_rate = Rows<W>(rate);
  const V direct = *Rows<W>(block->direct.data());
  for (int k = 0; k < modes; ++k) {
    const V* __restrict path_y = Rows<W>(block->path_y[k].data());
    const V* __restrict path_p = Rows<W>(block->path_p[k].data());
    const V omega = *Rows<W>(block->omega[k].data());
    const V damping = *Rows<W>(block->damping[k].data());
    if (k == 0) {
      for (int i = 0; i < count; ++i) {
        out_p[i] = path_p[i];
        out_rate[i] = (direct * q[i] - omega * path_y[i]) - damping * path_p[i];
      }
    } else {
      for (int i = 0; i < count; ++i) {
        out_p[i] += path_p[i];
        out_rate[i] = (out_rate[i] - omega * path_y[i]) - damping * path_p[i];
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
  SlidingSum<1>(block.delay_weights, count, block.window.data(), v);
}
HOWL_VECTOR_CLONES void Interpolate(const LaneBlock<8>& block, int count, double* v) {
  SlidingSum<8>(block.delay_weights, count, block.window.data(), v);
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

HOWL_VECTOR_CLONES double DotProduct(const double* a, const double* b, std::size_t n) {
  // Eight partial sums, in an order of their own: a single one waits for each addition.
  double sums[8] = {};
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    for (std::size_t k = 0; k < 8; ++k) sums[k] += a[i + k] * b[i + k];
  }
  for (; i < n; ++i) sums[0] += a[i] * b[i];
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

}  // namespace howl::internal
