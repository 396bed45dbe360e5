// The flame's static characteristic (the paper, section 3.2): heat release against the delayed rate
// of change of pressure,
//
//   Phi(v) = Q sigma(k (v - v0) / Q),     sigma(0) = 0, sigma'(0) = 1, |sigma| <= 1
//
// King's law of a hot wire in a stream that may turn round (L. V. King, Phil. Trans. R. Soc. A
// 214:373, 1914; with |u| by M. A. Heckl, Acustica 72:63, 1990) is not bounded but grows as the
// root: sigma = 2 (sqrt|1 + x| - 1), least at x = -1 where the stream stands still. There its slope
// has no bound. K (sqrt|1/3 + u| - sqrt(1/3)) is this with k = K sqrt(3) / 2 and Q = k / 3.
//
// slope k < 0 in (units of q) / (units of p / s): with no offset Phi'(0) = k; saturation Q > 0 in
// units of q; offset v0 in (units of p) / s. A constant in q does not reach p, since G(0) = 0.
//
// Describing function, gain of the fundamental at amplitude A of v (Gelb & Van der Velde 1968):
//
//   D(A) = 1 / (pi A) * integral from 0 to 2 pi of Phi(A sin t) sin t dt,   D(0) = Phi'(0)
//
// Values and slopes are templates on the scalar.
#ifndef HOWL_MODEL_LOOP_FLAME_H_
#define HOWL_MODEL_LOOP_FLAME_H_

#include <cmath>
#include <cstdint>
#include <numbers>

namespace howl {

enum class FlameShape : std::uint8_t {
  kTanh,
  kArctan,           // (2 / pi) arctan(pi x / 2)
  kCubic,            // x - 4 x^3 / 27 up to |x| = 3/2, then constant: smooth slope
  kPiecewiseLinear,  // clipped at +-1
  kAlgebraic,        // x / sqrt(1 + x^2)
  kSquareRoot,       // 2 (sqrt|1 + x| - 1), King's law: neither odd nor bounded
  kLinear            // does not saturate: for linear studies
};

template <FlameShape kShape, typename T>
T NormalisedFlame(const T& x) {
  using std::atan;
  using std::sqrt;
  using std::tanh;
  if constexpr (kShape == FlameShape::kTanh) {
    return tanh(x);
  } else if constexpr (kShape == FlameShape::kArctan) {
    return T(2.0 / std::numbers::pi) * atan(T(std::numbers::pi / 2.0) * x);
  } else if constexpr (kShape == FlameShape::kCubic) {
    const T inside = x > T(1.5) ? T(1.5) : (x < T(-1.5) ? T(-1.5) : x);
    return inside - T(4.0 / 27.0) * inside * inside * inside;
  } else if constexpr (kShape == FlameShape::kPiecewiseLinear) {
    return x > T(1.0) ? T(1.0) : (x < T(-1.0) ? T(-1.0) : x);
  } else if constexpr (kShape == FlameShape::kAlgebraic) {
    return x / sqrt(T(1.0) + x * x);
  } else if constexpr (kShape == FlameShape::kSquareRoot) {
    using std::abs;
    return T(2.0) * (sqrt(abs(T(1.0) + x)) - T(1.0));
  } else {
    return x;
  }
}

template <FlameShape kShape, typename T>
T NormalisedFlameSlope(const T& x) {
  using std::sqrt;
  using std::tanh;
  if constexpr (kShape == FlameShape::kTanh) {
    const T value = tanh(x);
    return T(1.0) - value * value;
  } else if constexpr (kShape == FlameShape::kArctan) {
    const T scaled = T(std::numbers::pi / 2.0) * x;
    return T(1.0) / (T(1.0) + scaled * scaled);
  } else if constexpr (kShape == FlameShape::kCubic) {
    return x > T(1.5) || x < T(-1.5) ? T(0.0) : T(1.0) - T(4.0 / 9.0) * x * x;
  } else if constexpr (kShape == FlameShape::kPiecewiseLinear) {
    return x > T(1.0) || x < T(-1.0) ? T(0.0) : T(1.0);
  } else if constexpr (kShape == FlameShape::kAlgebraic) {
    const T square = T(1.0) + x * x;
    return T(1.0) / (square * sqrt(square));
  } else if constexpr (kShape == FlameShape::kSquareRoot) {
    const T stream = T(1.0) + x;
    const T size = stream < T(0.0) ? -stream : stream;
    // Bounded, so that a sum over a cycle that passes through the cusp stays finite.
    const T slope = T(1.0) / sqrt(size > T(1e-12) ? size : T(1e-12));
    return stream < T(0.0) ? -slope : slope;
  } else {
    return T(1.0);
  }
}

template <typename T>
struct Flame {
  FlameShape shape = FlameShape::kTanh;
  T slope{};
  T saturation = T(1.0);
  T offset{};
};

// Calls f.template operator()<shape>() for the shape that is known at run time.
template <typename F>
decltype(auto) VisitFlameShape(FlameShape shape, F&& f) {
  switch (shape) {
    case FlameShape::kTanh:
      return f.template operator()<FlameShape::kTanh>();
    case FlameShape::kArctan:
      return f.template operator()<FlameShape::kArctan>();
    case FlameShape::kCubic:
      return f.template operator()<FlameShape::kCubic>();
    case FlameShape::kPiecewiseLinear:
      return f.template operator()<FlameShape::kPiecewiseLinear>();
    case FlameShape::kAlgebraic:
      return f.template operator()<FlameShape::kAlgebraic>();
    case FlameShape::kSquareRoot:
      return f.template operator()<FlameShape::kSquareRoot>();
    case FlameShape::kLinear:
      break;
  }
  return f.template operator()<FlameShape::kLinear>();
}

// Phi(v)
template <typename T>
T FlameResponse(const Flame<T>& flame, const T& v) {
  const T x = flame.slope * (v - flame.offset) / flame.saturation;
  return flame.saturation *
         VisitFlameShape(flame.shape, [&]<FlameShape s>() { return NormalisedFlame<s>(x); });
}

// Phi'(v); at v = 0 the slope that conditions (1b) and the linearised loop use.
template <typename T>
T FlameSlope(const Flame<T>& flame, const T& v) {
  const T x = flame.slope * (v - flame.offset) / flame.saturation;
  return flame.slope *
         VisitFlameShape(flame.shape, [&]<FlameShape s>() { return NormalisedFlameSlope<s>(x); });
}

// D(A) by the trapezoidal rule over one period, which converges geometrically for smooth shapes
// and as 1 / samples^2 for kinks. Real also with an offset, the characteristic having no memory.
template <typename T>
T DescribingFunction(const Flame<T>& flame, const T& amplitude, int samples = 512) {
  if (amplitude == T(0.0)) return FlameSlope(flame, T(0.0));
  T sum(0.0);
  for (int i = 0; i < samples; ++i) {
    const double sine = std::sin(2.0 * std::numbers::pi * (i + 0.5) / samples);
    sum += FlameResponse(flame, T(amplitude * sine)) * sine;
  }
  return T(2.0) * sum / (T(static_cast<double>(samples)) * amplitude);
}

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_FLAME_H_
