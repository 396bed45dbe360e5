// An ellipsoid cut by slabs, bounded by Lagrange duality: for any multipliers l,
//
//   c.v <= D |F^-T (c - sum l_k a_k)| + sum of the largest l_k (a_k.v) over each slab,
//
// the ellipsoid being |F v| <= D. The multipliers come from a few sweeps of coordinate descent in
// doubles; whatever they are, the bound holds. The slabs are the cell's own intervals, M / N, and
// phase and gain of the response in the mean value form, with their derivatives over the cell. v
// holds the transfer's offsets.
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "estimation/family/bounds/contract/contract.h"
#include "model/loop/acoustics.h"

namespace howl {

namespace {

constexpr double kInflation = 1e-9;  // more than the rounding of what is not done in intervals
constexpr int kSweeps = 5;
constexpr int kPolishes = 5;
constexpr int kMostSlabs = 7;

struct Slab {
  TransferVector normal;
  double lo, hi;
  TransferVector scaled;  // F^-T normal
};

struct Slabs {
  std::array<Slab, kMostSlabs> items;
  int count = 0;

  void Add(const TransferVector& normal, const Interval& range, const TransferMatrix& inverse) {
    if (!std::isfinite(range.lower()) || !std::isfinite(range.upper()) || !normal.allFinite())
      return;
    items[static_cast<std::size_t>(count++)] = {normal, range.lower(), range.upper(),
                                                inverse.transpose() * normal};
  }
};

// The best multiplier of one slab, the others being held: r is what they leave of F^-T c.
double BestMultiplier(const TransferVector& r, const Slab& slab, double distance) {
  const double length = slab.scaled.norm();
  if (!(length > 0.0)) return 0.0;
  const double along = r.dot(slab.scaled) / length;
  const double across = std::sqrt(std::max(r.squaredNorm() - along * along, 0.0));
  const auto stationary = [&](double end) {
    const double k = std::clamp(-end / (length * distance), -0.999999, 0.999999);
    return (across * k / std::sqrt(1.0 - k * k) + along) / length;
  };
  const double up = stationary(slab.hi);
  if (up > 0.0) return up;
  const double down = stationary(slab.lo);
  return down < 0.0 ? down : 0.0;
}

using Multipliers = std::array<double, kMostSlabs>;

// The bound that the multipliers prove.
double BoundBy(const TransferVector& c, const Slabs& slabs, const Multipliers& multipliers,
               const TransferMatrix& inverse, double distance) {
  TransferVector left = c;
  double bound = 0.0;
  double size = 0.0;
  for (int k = 0; k < slabs.count; ++k) {
    const Slab& slab = slabs.items[static_cast<std::size_t>(k)];
    const double multiplier = multipliers[static_cast<std::size_t>(k)];
    if (multiplier == 0.0) continue;
    const double part = std::max(multiplier * slab.lo, multiplier * slab.hi);
    left -= multiplier * slab.normal;
    bound += part;
    size += std::abs(part);
  }
  const double reach = distance * (inverse.transpose() * left).norm();
  const double value = bound + reach + kInflation * (size + reach) + 1e-12;
  return std::isfinite(value) ? value : Unbounded();
}

// With the slabs that have a multiplier taken to touch at the end of its sign, the best multipliers
// in closed form: with G their columns F^-T a_k, m the ends and h = F^-T c,
//
//   l = (G^T G)^-1 (G^T h - g m),   g = |h - G (G^T G)^-1 G^T h| / sqrt(D^2 - m^T (G^T G)^-1 m).
//
// False when a sign comes out wrong: that slab has been dropped.
bool Polish(const TransferVector& h, const Slabs& slabs, double distance,
            Multipliers& multipliers) {
  std::array<int, kMostSlabs> active{};
  int n = 0;
  for (int k = 0; k < slabs.count; ++k) {
    if (multipliers[static_cast<std::size_t>(k)] != 0.0) active[static_cast<std::size_t>(n++)] = k;
  }
  if (n == 0 || n > kNumTransferParameters) return true;
  Eigen::Matrix<double, kNumTransferParameters, Eigen::Dynamic, 0, kNumTransferParameters,
                kNumTransferParameters>
      g(kNumTransferParameters, n);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kNumTransferParameters, 1> ends(n);
  for (int a = 0; a < n; ++a) {
    const auto k = static_cast<std::size_t>(active[static_cast<std::size_t>(a)]);
    g.col(a) = slabs.items[k].scaled;
    ends(a) = multipliers[k] > 0.0 ? slabs.items[k].hi : slabs.items[k].lo;
  }
  const auto normal = (g.transpose() * g).eval().ldlt();
  const auto fit = normal.solve(g.transpose() * h).eval();
  const auto turned = normal.solve(ends).eval();
  const double across = (h - g * fit).norm();
  const double room = distance * distance - ends.dot(turned);
  // Without room the slabs meet outside the ellipsoid: any large g proves it.
  const double weight = room > 0.0 ? across / std::sqrt(room) : 1e3 * (across + h.norm());
  bool kept = true;
  for (int a = 0; a < n; ++a) {
    double& multiplier = multipliers[static_cast<std::size_t>(active[static_cast<std::size_t>(a)])];
    const double better = fit(a) - weight * turned(a);
    const bool same = std::isfinite(better) && better * multiplier > 0.0;
    multiplier = same ? better : 0.0;
    kept &= same;
  }
  return kept;
}

// An upper bound of c.v.
double Largest(const TransferVector& c, const Slabs& slabs, const TransferMatrix& inverse,
               double distance) {
  Multipliers multipliers{};
  TransferVector rest = inverse.transpose() * c;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int k = 0; k < slabs.count; ++k) {
      const Slab& slab = slabs.items[static_cast<std::size_t>(k)];
      double& multiplier = multipliers[static_cast<std::size_t>(k)];
      rest += multiplier * slab.scaled;
      multiplier = BestMultiplier(rest, slab, distance);
      rest -= multiplier * slab.scaled;
    }
  }
  double bound = BoundBy(c, slabs, multipliers, inverse, distance);
  const TransferVector whole = inverse.transpose() * c;
  for (int polish = 0; polish < kPolishes; ++polish) {
    const bool kept = Polish(whole, slabs, distance, multipliers);
    bound = std::min(bound, BoundBy(c, slabs, multipliers, inverse, distance));
    if (kept) break;
  }
  return bound;
}

// ln z of z = N U_1 + M U_r at a point of the cell, its derivatives over the cell.
struct Response {
  Interval phase, ln_gain;                  // at the point
  std::array<Interval, 4> d_phase, d_gain;  // by the offsets of omega, xi, N and M
};

bool Linearise(const ContractTarget& target, const ExperimentBox& box,
               const std::array<double, 4>& at, bool second_mode, Response& response) {
  const TransferVector& centre = target.transfer.centre;
  const Interval rate = target.w_rad_s / target.frequency_hz;
  const Interval& w = target.w_rad_s;
  const auto mode = [&](const Interval& omega_hz, const Interval& xi, Complex<Interval>* by_omega,
                        Complex<Interval>* by_xi) {
    const Interval omega = rate * omega_hz;
    const Interval damping = 2.0 * omega * xi;
    const Interval stiffness = square(omega) / w;
    const Complex<Interval> d{damping, w - stiffness};
    const Interval size = square(d.re) + square(d.im);
    Complex<Interval> u{d.re / size, -d.im / size};
    const Complex<Interval> minus_square{square(u.im) - square(u.re), -2.0 * u.re * u.im};
    *by_omega = minus_square * Complex<Interval>{damping, -2.0 * stiffness};
    *by_xi = damping * minus_square;
    return u;
  };
  const Interval& ratio = target.harmonic_ratio;
  Complex<Interval> w_1, x_1, w_r, x_r;
  // At the point.
  {
    const Complex<Interval> first = mode(Interval(at[0]), Interval(at[1]), &w_1, &x_1);
    Complex<Interval> z = Interval(at[2]) * first;
    if (second_mode) {
      z = z + Interval(at[3]) * mode(ratio * Interval(at[0]), Interval(at[1]), &w_r, &x_r);
    }
    if (!(z.re.lower() > 0.0)) return false;
    response.phase = Arctangent(z.im / z.re);
    response.ln_gain = 0.5 * Logarithm(square(z.re) + square(z.im));
  }
  const Complex<Interval> first = mode(box[kCellOmega], box[kCellXi], &w_1, &x_1);
  Complex<Interval> direction = first;
  Complex<Interval> by_omega = w_1, by_xi = x_1;
  Complex<Interval> second{Interval(0.0), Interval(0.0)};
  if (second_mode) {
    const Interval& m = box[kCellRelative];
    if (!std::isfinite(m.upper())) return false;
    second = mode(ratio * box[kCellOmega], box[kCellXi], &w_r, &x_r);
    direction = direction + m * second;
    by_omega = by_omega + m * w_r;
    by_xi = by_xi + m * x_r;
  }
  const Interval size = square(direction.re) + square(direction.im);
  if (!(size.lower() > 0.0) || !std::isfinite(size.upper())) return false;
  const auto over = [&](const Complex<Interval>& n) {
    return Complex<Interval>{(n.re * direction.re + n.im * direction.im) / size,
                             (n.im * direction.re - n.re * direction.im) / size};
  };
  const Complex<Interval> a = over(by_omega), b = over(by_xi);
  // d ln z / d (N / N_0) = N_0 U_1 / z and d ln z / d (M / M_0) = M_0 U_r / z, with z = N
  // direction.
  const Interval inverse_N = 1.0 / box[kCellN];
  const Complex<Interval> by_N = (Interval(centre(2)) * inverse_N) * over(first);
  const Complex<Interval> by_M = (Interval(centre(3)) * inverse_N) * over(second);
  response.d_gain = {a.re, b.re, by_N.re, by_M.re};
  response.d_phase = {a.im, b.im, by_N.im, by_M.im};
  return true;
}

}  // namespace

bool ContractSlabs(const ContractTarget& target, ExperimentBox& box) {
  const TransferBound& bound = target.transfer;
  if (!bound.used || bound.whole == 0) return true;
  const bool second_mode = bound.whole == 4;
  constexpr std::array<CellVariable, 4> kVariables = {kCellOmega, kCellXi, kCellN, kCellM};
  const auto n = static_cast<std::size_t>(bound.whole);
  std::array<Interval, 4> v;
  std::array<double, 4> at{};
  Slabs slabs;
  for (std::size_t k = 0; k < n; ++k) {
    const Interval& x = box[kVariables[k]];
    if (!(x.lower() > 0.0) || !std::isfinite(x.upper())) return true;
    const auto ik = static_cast<Eigen::Index>(k);
    v[k] = OffsetOf(bound, static_cast<int>(k), x);
    at[k] = 0.5 * (x.lower() + x.upper());
    slabs.Add(TransferVector::Unit(ik), v[k], bound.inverse);
  }
  // M / N = rho M_0 / N_0 with 1 + m = rho (1 + n), so that m - rho_0 n = rho - 1 + (rho - rho_0)
  // n.
  TransferVector relative = TransferVector::Zero();
  const Interval relative_scale = Interval(bound.centre(3)) / Interval(bound.centre(2));
  Interval relative_middle(0.0);
  if (second_mode) {
    const Interval share = box[kCellRelative] / relative_scale;
    if (!std::isfinite(share.upper())) return true;
    relative_middle = Interval(0.5 * (share.lower() + share.upper()));
    relative(2) = -relative_middle.lower();
    relative(3) = 1.0;
    slabs.Add(relative, share - 1.0 + (share - relative_middle) * v[2], bound.inverse);
  }
  Response response;
  if (Linearise(target, box, at, second_mode, response)) {
    const auto add = [&](const std::array<Interval, 4>& slope, const Interval& value,
                         const Interval& allowed) {
      TransferVector normal = TransferVector::Zero();
      Interval range = allowed - value;
      for (std::size_t k = 0; k < n; ++k) {
        const auto ik = static_cast<Eigen::Index>(k);
        const double middle = 0.5 * (slope[k].lower() + slope[k].upper());
        const Interval point = OffsetOf(bound, static_cast<int>(k), Interval(at[k]));
        normal(ik) = middle;
        range += Interval(middle) * point - (slope[k] - Interval(middle)) * (v[k] - point);
      }
      slabs.Add(normal, range, bound.inverse);
    };
    add(response.d_phase, response.phase, -Arctangent(box[kCellTangent]));
    add(response.d_gain, response.ln_gain, Logarithm(box[kCellGain]));
  }
  const auto range = [&](const TransferVector& c, Interval& offset) {
    const double hi = Largest(c, slabs, bound.inverse, bound.distance);
    const double lo = -Largest(-c, slabs, bound.inverse, bound.distance);
    if (!(lo <= hi)) return false;
    offset = Interval(lo, hi);
    return true;
  };
  for (std::size_t k = 0; k < n; ++k) {
    Interval offset;
    if (!range(TransferVector::Unit(static_cast<Eigen::Index>(k)), offset)) return false;
    if (!Narrow(box[kVariables[k]], ValueOf(bound, static_cast<int>(k), offset))) return false;
  }
  if (!second_mode) return true;
  // rho = rho_0 + (1 + (m - rho_0 n) - rho_0) / (1 + n)
  Interval difference;
  if (!range(relative, difference)) return false;
  const Interval N_share = box[kCellN] / Interval(bound.centre(2));
  return Narrow(
      box[kCellRelative],
      (relative_middle + (1.0 + difference - relative_middle) / N_share) * relative_scale);
}

}  // namespace howl
