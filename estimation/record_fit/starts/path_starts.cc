#include "estimation/record_fit/starts/path_starts.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "estimation/record_fit/loop/point_prior.h"
#include "estimation/record_fit/starts/start_least_squares.h"

namespace howl {
namespace {

// A flame that drives a higher mode than the one whose period is like its delay answers after
// several periods of the cycle: delays are tried to two deviations of their prior.
const double kMostTau = kMeanTau * std::exp(2.0 * kLogTau);
// Radians of the cycle: an eighth of a period at the band's end.
constexpr double kDelayStep = 0.12;
// Of a second path: later by an eighth of a period to two of them.
constexpr std::size_t kLambdas = 24;
constexpr double kLeastLambda = 0.25 * std::numbers::pi;
constexpr double kMostLambda = 4.0 * std::numbers::pi;
constexpr double kLeastShare = 0.1;
constexpr double kMostShare = 1.0;

// The places of the lowest minima, at most `count`, the lowest first.
std::vector<std::size_t> Minima(const std::vector<double>& values, bool ends, std::size_t count) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool first = i == 0;
    const bool last = i + 1 == values.size();
    if (!ends && (first || last)) continue;
    if (!first && values[i - 1] < values[i]) continue;
    if (!last && values[i + 1] < values[i]) continue;
    out.push_back(i);
  }
  std::ranges::sort(out, {}, [&](std::size_t i) { return values[i]; });
  out.resize(std::min(out.size(), count));
  return out;
}

}  // namespace

PathStarts::PathStarts(const RecordSpectra& record)
    : record_(record),
      heat_release_(Tapered(record.heat_release)),
      flame_(record.bins(), record.flame.cols()),
      weight_(SmoothPower(heat_release_, kStartReach).cwiseSqrt().cwiseInverse()) {
  for (Eigen::Index k = 0; k < flame_.cols(); ++k) flame_.col(k) = Tapered(record.flame.col(k));
}

// The mean logarithm of what is left of q, by bands: but for a constant, how likely noise of that
// spectrum is. Where there is little noise the right delay stands out by orders of magnitude in
// bins which hold little of q's power.
double PathStarts::LogLeft(const Eigen::VectorXcd& left) const {
  constexpr Eigen::Index kBand = 2 * kStartReach + 1;
  double sum = 0.0;
  for (Eigen::Index from = 0; from < left.size(); from += kBand) {
    const Eigen::Index bins = std::min(kBand, left.size() - from);
    const auto count = static_cast<double>(bins);
    sum += count * std::log(left.segment(from, bins).squaredNorm() / count);
  }
  return sum / static_cast<double>(left.size());
}

Eigen::VectorXd PathStarts::Flame(const FlamePath& path) const {
  const Eigen::VectorXcd weight = path.At(record_.s).cwiseProduct(weight_);
  return SolveStart(weight.asDiagonal() * flame_, weight_.cwiseProduct(heat_release_)).coefficients;
}

std::vector<double> PathStarts::Delays(std::size_t count) const {
  // A delay turns the flame's columns, which keep their Gram matrix.
  const Eigen::MatrixXcd columns = weight_.asDiagonal() * flame_;
  const Eigen::MatrixXd inverse = SolveSymmetric(
      GramOfStart(columns), Eigen::MatrixXd::Identity(columns.cols(), columns.cols()));
  const Eigen::VectorXcd weighted = weight_.cwiseProduct(heat_release_);
  Eigen::VectorXcd path = (-0.5 * kDelayStep * record_.s).array().exp();
  const Eigen::VectorXcd turn = (-kDelayStep * record_.s).array().exp();
  std::vector<double> tau;
  std::vector<double> left;
  for (double next = 0.5 * kDelayStep; next < kMostTau; next += kDelayStep) {
    const Eigen::VectorXd cross =
        (columns.adjoint() * path.conjugate().cwiseProduct(weighted)).real();
    tau.push_back(next);
    left.push_back(LogLeft(heat_release_ - path.cwiseProduct(flame_ * (inverse * cross))));
    path = path.cwiseProduct(turn);
  }
  // Without the ends: what q tells of p at once, through the acoustics, leaves least at no delay.
  std::vector<double> out;
  for (const std::size_t i : Minima(left, false, count)) out.push_back(tau[i]);
  return out;
}

// Linear in what a flame by the first path alone would answer later, less what it answers now. That
// flame is smaller or larger than the one beside a second path, and so is what a share is of.
std::vector<SecondPath> PathStarts::SecondPaths(const FlamePath& first, std::size_t count) const {
  const Eigen::VectorXcd path = first.At(record_.s);
  const Eigen::Index terms = flame_.cols();
  Eigen::MatrixXcd columns(record_.bins(), terms + 1);
  columns.leftCols(terms) = path.asDiagonal() * flame_;
  const Eigen::VectorXd alone = Flame(first);
  const Eigen::VectorXcd answer = columns.leftCols(terms) * alone;
  std::vector<SecondPath> tried(kLambdas);
  std::vector<double> left(kLambdas);
  for (std::size_t i = 0; i < kLambdas; ++i) {
    const double way = static_cast<double>(i) / (kLambdas - 1);
    const double lambda = kLeastLambda * std::pow(kMostLambda / kLeastLambda, way);
    const Eigen::VectorXcd later = (-lambda * record_.s).array().exp() - 1.0;
    columns.col(terms) = later.cwiseProduct(answer);
    const Eigen::VectorXd solved =
        SolveStart(weight_.asDiagonal() * columns, weight_.cwiseProduct(heat_release_))
            .coefficients;
    left[i] = LogLeft(heat_release_ - columns * solved);
    const Eigen::VectorXd beside = solved.head(terms);
    const double share = solved[terms] * alone.dot(beside) / beside.squaredNorm();
    tried[i] = {std::copysign(std::clamp(std::abs(share), kLeastShare, kMostShare), share), lambda};
  }
  std::vector<SecondPath> out;
  for (const std::size_t i : Minima(left, true, count)) out.push_back(tried[i]);
  return out;
}

}  // namespace howl
