#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "estimation/family/bounds/contract/contract.h"
#include "estimation/family/problem/transfer_limit.h"

namespace howl {

namespace {

// The test evaluates the quadratic form in doubles.
constexpr double kSlack = 1e-9;

// |F v|^2 <= D^2, row by row.
bool ContractForm(const TransferMatrix& factor, double distance, std::array<Interval, 4>& v) {
  std::array<Interval, 4> rows;
  std::array<Interval, 4> squares;
  const Interval limit = square(Interval(distance));
  for (int r = 0; r < 4; ++r) {
    Interval& row = rows[static_cast<std::size_t>(r)] = Interval(0.0);
    for (int c = 0; c < 4; ++c) {
      if (factor(r, c) != 0.0) row += Interval(factor(r, c)) * v[static_cast<std::size_t>(c)];
    }
    squares[static_cast<std::size_t>(r)] = square(row);
  }
  for (int r = 0; r < 4; ++r) {
    Interval left = limit;
    for (int other = 0; other < 4; ++other) {
      if (other != r) left -= Interval(squares[static_cast<std::size_t>(other)].lower());
    }
    if (!(left.upper() >= 0.0)) return false;
    const double reach = sqrt(Interval(left.upper())).upper();
    Interval& row = rows[static_cast<std::size_t>(r)];
    if (!Narrow(row, Interval(-reach, reach))) return false;
    for (int c = 0; c < 4; ++c) {
      if (factor(r, c) == 0.0) continue;
      Interval rest = row;
      for (int other = 0; other < 4; ++other) {
        if (other == c || factor(r, other) == 0.0) continue;
        rest -= Interval(factor(r, other)) * v[static_cast<std::size_t>(other)];
      }
      if (!Narrow(v[static_cast<std::size_t>(c)], rest / Interval(factor(r, c)))) return false;
    }
  }
  return true;
}

// The range of (1 + m) / (1 + n) over the ellipse |(n, m)| <= distance of this covariance. A ratio
// r is reached where the line m + 1 = r (n + 1) meets the ellipse,
//
//   (1 - r)^2 <= distance^2 (C_mm - 2 r C_nm + r^2 C_nn),
//
// a quadratic in r (E. C. Fieller, Suppl. J. R. Stat. Soc. 7 (1940) 1), which bounds it above where
// n + 1 stays positive.
Interval RatioRange(double c_nn, double c_mm, double c_nm, double distance) {
  constexpr double kNearlyUnbounded = 1e-6;  // below, rounding would count
  const double square = distance * distance;
  const double a = 1.0 - square * c_nn;
  if (!(a > kNearlyUnbounded)) return Interval(0.0, kUnbounded);
  const double b = 1.0 - square * c_nm;
  const double c = 1.0 - square * c_mm;
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  return Interval(std::max(0.0, (b - root) / a * (1.0 - kSlack) - kSlack),
                  (b + root) / a * (1.0 + kSlack) + kSlack);
}

}  // namespace

Interval OffsetOf(const TransferBound& bound, int k, const Interval& value) {
  const Interval share = value / Interval(bound.centre(k));
  return IsLogOffset(k) ? Logarithm(share) : share - Interval(1.0);
}

Interval ValueOf(const TransferBound& bound, int k, const Interval& offset) {
  const Interval share = IsLogOffset(k) ? Exponential(offset) : offset + Interval(1.0);
  return share * Interval(bound.centre(k));
}

TransferBound MakeTransferBound(const TransferEllipsoid& ellipsoid, bool second_mode,
                                double deviation_max) {
  const double distance = TransferLimit(ellipsoid, second_mode, deviation_max);
  TransferBound bound;
  bound.used = true;
  bound.distance = distance * (1.0 + kSlack) + kSlack;
  bound.centre = ellipsoid.Centre();
  bound.factor = ellipsoid.Factor(second_mode);
  // The same form, factored from the other end: what the one leaves wide the other narrows.
  std::vector<int> kept;
  for (int k = 0; k < 4; ++k) {
    if (bound.factor(k, k) != 0.0) kept.push_back(k);
  }
  const std::vector<int> backwards(kept.rbegin(), kept.rend());
  const TransferMatrix precision = bound.factor.transpose() * bound.factor;
  const Eigen::MatrixXd form = precision(backwards, backwards);
  const Eigen::LLT<Eigen::MatrixXd> factored(form);
  if (factored.info() == Eigen::Success) {
    const Eigen::MatrixXd upper = factored.matrixU();
    bound.backward(backwards, backwards) = upper;
  }
  const int all = second_mode ? 4 : 3;
  if (static_cast<int>(kept.size()) == all) {
    bound.whole = all;
    const Eigen::MatrixXd block = bound.factor.topLeftCorner(all, all);
    bound.inverse.topLeftCorner(all, all) = block.inverse();
  }
  // The box around the ellipsoid.
  const Eigen::MatrixXd covariance = precision(kept, kept).inverse();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    bound.reach(kept[k]) = bound.distance * std::sqrt(covariance(at, at)) * (1.0 + kSlack);
  }
  if (kept.size() >= 2 && kept[kept.size() - 2] == 2 && kept.back() == 3) {
    const auto m = static_cast<Eigen::Index>(kept.size()) - 1;
    const Eigen::Index n = m - 1;
    bound.relative = RatioRange(covariance(n, n), covariance(m, m), covariance(n, m),
                                bound.distance * (1.0 + kSlack)) *
                     (Interval(bound.centre(3)) / Interval(bound.centre(2)));
  }
  return bound;
}

bool ContractTransfer(const ContractTarget& target, ExperimentBox& box) {
  const TransferBound& bound = target.transfer;
  if (!bound.used) return true;
  constexpr std::array<CellVariable, 4> kVariables = {kCellOmega, kCellXi, kCellN, kCellM};
  std::array<Interval, 4> v{};
  for (int k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (bound.factor(k, k) == 0.0) continue;
    v[i] = OffsetOf(bound, k, box[kVariables[i]]);
    if (!Narrow(v[i], Interval(-bound.reach(k), bound.reach(k)))) return false;
  }
  if (!Narrow(box[kCellRelative], bound.relative)) return false;
  if (!ContractForm(bound.factor, bound.distance, v)) return false;
  if (!ContractForm(bound.backward, bound.distance, v)) return false;
  for (int k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (bound.factor(k, k) == 0.0) continue;
    if (!Narrow(box[kVariables[i]], ValueOf(bound, k, v[i]))) return false;
  }
  return true;
}

bool TransferMayHold(const TransferBound& bound, const std::array<Interval, 4>& box, bool* always) {
  Interval sum(0.0);
  for (int r = 0; r < 4; ++r) {
    Interval row(0.0);
    for (int c = 0; c < 4; ++c) {
      if (bound.factor(r, c) == 0.0) continue;
      row += Interval(bound.factor(r, c)) * OffsetOf(bound, c, box[static_cast<std::size_t>(c)]);
    }
    sum += square(row);
  }
  const double inner = bound.distance * (1.0 - 3.0 * kSlack) - 3.0 * kSlack;
  *always = inner > 0.0 && sum.upper() <= (square(Interval(inner))).lower();
  return sum.lower() <= square(Interval(bound.distance)).upper();
}

}  // namespace howl
