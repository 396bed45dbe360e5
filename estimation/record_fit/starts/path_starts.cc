#include "estimation/record_fit/starts/path_starts.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "estimation/record_fit/starts/start_least_squares.h"

namespace howl {
namespace {

constexpr std::size_t kDelays = 64;
constexpr double kMostCycles = 1.25;  // of delay
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

// The mean logarithm of what is left of q, smoothed: but for a constant, how likely noise of that
// spectrum is. Where there is little noise the right delay stands out by orders of magnitude in
// bins which hold little of q's power.
double PathStarts::LogLeft(const Eigen::VectorXcd& left) const {
  return SmoothPower(left, kStartReach).array().log().mean();
}

Eigen::VectorXd PathStarts::Flame(const FlamePath& path) const {
  const Eigen::VectorXcd weight = path.At(record_.s).cwiseProduct(weight_);
  return SolveStart(weight.asDiagonal() * flame_, weight_.cwiseProduct(heat_release_)).coefficients;
}

std::vector<double> PathStarts::Delays(std::size_t count) const {
  std::vector<double> tau(kDelays);
  std::vector<double> left(kDelays);
  for (std::size_t i = 0; i < kDelays; ++i) {
    tau[i] = 2.0 * std::numbers::pi * kMostCycles * (static_cast<double>(i) + 0.5) / kDelays;
    const FlamePath path{DelaySpread::kNone, tau[i]};
    left[i] = LogLeft(heat_release_ - path.At(record_.s).cwiseProduct(flame_ * Flame(path)));
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
