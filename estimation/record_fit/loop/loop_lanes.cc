#include "estimation/record_fit/loop/loop_lanes.h"

#include "model/numerics/complex_lanes.h"

namespace howl {
namespace {

using C = std::complex<double>;

HOWL_IN_CLONES double SumOf(const double& lane) { return lane; }

HOWL_IN_CLONES double SumOf(const EightLanes& lanes) {
  double sum = lanes[0];
  for (int k = 1; k < kLanes; ++k) sum += lanes[k];
  return sum;
}

template <typename V>
HOWL_IN_CLONES void ResonanceAt(const LoopMode& mode, const double* x, C* out) {
  const V at = Lanes<V>::Load(x);
  Store(Reciprocal(
            ComplexLanes<V>{mode.omega * mode.omega - at * at, 2.0 * mode.xi * mode.omega * at}),
        out);
}

// rate s + level omega
template <typename V>
HOWL_IN_CLONES ComplexLanes<V> Line(double rate, double level_omega, const V& x) {
  return {level_omega + 0.0 * x, rate * x};
}

template <typename V>
HOWL_IN_CLONES void TransferAt(const LoopMode& mode, const double* x, const C* over, C* out) {
  const ComplexLanes<V> part =
      Line<V>(mode.a, mode.b * mode.omega, Lanes<V>::Load(x)) * ComplexLanes<V>::Load(over);
  Store(ComplexLanes<V>::Load(out) + part, out);
}

template <typename V>
HOWL_IN_CLONES void AnswerAt(const LoopMode& mode, const double* x, const C* q, const C* over,
                             C* out) {
  const V at = Lanes<V>::Load(x);
  const ComplexLanes<V> driven =
      Line<V>(mode.a, mode.b * mode.omega, at) * ComplexLanes<V>::Load(q) +
      Line<V>(mode.g, mode.h * mode.omega, at);
  Store(ComplexLanes<V>::Load(out) + driven * ComplexLanes<V>::Load(over), out);
}

template <typename V>
HOWL_IN_CLONES ComplexLanes<V> Less(const C* signal, const C* answer, const C* factors) {
  const auto answers = ComplexLanes<V>::Load(answer);
  return ComplexLanes<V>::Load(signal) -
         (factors == nullptr ? answers : answers * ComplexLanes<V>::Load(factors));
}

template <typename V>
HOWL_IN_CLONES void LeftAt(const C* signal, const C* answer, const C* factors, C* out) {
  const C* const next = factors == nullptr ? nullptr : factors + 1;
  Store(Less<V>(signal, answer, factors) - Less<V>(signal + 1, answer + 1, next), out);
}

template <typename V>
struct SumsInLanes {
  V o = {};
  V s_o = {};
  V oo = {};
  V s_oo = {};
  V ss_oo = {};

  HOWL_IN_CLONES void Add(const C* weights, const double* x, const C* over) {
    const V at = Lanes<V>::Load(x);
    const auto resonance = ComplexLanes<V>::Load(over);
    const ComplexLanes<V> once = ComplexLanes<V>::Load(weights) * resonance;
    const ComplexLanes<V> twice = once * resonance;
    o += once.re;
    s_o -= at * once.im;
    oo += twice.re;
    s_oo -= at * twice.im;
    ss_oo -= at * at * twice.re;
  }
  HOWL_IN_CLONES void AddTo(ModeSums* out) const {
    out->o += SumOf(o);
    out->s_o += SumOf(s_o);
    out->oo += SumOf(oo);
    out->s_oo += SumOf(s_oo);
    out->ss_oo += SumOf(ss_oo);
  }
};

template <typename V>
HOWL_IN_CLONES V RealOfProduct(const C* a, const C* b, const C* c) {
  return (ComplexLanes<V>::Load(a) * ComplexLanes<V>::Load(b) * ComplexLanes<V>::Load(c)).re;
}

}  // namespace

HOWL_VECTOR_CLONES
void SetResonance(const LoopMode& mode, const double* x, std::ptrdiff_t count, C* out) {
  std::ptrdiff_t i = 0;
  for (; i + kLanes <= count; i += kLanes) ResonanceAt<EightLanes>(mode, x + i, out + i);
  for (; i < count; ++i) ResonanceAt<double>(mode, x + i, out + i);
}

HOWL_VECTOR_CLONES
void AddTransfer(const LoopMode& mode, const double* x, const C* over, std::ptrdiff_t count,
                 C* out) {
  std::ptrdiff_t i = 0;
  for (; i + kLanes <= count; i += kLanes) TransferAt<EightLanes>(mode, x + i, over + i, out + i);
  for (; i < count; ++i) TransferAt<double>(mode, x + i, over + i, out + i);
}

HOWL_VECTOR_CLONES
void AddAnswer(const LoopMode& mode, const double* x, const C* q, const C* over,
               std::ptrdiff_t count, C* out) {
  std::ptrdiff_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    AnswerAt<EightLanes>(mode, x + i, q + i, over + i, out + i);
  }
  for (; i < count; ++i) AnswerAt<double>(mode, x + i, q + i, over + i, out + i);
}

HOWL_VECTOR_CLONES
void SetLeft(const C* signal, const C* answer, const C* factors, std::ptrdiff_t count, C* out) {
  const auto factors_at = [factors](std::ptrdiff_t i) {
    return factors == nullptr ? nullptr : factors + i;
  };
  std::ptrdiff_t i = 0;
  for (; i + kLanes < count; i += kLanes) {
    LeftAt<EightLanes>(signal + i, answer + i, factors_at(i), out + i);
  }
  for (; i + 1 < count; ++i) LeftAt<double>(signal + i, answer + i, factors_at(i), out + i);
}

HOWL_VECTOR_CLONES
void SetProducts(const C* a, const C* b, std::ptrdiff_t count, C* out) {
  std::ptrdiff_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    Store(ComplexLanes<EightLanes>::Load(a + i) * ComplexLanes<EightLanes>::Load(b + i), out + i);
  }
  for (; i < count; ++i) {
    Store(ComplexLanes<double>::Load(a + i) * ComplexLanes<double>::Load(b + i), out + i);
  }
}

HOWL_VECTOR_CLONES
double SumOfProducts(const C* a, const C* b, const C* c, std::ptrdiff_t count) {
  EightLanes lanes = {};
  std::ptrdiff_t i = 0;
  for (; i + kLanes <= count; i += kLanes) lanes += RealOfProduct<EightLanes>(a + i, b + i, c + i);
  double sum = SumOf(lanes);
  for (; i < count; ++i) sum += RealOfProduct<double>(a + i, b + i, c + i);
  return sum;
}

HOWL_VECTOR_CLONES
ModeSums SumsOfMode(const C* weights, const double* x, const C* over, std::ptrdiff_t count) {
  SumsInLanes<EightLanes> lanes;
  SumsInLanes<double> rest;
  std::ptrdiff_t i = 0;
  for (; i + kLanes <= count; i += kLanes) lanes.Add(weights + i, x + i, over + i);
  for (; i < count; ++i) rest.Add(weights + i, x + i, over + i);
  ModeSums out;
  lanes.AddTo(&out);
  rest.AddTo(&out);
  return out;
}

}  // namespace howl
