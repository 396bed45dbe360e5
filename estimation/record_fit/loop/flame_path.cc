#include "estimation/record_fit/loop/flame_path.h"

#include <cmath>

#include "model/numerics/complex_products.h"
#include "model/numerics/log_of_one_and.h"

namespace howl {
namespace {

using C = std::complex<double>;

// sqrt(1 + 2 w)
C RootOf(C w) { return std::sqrt(1.0 + 2.0 * w); }

C Exponential(C x) { return std::polar(std::exp(x.real()), x.imag()); }

}  // namespace

PathTurns FlamePath::TurnsAt(C s) const {
  PathTurns out;
  if (spread == DelaySpread::kNone) out.of_first = Exponential(-tau * s);
  if (second) out.of_second = Exponential(-second->lambda * s);
  return out;
}

PathSlopes FlamePath::FirstWithSlopes(C s, C turn) const {
  const C delayed = tau * s;
  const double square = rho * rho;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal: {
      const C root = RootOf(square * delayed);
      const C half = Times(delayed, Reciprocal(1.0 + root));
      const C late = Times(delayed, Reciprocal(root));
      return {Exponential(-2.0 * half),
              {-late, 4.0 * square * Times(Times(late, half), Reciprocal(1.0 + root))}};
    }
    case DelaySpread::kGamma: {
      const C mean = LogOfOneAnd(square * delayed) / square;
      const C late = Times(delayed, Reciprocal(1.0 + square * delayed));
      return {Exponential(-mean), {-late, 2.0 * (mean - late)}};
    }
  }
  return {turn, {-delayed}};
}

PathSlopes FlamePath::OfManyDelays(C s, const PathTurns& turns) const {
  PathSlopes out = FirstWithSlopes(s, turns.of_first);
  if (!second) return out;
  const C later = turns.of_second;
  const C both = 1.0 + second->share * (later - 1.0);
  const C over = Reciprocal(both);
  out.at = Times(out.at, both);
  out.by[Second()] = Times(later - 1.0, over);
  out.by[Second() + 1] = -second->share * second->lambda * Times(Times(s, later), over);
  return out;
}

C FlamePath::At(C s) const { return WithSlopes(s).at; }

Eigen::VectorXcd FlamePath::At(const Eigen::VectorXcd& s) const {
  return s.unaryExpr([this](C each) { return At(each); });
}

FlamePath::First FlamePath::FirstFall(C s) const {
  const double square = rho * rho;
  const C wide = square * tau * s;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal: {
      const C root = RootOf(wide);
      const C at = Reciprocal(root + square);
      return {tau * at, tau * Times(at, 1.0 - Times(wide, Times(at, Reciprocal(root)))),
              -2.0 * tau * (wide / root + square) / std::pow(root + square, 2)};
    }
    case DelaySpread::kGamma: {
      const C over = Reciprocal(1.0 + wide);
      return {tau * (1.0 - square) * over, tau * (1.0 - square) * Times(over, over),
              -2.0 * tau * (square + wide) * Times(over, over)};
    }
  }
  return {tau, tau, 0.0};
}

PathFall FlamePath::Fall(C s) const {
  const First first = FirstFall(s);
  PathFall out{first.fall, {first.by_log_tau}};
  if (spread != DelaySpread::kNone) out.by[1] = first.by_log_rho;
  if (!second) return out;
  const double share = second->share;
  const double lambda = second->lambda;
  const C later = Exponential(-lambda * s);
  const C both = 1.0 + share * (later - 1.0);
  const C of_first = Reciprocal(first.fall);
  const C of_second = Reciprocal(first.fall + lambda);
  const C over = Reciprocal((1.0 - share) * of_first + share * Times(later, of_second));
  out.at = Times(both, over);
  // The slope of both / under is (slope of both - at times slope of under) / under.
  const C under_by_first = -(1.0 - share) * Times(of_first, of_first) -
                           share * Times(later, Times(of_second, of_second));
  for (std::size_t i = 0; i < Second(); ++i) {
    out.by[i] = -Times(Times(out.at, over), Times(under_by_first, out.by[i]));
  }
  const auto slope = [&](C of_both, C of_under) {
    return Times(over, of_both - Times(out.at, of_under));
  };
  out.by[Second()] = slope(later - 1.0, Times(later, of_second) - of_first);
  const C turned = lambda * Times(s, later);
  out.by[Second() + 1] = slope(
      -share * turned,
      -share * (Times(turned, of_second) + lambda * Times(later, Times(of_second, of_second))));
  return out;
}

}  // namespace howl
