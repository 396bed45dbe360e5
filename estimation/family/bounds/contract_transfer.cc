#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "estimation/family/bounds/contract.h"

namespace howl {

namespace {

// The test evaluates the quadratic form in doubles.
constexpr double kSlack = 1e-9;

Interval Logarithm(const Interval& x) {
  return Interval(x.lower() > 0.0 ? Below(std::log(x.lower())) : -Unbounded(),
                  std::isfinite(x.upper()) ? Above(std::log(x.upper())) : Unbounded());
}

Interval Exponential(const Interval& x) {
  return Interval(std::isfinite(x.lower()) ? Below(std::exp(x.lower())) : 0.0,
                  std::isfinite(x.upper()) ? Above(std::exp(x.upper())) : Unbounded());
}

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

}  // namespace

TransferBound MakeTransferBound(const TransferEllipsoid& ellipsoid, bool second_mode,
                                double distance) {
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
    const auto last = static_cast<Eigen::Index>(kept.size()) - 1;
    const double variance =
        covariance(last, last) + covariance(last - 1, last - 1) - 2.0 * covariance(last, last - 1);
    bound.reach_relative = bound.distance * std::sqrt(variance) * (1.0 + kSlack);
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
    v[i] = Logarithm(box[kVariables[i]]) - Interval(bound.centre(k));
    if (!Narrow(v[i], Interval(-bound.reach(k), bound.reach(k)))) return false;
  }
  if (std::isfinite(bound.reach_relative)) {
    const Interval reach(-bound.reach_relative, bound.reach_relative);
    const Interval centre = Interval(bound.centre(3)) - Interval(bound.centre(2));
    if (!Narrow(box[kCellRelative], Exponential(centre + reach))) return false;
  }
  if (!ContractForm(bound.factor, bound.distance, v)) return false;
  if (!ContractForm(bound.backward, bound.distance, v)) return false;
  for (int k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (bound.factor(k, k) == 0.0) continue;
    if (!Narrow(box[kVariables[i]], Exponential(v[i] + Interval(bound.centre(k))))) return false;
  }
  return true;
}

bool TransferMayHold(const TransferBound& bound, const std::array<Interval, 4>& box, bool* always) {
  Interval sum(0.0);
  for (int r = 0; r < 4; ++r) {
    Interval row(0.0);
    for (int c = 0; c < 4; ++c) {
      if (bound.factor(r, c) == 0.0) continue;
      row += Interval(bound.factor(r, c)) *
             (Logarithm(box[static_cast<std::size_t>(c)]) - Interval(bound.centre(c)));
    }
    sum += square(row);
  }
  const double inner = bound.distance * (1.0 - 3.0 * kSlack) - 3.0 * kSlack;
  *always = inner > 0.0 && sum.upper() <= (square(Interval(inner))).lower();
  return sum.lower() <= square(Interval(bound.distance)).upper();
}

}  // namespace howl
